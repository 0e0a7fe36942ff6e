#include "render/ggx_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/float3.h"

namespace illum {
namespace {

constexpr float kLeastAlpha = 1e-3f;
constexpr std::size_t kRoughnessSteps = 32;
constexpr int kQuadratureSide = 24;

// Smith's shadowing of one direction (z is its cosine).
float lambda(float z, float alpha) {
  const float squared = std::max(z * z, 1e-12f);
  return 0.5f * (std::sqrt(1 + alpha * alpha * (1 - squared) / squared) - 1);
}

float midpoint(int i) {
  return (static_cast<float>(i) + 0.5f) / kQuadratureSide;
}

struct Entry {
  float base, grazing;
};

// Over visible normals the estimator is F * G2 / G1 (Heitz 2018, equation 19).
Entry integrated(float cosine, float alpha) {
  const Float3 v{std::sqrt(std::max(0.0f, 1 - cosine * cosine)), 0, cosine};
  double base = 0, grazing = 0;
  for (int i = 0; i < kQuadratureSide; ++i) {
    for (int j = 0; j < kQuadratureSide; ++j) {
      const Float3 normal = visibleNormal(v, alpha, {midpoint(i), midpoint(j)});
      const float vh = dot(v, normal);
      const float lightCosine = 2 * vh * normal.z - v.z;
      if (lightCosine <= 0 || vh <= 0) continue;
      const float shadowing = lambda(v.z, alpha);
      const float kept = (1 + shadowing) / (1 + shadowing + lambda(lightCosine, alpha));
      const float schlick = std::pow(1 - std::min(vh, 1.0f), 5.0f);
      base += static_cast<double>(kept * (1 - schlick));
      grazing += static_cast<double>(kept * schlick);
    }
  }
  constexpr double kCount = kQuadratureSide * kQuadratureSide;
  return {static_cast<float>(base / kCount), static_cast<float>(grazing / kCount)};
}

// The entry at the horizon: such that the line from it to the next one is nowhere below the true
// curve, which turns down only just before the horizon, where facets hide each other. So what lies
// below never gets more than is left.
Entry atHorizon(const Entry& next, float alpha) {
  Entry entry{0, 0};
  for (const float share : {0.02f, 0.05f, 0.1f, 0.2f, 0.3f, 0.5f, 0.7f}) {
    const Entry between = integrated(share / kAlbedoSteps, alpha);
    const auto extended = [&](float at, float end) { return end + (at - end) / (1 - share); };
    entry.base = std::max(entry.base, extended(between.base, next.base));
    entry.grazing = std::max(entry.grazing, extended(between.grazing, next.grazing));
  }
  return entry;
}

std::vector<GgxAlbedo> tabulated() {
  std::vector<GgxAlbedo> table(kRoughnessSteps + 1);
  for (std::size_t r = 0; r <= kRoughnessSteps; ++r) {
    const float alpha = ggxAlpha(static_cast<float>(r) / kRoughnessSteps);
    const auto set = [&](std::size_t k, Entry entry) {
      table[r].base[k] = entry.base;
      table[r].grazing[k] = entry.grazing;
    };
    for (std::size_t k = 1; k <= kAlbedoSteps; ++k) {
      set(k, integrated(static_cast<float>(k) / kAlbedoSteps, alpha));
    }
    set(0, atHorizon({table[r].base[1], table[r].grazing[1]}, alpha));
  }
  return table;
}

}  // namespace

float ggxAlpha(float roughness) {
  return std::max(kLeastAlpha, roughness * roughness);
}

GgxAlbedo ggxAlbedo(float roughness) {
  static const std::vector<GgxAlbedo> table = tabulated();
  const float position = std::clamp(roughness, 0.0f, 1.0f) * kRoughnessSteps;
  const auto row = std::min(static_cast<std::size_t>(position), kRoughnessSteps - 1);
  const float share = position - static_cast<float>(row);
  GgxAlbedo out;
  for (std::size_t k = 0; k <= kAlbedoSteps; ++k) {
    out.base[k] = std::lerp(table[row].base[k], table[row + 1].base[k], share);
    out.grazing[k] = std::lerp(table[row].grazing[k], table[row + 1].grazing[k], share);
  }
  return out;
}

float albedoAt(const AlbedoCurve& curve, float cosine) {
  const float position = std::clamp(cosine, 0.0f, 1.0f) * kAlbedoSteps;
  const auto k = std::min(static_cast<std::size_t>(position), kAlbedoSteps - 1);
  return std::lerp(curve[k], curve[k + 1], position - static_cast<float>(k));
}

float hemisphericalMean(const AlbedoCurve& curve) {
  // Each piece is linear, so that Simpson's rule is exact.
  float sum = 0;
  for (std::size_t k = 0; k < kAlbedoSteps; ++k) {
    const float left = static_cast<float>(k) / kAlbedoSteps;
    const float right = static_cast<float>(k + 1) / kAlbedoSteps;
    const float middle = 0.5f * (left + right) * 0.5f * (curve[k] + curve[k + 1]);
    sum += (left * curve[k] + 4 * middle + right * curve[k + 1]) / (6 * kAlbedoSteps);
  }
  return 2 * sum;
}

Float3 visibleNormal(Float3 toViewer, float alpha, std::array<float, 2> uniform) {
  // As in the paper's appendix: stretch to a hemisphere, draw from its projection, shrink back.
  const Float3 stretched = normalised({alpha * toViewer.x, alpha * toViewer.y, toViewer.z});
  const float radius = std::sqrt(uniform[0]);
  const float angle = 2 * std::numbers::pi_v<float> * uniform[1];
  const float across = radius * std::cos(angle);
  const float squeeze = 0.5f * (1 + stretched.z);
  const float horizontal = std::hypot(stretched.x, stretched.y);
  const Float3 t1 = horizontal > 0 ? Float3{-stretched.y / horizontal, stretched.x / horizontal, 0}
                                   : Float3{1, 0, 0};
  const Float3 t2 = cross(stretched, t1);
  const float along = (1 - squeeze) * std::sqrt(std::max(0.0f, 1 - across * across)) +
                      squeeze * radius * std::sin(angle);
  const float up = std::sqrt(std::max(0.0f, 1 - across * across - along * along));
  const Float3 normal = across * t1 + along * t2 + up * stretched;
  return normalised({alpha * normal.x, alpha * normal.y, std::max(1e-6f, normal.z)});
}

}  // namespace illum
