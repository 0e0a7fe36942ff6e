#include "capture/camera_list.h"

#include <system_error>

namespace illum {

namespace fs = std::filesystem;

fs::path cameraListIn(const fs::path& folder) {
  std::error_code missing;
  const auto holds = [&](const fs::path& file) { return fs::is_regular_file(file, missing); };
  for (const std::string_view name : {kCaptureFileName, kTransformsFileName}) {
    if (holds(folder / name)) return folder / name;
  }
  for (const char* place : {"", "sparse", "sparse/0"}) {
    if (holds(folder / place / "images.txt") && holds(folder / place / "cameras.txt")) {
      return folder / place / "images.txt";
    }
  }
  return {};
}

}  // namespace illum
