#include "picture_folder.h"

#include <fmt/format.h>

#include <utility>

#include "illum/error.h"
#include "illum/picture_io.h"

namespace illum::cli {

namespace fs = std::filesystem;

PictureFolder::PictureFolder(fs::path folder, const std::string& format, bool force,
                             double exposureStops)
    : folder_(std::move(folder)), format_(format), exposureStops_(exposureStops) {
  if (format != "png" && format != "jpg" && format != "exr") {
    throw Error(Fault::Usage,
                fmt::format("--format: expected png, jpg or exr, found \"{}\"", format));
  }
  if (fs::exists(folder_) && (!fs::is_directory(folder_) || (!force && !fs::is_empty(folder_)))) {
    throw Error(Fault::Input,
                fmt::format("{}: exists already; --force writes into it", folder_.string()));
  }
  fs::create_directories(folder_);
}

void PictureFolder::write(const std::string& stem, const Picture& picture) const {
  writePicture(folder_ / fmt::format("{}.{}", stem, format_), picture, exposureStops_);
}

}  // namespace illum::cli
