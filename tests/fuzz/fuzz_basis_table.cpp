// basis.bin: a table, or a mesh of lights, that decodes can be looked up everywhere.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "basis/light_mesh.h"
#include "illum/basis_table.h"
#include "illum/error.h"

namespace {

constexpr illum::Vector3 kPlaces[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-0.3, 0.9, -0.2}};

void lookUp(const illum::BasisTable& table) {
  std::vector<float> values(static_cast<std::size_t>(table.columns()));
  for (const illum::Vector3 v : kPlaces) {
    table.evaluate(illum::Direction::fromVector(v), values);
    for (const float value : values)
      if (!std::isfinite(value)) std::abort();
  }
}

void lookUp(const illum::LightMesh& mesh) {
  for (const illum::Vector3 v : kPlaces) {
    double sum = 0;
    mesh.forEachWeight(illum::Direction::fromVector(v), [&](std::size_t light, double weight) {
      if (light >= static_cast<std::size_t>(mesh.lights()) || weight < 0) std::abort();
      sum += weight;
    });
    if (!(std::abs(sum - 1) < 1e-9)) std::abort();
  }
}

template <typename Basis>
void decodeAndLookUp(std::span<const std::byte> bytes) {
  try {
    lookUp(Basis::decode(bytes, "basis.bin"));
  } catch (const illum::Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  decodeAndLookUp<illum::BasisTable>(bytes);
  decodeAndLookUp<illum::LightMesh>(bytes);
  return 0;
}
