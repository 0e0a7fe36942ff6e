#include "normals/photometric_stereo.h"

#include <algorithm>
#include <cmath>

namespace illum {
namespace {

// Chosen on DiLiGenT's cat (docs/quality.md): from 0.25 to 0.5 and 0.35 to 0.55 the mean angle
// changes by a tenth.
constexpr float kShadow = 0.3F;        // of the bright end: darker is shadow
constexpr double kBrightEnd = 0.9;     // quantile; above it highlights are common
constexpr double kKept = 0.5;          // share of the unshadowed samples, from the dark end
constexpr std::size_t kFewest = 8;     // but so many samples, if there are
constexpr int kReweightings = 4;       // after this the mean angle stands still
constexpr double kCauchyScale = 0.05;  // residual, as a share of the albedo
constexpr float kBlack = 1e-5F;        // linear light

// Lights of a bowl seen from far determine all three coordinates about alike; a cap of 10 degrees
// still does by 1 : 1000. Below that a normal would be noise.
constexpr double kLeastPivot = 1e-5;

// Upper triangle of a symmetrical 3 x 3 matrix.
struct Symmetric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  void addOuter(double weight, Vector3 v) {
    xx += weight * v.x * v.x;
    xy += weight * v.x * v.y;
    xz += weight * v.x * v.z;
    yy += weight * v.y * v.y;
    yz += weight * v.y * v.z;
    zz += weight * v.z * v.z;
  }
};

// Cholesky's factors A = L D L', solved forward and back.
std::optional<Vector3> solved(const Symmetric& a, Vector3 b) {
  const double least = kLeastPivot * (a.xx + a.yy + a.zz);
  const double d1 = a.zz;
  if (!(d1 > least)) return std::nullopt;
  const double l21 = a.yz / d1, l31 = a.xz / d1;
  const double d2 = a.yy - l21 * a.yz;
  if (!(d2 > least)) return std::nullopt;
  const double l32 = (a.xy - l31 * a.yz) / d2;
  const double d3 = a.xx - l31 * a.xz - l32 * l32 * d2;
  if (!(d3 > least)) return std::nullopt;
  const double y1 = b.z, y2 = b.y - l21 * y1, y3 = b.x - l31 * y1 - l32 * y2;
  const double x = y3 / d3, y = y2 / d2 - l32 * x, z = y1 / d1 - l21 * y - l31 * x;
  return Vector3{x, y, z};
}

float atRank(std::vector<float>& values, std::size_t begin, std::size_t rank) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto nth = first + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(first, nth, values.end());
  return *nth;
}

}  // namespace

PhotometricStereo::PhotometricStereo(std::vector<Direction> lights, NormalOptions::Method method)
    : method_(method) {
  for (const Direction& light : lights) lights_.push_back(light.vector());
}

// min over n of sum w_j (n . l_j - I_j)^2 (R. J. Woodham, "Photometric method for determining
// surface orientation from multiple images", 1980); |n| is the albedo.
std::optional<Vector3> PhotometricStereo::leastSquares(std::span<const float> brightness,
                                                       std::span<const float> weights) const {
  Symmetric a;
  Vector3 b;
  for (std::size_t j = 0; j < lights_.size(); ++j) {
    const double weight = weights[j];
    if (weight == 0) continue;
    a.addOuter(weight, lights_[j]);
    b = b + (weight * brightness[j]) * lights_[j];
  }
  return solved(a, b);
}

// Shadows are dark, highlights bright, and among what is left the darker half is the more diffuse:
// it has the low frequencies of the reflectance (B. Shi et al., "Bi-polynomial modeling of
// low-frequency reflectances", 2014). What counts as dark is measured by the bright end but for its
// highlights.
PhotometricStereo::Window PhotometricStereo::middle(std::span<const float> brightness,
                                                    std::vector<float>& scratch) const {
  scratch.assign(brightness.begin(), brightness.end());
  const auto bright = static_cast<std::size_t>(kBrightEnd * static_cast<double>(scratch.size()));
  const float shadow = kShadow * atRank(scratch, 0, std::min(bright, scratch.size() - 1));
  const auto lit =
      std::partition(scratch.begin(), scratch.end(), [&](float value) { return value <= shadow; });
  const auto first = static_cast<std::size_t>(lit - scratch.begin());
  const std::size_t count = scratch.size() - first;
  if (count == 0) return {};
  const auto share = static_cast<std::size_t>(kKept * static_cast<double>(count));
  const std::size_t kept = std::min(std::max(share, kFewest), count);
  return {shadow, atRank(scratch, first, kept - 1)};
}

std::optional<Vector3> PhotometricStereo::normal(std::span<const float> brightness,
                                                 std::vector<float>& scratch) const {
  if (*std::max_element(brightness.begin(), brightness.end()) < kBlack) return std::nullopt;
  const std::size_t count = lights_.size();
  std::vector<float>& weights = scratch;
  Window window;
  if (method_ == NormalOptions::Method::Robust) window = middle(brightness, scratch);
  weights.assign(count, 1);
  if (method_ == NormalOptions::Method::Robust) {
    for (std::size_t j = 0; j < count; ++j)
      weights[j] = brightness[j] > window.from && brightness[j] <= window.to ? 1.0F : 0.0F;
  }
  auto n = leastSquares(brightness, weights);
  if (method_ == NormalOptions::Method::Robust) {
    // Iteratively reweighted by Cauchy's function: what fits badly after all, a weak highlight or
    // another surface's light, counts less.
    for (int round = 0; n && round < kReweightings; ++round) {
      const double scale = kCauchyScale * length(*n);
      for (std::size_t j = 0; j < count; ++j) {
        if (weights[j] == 0) continue;
        const double residual = (brightness[j] - dot(*n, lights_[j])) / scale;
        weights[j] = static_cast<float>(1 / (1 + residual * residual));
      }
      n = leastSquares(brightness, weights);
    }
    // Lights that remain in one plane tell less than all of them do.
    if (!n) n = leastSquares(brightness, std::vector<float>(count, 1));
  }
  if (!n || !(length(*n) > 0)) return std::nullopt;
  return (1 / length(*n)) * *n;
}

}  // namespace illum
