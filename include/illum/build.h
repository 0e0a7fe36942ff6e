// The whole way from a capture to an .illum object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "illum/capture.h"
#include "illum/progress.h"

namespace illum {

struct BuildOptions {
  std::string basis = "learned";        ///< "learned", "sh", "hsh", "dct", "exact"
  int coefficients = 0;                 ///< per channel; 0: chosen
  int planes = 0;                       ///< scalar planes; 0: chosen
  std::string coding;                   ///< "avif", "jpeg", "png"; empty: avif, of exact png
  int quality = -1;                     ///< 0-100; -1: the default
  int speed = -1;                       ///< of the AVIF encoder, 0-10; -1: the default
  std::optional<int> bits;              ///< 8, 10, 12, 16; unset: chosen
  std::optional<std::string> curve;     ///< "linear", "signedSqrt"; unset: chosen
  std::optional<std::string> response;  ///< "linear", "display"; unset: as the capture is
  int holdout = 0;                      ///< K: leave lights K-1, 2K-1, … out; 0: none
  std::optional<bool> solidAngleWeights, extension;
  std::optional<double> regularizer;
  bool projection = false;
  std::optional<int>
      tile;  ///< side of a tile, multiple of 8; unset: 512, or less where the planes need it
  std::uint64_t memoryBytes = 0;  ///< 0: a quarter of the machine
  bool resume = false, force = false;
  /// Asked, from any thread, whenever progress is made; true stops the build with what is done kept
  /// for `resume`.
  std::function<bool()> stop;
};

/// What the capture may hold out of a whole budget; the rest is for fitting, coding and the
/// program.
std::uint64_t captureMemoryBytes(std::uint64_t budgetBytes);

struct BuildReport {
  std::uint64_t bytes = 0;
  double quantisationDecibels = 0;  ///< PSNR of quantisation alone, on screen
  double leaveOneOutDecibels = 0;   ///< at an unseen light; not a number if there is but one
  std::vector<std::string> choices;
  std::vector<std::string> warnings;
  bool stopped = false;
};

/// `out`: OUT.illum, or a folder form where it ends in '/' . Throws Error; on an input fault
/// nothing is left behind, after a stop or a machine fault OUT.partial/ is kept for `resume`.
BuildReport buildObject(const Capture& capture, const std::filesystem::path& out,
                        const BuildOptions& options, Progress& progress);

}  // namespace illum
