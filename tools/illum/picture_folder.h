// A folder that a command fills with pictures.
#pragma once

#include <filesystem>
#include <string>

#include "illum/picture.h"

namespace illum::cli {

class PictureFolder {
 public:
  /// `format`: png, jpg or exr. Throws Error: for another format (Fault::Usage), for a folder that
  /// is not empty unless `force` (Fault::Input). Makes the folder.
  PictureFolder(std::filesystem::path folder, const std::string& format, bool force,
                double exposureStops);

  /// Replaces STEM.FORMAT atomically.
  void write(const std::string& stem, const Picture& picture) const;

 private:
  std::filesystem::path folder_;
  std::string format_;
  double exposureStops_;
};

}  // namespace illum::cli
