// The shape that an object's own reflectance tells: normals by photometric stereo on its planes,
// and heights integrated from them. The mathematics is in docs/math/normals.md.
#pragma once

#include <cstdint>
#include <filesystem>

#include "illum/object.h"
#include "illum/picture.h"

namespace illum {

struct NormalOptions {
  enum class Method {
    Robust,       ///< without shadows and highlights
    LeastSquares  ///< plain, Woodham 1980: for comparison
  } method = Method::Robust;
  /// Bounds decoded tiles and samples; the picture of normals comes on top.
  std::uint64_t memoryBytes = std::uint64_t{1} << 30;
};

/// Unit normals of a view in its own frame, x right, y up, z toward the viewer: three channels, all
/// zero where the mask covers less than half and where no light shows anything. The reflectance is
/// asked for under the lights that the object was made from, as far as they stand in front of the
/// view. The same on any number of threads.
/// Throws Error (Fault::Input) for panoramas and where fewer than four lights stand in front, and
/// (Fault::Usage) for a group that does not exist.
Picture surfaceNormals(const Object& object, int group = 0, const NormalOptions& options = {});

/// Heights (z, one channel) of a surface seen along -z whose normals are given, three channels;
/// pixels are squares of side `pixelSide`, and heights come in the same unit. Normals of zero leave
/// a pixel free: it continues its surroundings smoothly. Steps that no normal shows are smoothed
/// over. The mean over pixels with a normal is 0. The same on any number of threads.
/// Memory: 60 bytes a pixel. Throws Error (Fault::Input) for another number of channels and for
/// numbers that are not finite.
Picture integrateHeights(const Picture& normals, double pixelSide);

/// Heights of a photograph's own plane, from its normals, in units of the object (half the
/// photograph's longer side is 1). Throws as surfaceNormals, and (Fault::Usage) for views that are
/// no photographs.
Picture photographHeights(const Object& object, int group = 0, const NormalOptions& options = {});
/// The same from normals that are at hand.
Picture photographHeights(const Picture& normals);

/// Replaces `file` atomically. PNG: 16 bits, (n + 1) / 2 in red, green and blue, transparent where
/// there is no normal. OpenEXR: float, n itself and an alpha of 0 or 1. Throws Error (Fault::Usage)
/// for other endings.
void writeNormals(const std::filesystem::path& file, const Picture& normals);

/// What a file of heights says.
struct HeightRange {
  double lowest = 0, highest = 0;
};
/// Replaces `file` atomically. OpenEXR: float, z itself. PNG: 16 bits, grey, linear, black is the
/// range's lowest and white its highest. Returns the range. Throws Error (Fault::Usage) for other
/// endings.
HeightRange writeHeights(const std::filesystem::path& file, const Picture& heights);

}  // namespace illum
