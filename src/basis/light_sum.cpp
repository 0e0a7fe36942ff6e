#include "basis/light_sum.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "basis/catmull_rom.h"
#include "basis/chart.h"
#include "basis/light_mesh.h"

namespace illum {

LightSum::LightSum(LightDomain domain, int resolution) : domain_(domain), resolution_(resolution) {
  const auto side = static_cast<std::size_t>(resolution) + 2;
  samples_.resize((domain == LightDomain::Sphere ? 2 : 1) * side * side);
}

LightSum::LightSum(const LightBasis& basis) : mesh_(basis.mesh()), domain_(basis.domain()) {
  if (mesh_ == nullptr)
    *this = LightSum(domain_, basis.table().resolution());
  else
    samples_.resize(static_cast<std::size_t>(mesh_->lights()));
}

LightSum LightSum::emptyCopy() const {
  LightSum empty = *this;
  std::fill(empty.samples_.begin(), empty.samples_.end(), Rgb());
  empty.southPole_ = {};
  return empty;
}

void LightSum::Rgb::add(double weight, LinearRgb light) {
  r += weight * light.r;
  g += weight * light.g;
  b += weight * light.b;
}

void LightSum::Rgb::addScaled(double weight, const Rgb& other) {
  r += weight * other.r;
  g += weight * other.g;
  b += weight * other.b;
}

void LightSum::spread(ChartPoint p, double share, LinearRgb intensity) {
  const CellCoordinate x = cellCoordinate(p.x, resolution_), y = cellCoordinate(p.y, resolution_);
  const auto side = static_cast<std::size_t>(resolution_) + 2;
  Rgb* cell = samples_.data() + static_cast<std::size_t>(p.square) * side * side +
              static_cast<std::size_t>(y.cell) * side + static_cast<std::size_t>(x.cell);
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i)
      cell[j * side + i].add(share * y.weights[j] * x.weights[i], intensity);
  }
}

void LightSum::add(Direction toLight, LinearRgb intensity) {
  if (mesh_ != nullptr) {
    mesh_->forEachWeight(
        toLight, [&](std::size_t light, double weight) { samples_[light].add(weight, intensity); });
    return;
  }
  if (domain_ == LightDomain::Sphere || toLight.z() >= 0) {
    spread(chartFromDirection(toLight), 1, intensity);
    return;
  }
  const BelowHorizon below = belowHorizon(toLight);
  southPole_.add(below.southPole, intensity);
  if (below.southPole < 1) spread(below.equator, 1 - below.southPole, intensity);
}

void LightSum::add(const LightSum& other) {
  assert(other.samples_.size() == samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i].addScaled(1, other.samples_[i]);
  southPole_.addScaled(1, other.southPole_);
}

std::vector<double> LightSum::weights(const LightBasis& basis) const {
  assert(basis.mesh() == mesh_);
  return arranged(basis.colour(), mesh_ != nullptr ? samples_ : columnSums(basis.table()));
}

std::vector<LightSum::Rgb> LightSum::columnSums(const BasisTable& table) const {
  assert(table.resolution() == resolution_ && table.domain() == domain_);
  const auto columns = static_cast<std::size_t>(table.columns());
  std::vector<Rgb> sums(columns);
  const std::size_t square = samples_.size() / static_cast<std::size_t>(table.squares());
  const std::span<const float> values = table.values();
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    if (samples_[s].isZero()) continue;
    const float* value = values.data() + (s / square) * columns * square + s % square;
    for (std::size_t c = 0; c < columns; ++c, value += square)
      sums[c].addScaled(*value, samples_[s]);
  }
  if (domain_ == LightDomain::Hemisphere) {
    for (std::size_t c = 0; c < columns; ++c) sums[c].addScaled(table.southPole()[c], southPole_);
  }
  return sums;
}

std::vector<double> LightSum::arranged(const BasisColour& colour, const std::vector<Rgb>& columns) {
  std::vector<double> weights;
  if (colour.kind == BasisColour::Kind::Full) {
    // Column 3k + c is channel c of plane k, and the last three are the mean.
    for (std::size_t k = 0; k < columns.size(); k += 3)
      weights.insert(weights.end(), {columns[k].r, columns[k + 1].g, columns[k + 2].b});
    return weights;
  }
  for (const Rgb& column : columns) {
    for (std::size_t plane = 0; plane < 3; ++plane) {
      weights.insert(weights.end(), {colour.colourMatrix[plane] * column.r,
                                     colour.colourMatrix[3 + plane] * column.g,
                                     colour.colourMatrix[6 + plane] * column.b});
    }
  }
  weights.insert(weights.end(), {0, 0, 0});
  return weights;
}

}  // namespace illum
