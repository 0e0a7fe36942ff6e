// The pilot: a fair selection of a capture's pixels, from which everything is chosen before the
// whole is read: the basis, the planes, the quantiser.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/page_buffer.h"
#include "fit/fit.h"
#include "illum/capture.h"
#include "illum/progress.h"

namespace illum {

/// Its pixels lie block by block, as they were read: their samples of one block fit a cache, and
/// nothing is copied.
struct Pilot {
  struct Block {
    std::size_t first = 0, pixels = 0;  ///< where its samples begin, in floats
  };
  int lights = 0;
  std::size_t pixels = 0;  ///< of all blocks
  std::vector<Block> blocks;
  PageBuffer memory;
  bool complete = false;  ///< every unmasked pixel is in it

  /// (3 * lights) x block.pixels, as Capture::read.
  std::span<float> samples(const Block& block) const {
    return {reinterpret_cast<float*>(memory.data()) + block.first,
            3 * static_cast<std::size_t>(lights) * block.pixels};
  }
};

/// Reads about `maxPixels` pixels of the given groups (rising) under `lights`, in blocks spread
/// evenly over the pictures, from the first to the last and from top to bottom, and keeps the
/// unmasked ones (coverage >= 1/2; of rendered captures any). Throws Error if the mask leaves
/// nothing.
Pilot drawPilot(const Capture& capture, std::span<const int> groups, std::span<const int> lights,
                std::size_t maxPixels, Progress& progress);

/// How many pixels are worth it: bounded by the cost of the second moments and by memory; where
/// pixels are rendered to be looked at, also by a share of the `pixels` that there are.
std::size_t pilotPixels(const Capture& capture, std::uint64_t pixels, int lights,
                        std::size_t pilots, std::uint64_t memoryBytes);

/// Mean and second moments of the samples over the pilot's pixels, summed in double.
SampleStatistics statisticsOf(const Pilot& pilot);

}  // namespace illum
