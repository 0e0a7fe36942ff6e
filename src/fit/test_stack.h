// Photograph stacks for this module's tests: those of ../shared/data where they are present.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace illum::test {

/// samples[l][3 * pixel + c] in [0, 1], as they stand in the files; grey is repeated.
struct Stack {
  std::vector<DirectionalLight> lights;
  std::vector<std::vector<float>> samples;
  std::size_t pixels = 0;
  bool linear = false;  ///< 16-bit files: proportional to light

  /// Every `step`-th pixel's samples under `chosen` lights, as Capture::read gives them.
  std::vector<float> read(std::span<const int> chosen, std::size_t step = 1) const;
};

/// $ILLUM_SHARED or ../shared beside the repository; it may be missing.
std::filesystem::path sharedFolder();

/// The stack in `folder` of the shared data, e.g.
/// "realrti01_door/stack". Empty where it is missing.
std::optional<Stack> sharedStack(const std::string& folder);

SampleStatistics statisticsOf(std::span<const float> samples, int lights);

/// PSNR of pictures relit through the fit's own planes and table against `truth`'s, both as 8-bit
/// sRGB: per light over all pixels and channels, then the mean over the lights in `judged`.
double relitDecibels(const Fit& fit, std::span<const float> planes, const Stack& truth,
                     std::span<const int> judged);

/// A fit to the lights that are not held out, and its figures.
struct Figures {
  Fit fit;
  double used = 0, held = 0;
};
/// Lights with index i % every == every - 1 are held out; every = 0: none.
Figures fitAndJudge(const Stack& stack, const FitOptions& options, int every);

}  // namespace illum::test
