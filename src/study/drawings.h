// Drawings of the report, as inline SVG. Text and lines take the page's colours (CSS classes), so
// that they hold in light and dark.
#pragma once

#include <string>

#include "illum/evaluate.h"

namespace illum {

/// Where colours begin and end.
struct DecibelRange {
  double low = 0, high = 1;
};

/// The PSNRs of all lights, opened to at least 3 dB around its middle so that noise is not painted
/// as difference.
DecibelRange decibelRange(const Evaluation& evaluation);

/// "#rrggbb" of t in [0, 1] (clamped; NaN is 0), dark blue to yellow: monotonous in lightness, and
/// the same order for every colour vision.
std::string rampColour(double t);

/// The light directions seen along the optical axis (orthographic: x right, y up), coloured by
/// PSNR, held-out ones ringed; lights from behind in a second disc, where there are any. Names
/// appear as hover titles.
std::string domeDrawing(const Evaluation& evaluation);

/// One dot a light in the order of the light file, coloured and ringed as in the dome, with a line
/// for each of the two means.
std::string lightPlot(const Evaluation& evaluation);

/// The ramp with its two ends in decibels.
std::string rampLegend(const Evaluation& evaluation);

}  // namespace illum
