// The pilot: a fair selection of a capture's pixels, from which everything is chosen before the
// whole is read: the basis, the planes, the quantiser.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fit/fit.h"
#include "illum/capture.h"
#include "illum/progress.h"

namespace illum {

struct Pilot {
  int lights = 0;
  std::size_t pixels = 0;
  std::vector<float> samples;  ///< (3 * lights) x pixels, as Capture::read
  bool complete = false;       ///< every unmasked pixel is in it
};

/// Reads at most `maxPixels` unmasked pixels (coverage >= 1/2) of group 0 under `lights`, in blocks
/// spread evenly over the picture, top to bottom. Throws Error if the mask leaves nothing.
Pilot drawPilot(const Capture& capture, std::span<const int> lights, std::size_t maxPixels,
                Progress& progress);

/// How many pixels are worth it: bounded by the cost of the second moments and by memory.
std::size_t pilotPixels(int lights, std::uint64_t memoryBytes);

/// Mean and second moments of the samples over the pilot's pixels, summed in double.
SampleStatistics statisticsOf(const Pilot& pilot);

}  // namespace illum
