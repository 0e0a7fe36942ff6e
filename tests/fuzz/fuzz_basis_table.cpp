// basis.bin: a table that decodes can be looked up everywhere and survives its own encoding.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "illum/basis_table.h"
#include "illum/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const illum::BasisTable table =
        illum::BasisTable::decode({reinterpret_cast<const std::byte*>(data), size}, "basis.bin");
    std::vector<float> values(static_cast<std::size_t>(table.columns()));
    for (const illum::Vector3 v : {illum::Vector3{0, 0, 1}, illum::Vector3{0, 0, -1},
                                   illum::Vector3{1, 0, 0}, illum::Vector3{-0.3, 0.9, -0.2}}) {
      table.evaluate(illum::Direction::fromVector(v), values);
      for (const float value : values)
        if (!std::isfinite(value)) std::abort();
    }
  } catch (const illum::Error&) {
  }
  return 0;
}
