#include <algorithm>
#include <cassert>
#include <utility>

#include "basis/light_mesh.h"
#include "illum/basis_table.h"
#include "illum/error.h"

namespace illum {

LightBasis::LightBasis(BasisTable table, BasisColour colour)
    : table_(std::move(table)), colour_(colour) {
  const bool full = colour_.kind == BasisColour::Kind::Full;
  if (full && (table_.columns() < 3 || table_.columns() % 3 != 0)) {
    throw Error(Fault::Input,
                "basis table: expected three columns a plane and three for the mean, found " +
                    std::to_string(table_.columns()) + " columns");
  }
}

LightBasis::LightBasis(std::shared_ptr<const LightMesh> mesh) : mesh_(std::move(mesh)) {
  colour_.kind = BasisColour::Kind::Exact;
}

int LightBasis::planes() const {
  if (mesh_) return 3 * mesh_->lights();
  return colour_.kind == BasisColour::Kind::Full ? table_.columns() / 3 - 1 : 3 * table_.columns();
}

void LightBasis::evaluate(Direction d, std::span<float> out) const {
  assert(out.size() == evaluateSize());
  if (mesh_) {
    std::fill(out.begin(), out.end(), 0.0F);
    mesh_->forEachWeight(d, [&](std::size_t light, double weight) {
      for (std::size_t c = 0; c < 3; ++c) out[9 * light + 4 * c] += static_cast<float>(weight);
    });
  } else if (colour_.kind == BasisColour::Kind::Full) {
    table_.evaluate(d, out);
  } else {
    evaluateSeparable(d, out);
  }
}

std::vector<std::byte> LightBasis::encode() const {
  if (mesh_) return mesh_->encode();
  BasisTable table = table_;
  return table.encode();
}

void LightBasis::evaluateSeparable(Direction d, std::span<float> out) const {
  // Without a buffer: the J scalars go to the end of `out`, then block j of nine is written from
  // the front. Scalar j+1 lies at 8J + 4 + j >= 9j + 9, so no block overwrites one that is still
  // needed.
  const std::size_t columns = static_cast<std::size_t>(table_.columns());
  const std::span<float> scalars = out.last(columns);
  table_.evaluate(d, scalars);
  for (std::size_t j = 0; j < columns; ++j) {
    const float scalar = scalars[j];
    for (std::size_t plane = 0; plane < 3; ++plane) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const double weight = colour_.colourMatrix[3 * channel + plane];
        out[9 * j + 3 * plane + channel] = static_cast<float>(weight * scalar);
      }
    }
  }
  for (float& mean : out.last(3)) mean = 0;
}

}  // namespace illum
