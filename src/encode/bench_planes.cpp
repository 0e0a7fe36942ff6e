#include "encode/bench_planes.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "illum/error.h"
#include "illum/picture_io.h"

namespace illum {
namespace {

constexpr int kBits = 8;
constexpr int kIterations = 60;

/// Row-major.
struct Matrix {
  Matrix(std::size_t r, std::size_t c) : rows(r), columns(c), values(r * c) {}
  double& at(std::size_t r, std::size_t c) { return values[r * columns + c]; }
  double at(std::size_t r, std::size_t c) const { return values[r * columns + c]; }
  std::size_t rows, columns;
  std::vector<double> values;
};

/// The largest range takes all codes; every plane's middle takes the middle code.
BenchPlanes quantised(std::string name, std::vector<float> values, int planes, Size size) {
  BenchPlanes out;
  out.name = std::move(name);
  out.codes = {planes, size, std::vector<std::uint16_t>(values.size())};
  const auto planeOf = [&](int k) { return values.begin() + k * static_cast<long>(size.pixels()); };
  std::vector<float> middles;
  double range = 0;
  for (int k = 0; k < planes; ++k) {
    const auto [least, most] = std::minmax_element(planeOf(k), planeOf(k + 1));
    range = std::max(range, static_cast<double>(*most - *least));
    middles.push_back((*least + *most) / 2);
  }
  constexpr int kLargest = (1 << kBits) - 1, kMiddle = 1 << (kBits - 1);
  out.step = range / kLargest;
  for (int k = 0; k < planes; ++k) {
    const auto offset =
        static_cast<float>(middles[static_cast<std::size_t>(k)] - out.step * kMiddle);
    out.offsets.push_back(offset);
    std::transform(planeOf(k), planeOf(k + 1), out.codes.plane(k).begin(), [&](float value) {
      return static_cast<std::uint16_t>(
          std::clamp(std::lround((value - offset) / out.step), 0L, static_cast<long>(kLargest)));
    });
  }
  out.values = std::move(values);
  return out;
}

/// samples[3 l + c]: channel c of photograph l, its mean taken away.
std::vector<std::vector<float>> readSamples(const std::filesystem::path& folder, Size& size) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".jpg") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::vector<float>> samples;
  for (const auto& file : files) {
    const BytePicture picture = readBytePicture(file);
    size = picture.size();
    for (int c = 0; c < 3; ++c) {
      std::vector<float>& channel = samples.emplace_back();
      double sum = 0;
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          channel.push_back(static_cast<float>(picture.at(x, y, c)) / 255);
          sum += channel.back();
        }
      const auto mean = static_cast<float>(sum / static_cast<double>(channel.size()));
      for (float& value : channel) value -= mean;
    }
  }
  if (samples.empty()) throw inputError(folder, "photographs", "none");
  return samples;
}

Matrix covarianceOf(const std::vector<std::vector<float>>& samples) {
  Matrix covariance(samples.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      for (std::size_t p = 0; p < samples[i].size(); ++p)
        sum += static_cast<double>(samples[i][p]) * samples[j][p];
      covariance.at(i, j) = covariance.at(j, i) = sum;
    }
  return covariance;
}

/// Gram and Schmidt, row by row.
void orthonormalise(Matrix& rows) {
  for (std::size_t i = 0; i < rows.rows; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double product = 0;
      for (std::size_t c = 0; c < rows.columns; ++c) product += rows.at(i, c) * rows.at(j, c);
      for (std::size_t c = 0; c < rows.columns; ++c) rows.at(i, c) -= product * rows.at(j, c);
    }
    double square = 0;
    for (std::size_t c = 0; c < rows.columns; ++c) square += rows.at(i, c) * rows.at(i, c);
    for (std::size_t c = 0; c < rows.columns; ++c) rows.at(i, c) /= std::sqrt(square);
  }
}

/// Orthogonal iteration: the rows come to span the leading eigenvectors, in their order.
Matrix principalRows(const Matrix& covariance, std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Matrix rows(count, covariance.rows);
  for (double& value : rows.values) value = normal(random);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    orthonormalise(rows);
    Matrix next(count, covariance.rows);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t r = 0; r < covariance.rows; ++r)
        for (std::size_t c = 0; c < covariance.columns; ++c)
          next.at(i, c) += rows.at(i, r) * covariance.at(r, c);
    rows = next;
  }
  orthonormalise(rows);
  return rows;
}

}  // namespace

double BenchPlanes::decibels(const PlaneCodes& decoded) const {
  double sum = 0;
  const std::size_t pixels = decoded.tile.pixels();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = offsets[i / pixels] + step * decoded.values[i];
    sum += (value - values[i]) * (value - values[i]);
  }
  return -10 * std::log10(sum / static_cast<double>(pixels));
}

BenchPlanes photographPlanes(const std::filesystem::path& folder, int planes) {
  Size size;
  const auto samples = readSamples(folder, size);
  const Matrix rows = principalRows(covarianceOf(samples), static_cast<std::size_t>(planes));
  // Divided by the root of their number, so that squared errors are means over the photographs.
  const double scale = 1 / std::sqrt(static_cast<double>(samples.size()));
  std::vector<float> values(rows.rows * size.pixels());
  for (std::size_t k = 0; k < rows.rows; ++k)
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const auto weight = static_cast<float>(scale * rows.at(k, s));
      for (std::size_t p = 0; p < size.pixels(); ++p)
        values[k * size.pixels() + p] += weight * samples[s][p];
    }
  return quantised(folder.parent_path().filename().string(), std::move(values), planes, size);
}

BenchPlanes syntheticPlanes(Size size, int planes) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.004);
  std::vector<float> values(static_cast<std::size_t>(planes) * size.pixels());
  std::size_t pixel = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, ++pixel) {
      const double u = 9.0 * x / size.width, v = 9.0 * y / size.height;
      const double albedo = 0.5 + 0.3 * std::sin(u * v / 5) * std::cos(u - v);
      const double nx = 0.6 * std::cos(3 * u) * std::sin(2 * v), ny = 0.6 * std::sin(2 * u + 3 * v);
      const double nz = std::sqrt(1 - nx * nx - ny * ny);
      for (int k = 0; k < planes; ++k) {
        const double shape = std::pow(nx, k % 3) * std::pow(ny, k / 3 % 3) * std::pow(nz, k % 2);
        values[static_cast<std::size_t>(k) * size.pixels() + pixel] =
            static_cast<float>(albedo * shape / (1 + k) + noise(random));
      }
    }
  return quantised("synthetic", std::move(values), planes, size);
}

}  // namespace illum
