// The pictures of the report: a photograph, its relit twin and their difference, small enough to
// embed.
#pragma once

#include <span>
#include <vector>

#include "illum/picture.h"
#include "study/comparison.h"

namespace illum {

/// Widest and highest embedded picture, in pixels.
inline constexpr int kReportPictureSide = 640;
/// What differences are multiplied by, so that they can be seen.
inline constexpr int kErrorGain = 8;

/// Three display-referred RGB pictures of one size.
struct ReportPictures {
  BytePicture photograph, relit;
  BytePicture error;  ///< |difference of the encoded values| * kErrorGain, averaged over what a
                      ///< pixel stands for
};

/// Of each of `lights` (indices), in one pass over the view. Reduced by a whole factor, in
/// linear light, until neither side exceeds kReportPictureSide.
std::vector<ReportPictures> reportPictures(const Comparison& comparison,
                                           std::span<const int> lights);

}  // namespace illum
