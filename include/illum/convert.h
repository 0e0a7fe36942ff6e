// From an object to another one: archive or folder, another coding, other view points.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "illum/object.h"
#include "illum/progress.h"

namespace illum {

struct ConvertOptions {
  /// View points of each slab, columns and rows; 0: those that there are.
  int uCount = 0, vCount = 0;
  bool useDepth = true;           ///< false: new view points are interpolated on the window
  std::string coding;             ///< "avif", "jpeg", "png"; empty: as it is
  int quality = -1;               ///< 0-100; -1: as it is
  int speed = -1;                 ///< of the AVIF encoder, 0-10; -1: the default
  std::uint64_t memoryBytes = 0;  ///< 0: a quarter of the machine
  bool force = false;             ///< replace an existing object
  /// Asked, from any thread, whenever progress is made; true stops the work, and nothing of it
  /// remains.
  std::function<bool()> stop;
};

struct ConvertReport {
  std::uint64_t bytes = 0;
  int keptViews = 0, newViews = 0;
  std::uint64_t unseenPixels = 0;  ///< of new views without a mask: nobody saw them, and they are
                                   ///< continued smoothly
  std::uint64_t clippedSamples = 0;
  bool stopped = false;
};

/// `out` as buildObject's. Views that stay are copied tile by tile, decoded and coded again only
/// for another coding or quality. View points that a slab did not have are made from its own views,
/// plane by plane: reflectance is interpolated, not colours (Wong et al. 1997, section 5). With
/// nothing to change, every entry is copied as it is. Throws Error.
ConvertReport convertObject(const Object& source, const std::filesystem::path& out,
                            const ConvertOptions& options, Progress& progress);

}  // namespace illum
