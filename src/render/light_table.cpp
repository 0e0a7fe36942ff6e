#include "render/light_table.h"

#include <cmath>
#include <numbers>

namespace illum {
namespace {

// The plane's unit square [-1, 1]^2, folded onto the sphere.
Float3 fromOctahedral(float x, float y) {
  const float z = 1 - std::abs(x) - std::abs(y);
  if (z >= 0) return normalised({x, y, z});
  return normalised({std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), z});
}

struct SquarePoint {
  float x, y;
};
SquarePoint toOctahedral(Float3 d) {
  const float size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const float x = d.x / size, y = d.y / size;
  if (d.z >= 0) return {x, y};
  return {std::copysign(1 - std::abs(y), d.x), std::copysign(1 - std::abs(x), d.y)};
}

// More than the rounding of directions.
constexpr double kSlackRadians = 1e-5;

double angleBetween(Float3 a, Float3 b) {
  return 2 * std::asin(std::min(1.0, 0.5 * static_cast<double>(length(a - b))));
}

// The multiples of two irrational numbers fill the square evenly (Roberts 2018, "The unreasonable
// effectiveness of quasirandom sequences").
float turnOf(int id, double step) {
  const double turned = static_cast<double>(id) * step;
  return static_cast<float>(turned - std::floor(turned));
}

}  // namespace

DiscIndex::DiscIndex(std::span<const Float3> centres, double radiusRadians) {
  // About as many cells as discs, none much smaller than a disc.
  const double byCount = std::sqrt(static_cast<double>(centres.size()));
  const double bySize = 3 / std::max(radiusRadians, 1e-3);
  side_ = static_cast<int>(std::clamp(std::min(byCount, bySize), 1.0, 64.0));
  const auto cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  starts_.reserve(cells + 1);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    starts_.push_back(static_cast<std::uint32_t>(discs_.size()));
    const float step = 2.0f / static_cast<float>(side_);
    const float left = -1 + step * static_cast<float>(cell % static_cast<std::size_t>(side_));
    const float low = -1 + step * static_cast<float>(cell / static_cast<std::size_t>(side_));
    const Float3 middle = fromOctahedral(left + 0.5f * step, low + 0.5f * step);
    // The map stretches lengths at most threefold, in the middle of an octahedron's face.
    const double reach = 3 * std::numbers::sqrt2 / 2 * static_cast<double>(step);
    for (std::size_t l = 0; l < centres.size(); ++l) {
      if (angleBetween(middle, centres[l]) <= radiusRadians + reach + kSlackRadians) {
        discs_.push_back(static_cast<std::uint32_t>(l));
      }
    }
  }
  starts_.push_back(static_cast<std::uint32_t>(discs_.size()));
}

std::size_t DiscIndex::cellOf(Float3 direction) const {
  const SquarePoint at = toOctahedral(direction);
  const auto step = [&](float x) {
    const int i = static_cast<int>((x + 1) * 0.5f * static_cast<float>(side_));
    return static_cast<std::size_t>(std::clamp(i, 0, side_ - 1));
  };
  return step(at.y) * static_cast<std::size_t>(side_) + step(at.x);
}

std::span<const std::uint32_t> DiscIndex::near(Float3 direction) const {
  if (side_ == 0) return {};
  const std::size_t cell = cellOf(direction);
  return {discs_.data() + starts_[cell], discs_.data() + starts_[cell + 1]};
}

LightTable::LightTable(std::span<const RenderLight> lights, double radiusRadians)
    : count_(lights.size()), areDiscs_(radiusRadians > 0) {
  const double sine = std::sin(radiusRadians), halfSine = std::sin(0.5 * radiusRadians);
  const double height = 2 * halfSine * halfSine;
  weight_ = static_cast<float>(2 * std::numbers::pi / (2 - height));
  if (areDiscs_) {
    height_ = static_cast<float>(height);
    radiance_ = static_cast<float>(1 / (sine * sine));
    density_ = static_cast<float>(1 / (2 * std::numbers::pi * height));
    chordSquared_ = static_cast<float>(4 * halfSine * halfSine);
  }
  batches_.resize((count_ + kBatch - 1) / kBatch);
  for (std::size_t l = 0; l < count_; ++l) {
    const Frame frame(normalised(float3(lights[l].toLight.vector())));
    centres_.push_back(frame.z);
    DiscBatch& batch = batches_[l / kBatch];
    const std::size_t i = l % kBatch;
    batch.centre.x[i] = frame.z.x, batch.centre.y[i] = frame.z.y, batch.centre.z[i] = frame.z.z;
    batch.across.x[i] = frame.x.x, batch.across.y[i] = frame.x.y, batch.across.z[i] = frame.x.z;
    batch.up.x[i] = frame.y.x, batch.up.y[i] = frame.y.y, batch.up.z[i] = frame.y.z;
    batch.turnA[i] = turnOf(lights[l].id, 0.7548776662466927);
    batch.turnB[i] = turnOf(lights[l].id, 0.5698402909980532);
  }
  if (areDiscs_) index_ = DiscIndex(centres_, radiusRadians);
}

const DirectionBatch& LightTable::draw(std::size_t batch, std::array<float, 2> uniform,
                                       DirectionBatch& buffer) const {
  if (!areDiscs_) return batches_[batch].centre;
  drawOnDiscs(batches_[batch], height_, uniform, std::min(kBatch, count_ - batch * kBatch), buffer);
  return buffer;
}

}  // namespace illum
