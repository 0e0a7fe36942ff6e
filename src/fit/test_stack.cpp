#include "fit/test_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "fit/dense.h"
#include "illum/colour.h"
#include "illum/light_file.h"
#include "illum/picture_io.h"

namespace illum::test {
namespace {

// The reader gives linear light; its inverse is what stands in the file, to 16 bits.
std::vector<float> rgbSamples(const std::filesystem::path& file) {
  const Picture picture = readPicture(file);
  const auto channels = static_cast<std::size_t>(picture.channels());
  std::vector<float> samples;
  samples.reserve(3 * picture.size().pixels());
  for (std::size_t p = 0; p < picture.size().pixels(); ++p) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float linear = picture.samples()[p * channels + (channels < 3 ? 0 : c)];
      samples.push_back(displayFromLinear(linear));
    }
  }
  return samples;
}

std::uint8_t screenByte(float sample, bool linear) {
  return linear ? displayByteFromLinear(sample) : byteFromUnit(sample);
}

}  // namespace

std::filesystem::path sharedFolder() {
  const char* named = std::getenv("ILLUM_SHARED");
  return named != nullptr ? named : std::filesystem::path(ILLUM_SOURCE_DIR) / ".." / "shared";
}

std::vector<float> Stack::read(std::span<const int> chosen, std::size_t step) const {
  const std::size_t count = (pixels + step - 1) / step;
  std::vector<float> result(3 * chosen.size() * count);
  for (std::size_t l = 0; l < chosen.size(); ++l) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t p = 0; p < count; ++p) {
        result[(3 * l + c) * count + p] = samples[chosen[l]][3 * p * step + c];
      }
    }
  }
  return result;
}

std::optional<Stack> sharedStack(const std::string& folder) {
  const std::filesystem::path path = sharedFolder() / "data" / folder;
  if (!std::filesystem::exists(path / "lights.lp")) return std::nullopt;
  Stack stack;
  for (const LightFileEntry& entry : readLightFile(path / "lights.lp").entries) {
    stack.lights.push_back(entry.light);
    stack.samples.push_back(rgbSamples(path / entry.name));
  }
  stack.pixels = stack.samples.front().size() / 3;
  stack.linear = folder.starts_with("diligent");
  return stack;
}

SampleStatistics statisticsOf(std::span<const float> samples, int lights) {
  const Eigen::Index rows = 3 * lights;
  SampleStatistics statistics;
  statistics.lights = lights;
  statistics.pixels = samples.size() / static_cast<std::size_t>(rows);
  const auto pixels = static_cast<Eigen::Index>(statistics.pixels);
  using Samples = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Matrix all = Eigen::Map<const Samples>(samples.data(), rows, pixels).cast<double>();
  const Matrix gram = all * all.transpose() / static_cast<double>(pixels);
  const Vector mean = all.rowwise().mean();
  statistics.mean.assign(mean.data(), mean.data() + rows);
  statistics.gram.assign(gram.data(), gram.data() + rows * rows);
  return statistics;
}

double relitDecibels(const Fit& fit, std::span<const float> planes, const Stack& truth,
                     std::span<const int> judged) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int count = fit.basis.planes();
  const auto pixels = static_cast<Eigen::Index>(truth.pixels);
  const Eigen::Map<const Rows> stored(planes.data(), count, pixels);
  std::vector<float> b(fit.basis.evaluateSize());
  double decibels = 0;
  for (const int l : judged) {
    fit.basis.evaluate(truth.lights[l].toLight, b);
    const Rows weights = Eigen::Map<const Rows>(b.data(), count + 1, 3).transpose();
    Rows relit = weights.leftCols(count) * stored;
    relit.colwise() += weights.col(count);
    double error = 0;
    for (Eigen::Index p = 0; p < pixels; ++p) {
      for (int c = 0; c < 3; ++c) {
        const double difference = screenByte(relit(c, p), truth.linear) -
                                  screenByte(truth.samples[l][3 * p + c], truth.linear);
        error += difference * difference;
      }
    }
    error /= 3.0 * static_cast<double>(pixels) * 255 * 255;
    decibels += error > 0 ? std::min(99.0, -10 * std::log10(error)) : 99.0;
  }
  return decibels / static_cast<double>(judged.size());
}

Figures fitAndJudge(const Stack& stack, const FitOptions& options, int every) {
  std::vector<int> used, held;
  for (int l = 0; l < static_cast<int>(stack.lights.size()); ++l) {
    (every != 0 && l % every == every - 1 ? held : used).push_back(l);
  }
  std::vector<DirectionalLight> lights;
  for (const int l : used) lights.push_back(stack.lights[l]);
  const std::vector<float> selection = stack.read(used, 1 + stack.pixels / 50000);
  Figures figures{
      fitBasis(lights, statisticsOf(selection, static_cast<int>(used.size())), options)};
  const std::vector<float> samples = stack.read(used);
  std::vector<float> planes(figures.fit.basis.planes() * stack.pixels);
  figures.fit.planes.apply(samples, stack.pixels, planes);
  figures.used = relitDecibels(figures.fit, planes, stack, used);
  if (!held.empty()) figures.held = relitDecibels(figures.fit, planes, stack, held);
  return figures;
}

}  // namespace illum::test
