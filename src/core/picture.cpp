#include "illum/picture.h"

#include <cmath>

#include "illum/colour.h"

namespace illum {
namespace {

void encodeOpaqueRow(std::span<const float> linear, float scale, std::span<std::uint8_t> bytes) {
  for (std::size_t i = 0; i < linear.size(); ++i)
    bytes[i] = displayByteFromLinear(scale * linear[i]);
}

void encodeAlphaRow(std::span<const float> linear, float scale, std::span<std::uint8_t> bytes) {
  for (std::size_t i = 0; i < linear.size(); i += 4) {
    const float alpha = linear[i + 3];
    const float straighten = alpha > 0 ? scale / alpha : 0;
    for (std::size_t c = 0; c < 3; ++c)
      bytes[i + c] = displayByteFromLinear(straighten * linear[i + c]);
    bytes[i + 3] = byteFromUnit(alpha);
  }
}

}  // namespace

BytePicture displayBytes(const Picture& linear, double exposureStops) {
  BytePicture bytes(linear.size(), linear.channels());
  const auto scale = static_cast<float>(std::exp2(exposureStops));
  for (int y = 0; y < linear.height(); ++y) {
    if (linear.channels() == 4) {
      encodeAlphaRow(linear.row(y), scale, bytes.row(y));
    } else {
      encodeOpaqueRow(linear.row(y), scale, bytes.row(y));
    }
  }
  return bytes;
}

}  // namespace illum
