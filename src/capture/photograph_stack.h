// A stack of photographs as a Capture, once everything about it is known.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "capture/band_plan.h"
#include "capture/file_pool.h"
#include "capture/photograph.h"
#include "illum/capture.h"

namespace illum {

/// What part of the upright photographs is the capture's picture, and how much smaller. Columns and
/// rows that do not fill a box any more are left out.
struct StackRegion {
  Rectangle crop;
  int shrink = 1;
  Size size() const { return {crop.width / shrink, crop.height / shrink}; }
};

struct StackParts {
  std::unique_ptr<FilePool> pool;
  std::vector<Photograph> photographs;  ///< as many as lights, in their order
  std::vector<LightFileEntry> lights;
  StackRegion region;
  BytePicture mask;  ///< of the whole upright photograph; empty: alpha, if any
  std::optional<std::size_t> maskFile;
  BandPlan plan;
  int top = 0, rows = 0;  ///< upright rows that are read
  std::filesystem::path scratch;
};

/// `progress` must outlive the capture.
std::unique_ptr<Capture> makePhotographStack(StackParts parts, Progress& progress);

}  // namespace illum
