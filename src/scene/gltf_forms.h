// The numbers by which glTF 2.0 names types (section 3.6.2.2).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace illum::gltf {

constexpr std::uint64_t kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125,
                        kFloat = 5126;

/// 0: there is no such type.
constexpr std::uint64_t bytesOfComponent(std::uint64_t type) {
  constexpr std::array<std::pair<std::uint64_t, std::uint64_t>, 6> kBytes{{{5120, 1},
                                                                           {kUnsignedByte, 1},
                                                                           {5122, 2},
                                                                           {kUnsignedShort, 2},
                                                                           {kUnsignedInt, 4},
                                                                           {kFloat, 4}}};
  for (const auto& [name, bytes] : kBytes)
    if (name == type) return bytes;
  return 0;
}

}  // namespace illum::gltf
