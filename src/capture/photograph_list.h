// Photographs and lights that are known by name, however they were found.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "illum/capture.h"
#include "illum/light_file.h"

namespace illum {

struct PhotographList {
  std::filesystem::path source;  ///< where the list comes from, for messages
  std::vector<std::filesystem::path> files;
  std::vector<LightFileEntry> lights;  ///< one a file
};

/// As openPhotographs; `options.lightFile` is not looked at. At least one file. Throws Error.
std::unique_ptr<Capture> openPhotographList(PhotographList list, const PhotographOptions& options,
                                            Progress& progress);

}  // namespace illum
