// The three types of sample that photographs are kept in until they are read.
#pragma once

#include <cstddef>

namespace illum {

enum class SampleType {
  Byte,   ///< std::uint8_t, 255 is white
  Word,   ///< std::uint16_t, 65535 is white
  Float,  ///< float, 1 is white
};

constexpr std::size_t bytesOf(SampleType type) {
  switch (type) {
    case SampleType::Byte:
      return 1;
    case SampleType::Word:
      return 2;
    case SampleType::Float:
      break;
  }
  return 4;
}

}  // namespace illum
