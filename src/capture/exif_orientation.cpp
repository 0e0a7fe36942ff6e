#include "capture/exif_orientation.h"

#include <cstdint>
#include <optional>

namespace illum {
namespace {

// Numbers of a TIFF structure (TIFF 6.0, section 2) in its own byte order; nothing beyond the end.
class TiffNumbers {
 public:
  explicit TiffNumbers(std::span<const std::byte> bytes)
      : bytes_(bytes), bigEndian_(!bytes.empty() && bytes[0] == std::byte{'M'}) {}

  std::optional<std::uint32_t> at(std::size_t place, std::size_t count) const {
    if (place > bytes_.size() || bytes_.size() - place < count) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t next = bigEndian_ ? i : count - 1 - i;
      value = value << 8 | std::to_integer<std::uint32_t>(bytes_[place + next]);
    }
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
  bool bigEndian_;
};

constexpr std::uint32_t kOrientationTag = 0x0112, kShort = 3;
constexpr std::size_t kEntryBytes = 12;

}  // namespace

Orientation orientationFromExif(std::span<const std::byte> tiff) {
  const TiffNumbers numbers(tiff);
  if (numbers.at(2, 2) != 42u) return {};
  const auto directory = numbers.at(4, 4);
  if (!directory) return {};
  const auto entries = numbers.at(*directory, 2);
  for (std::size_t i = 0; entries && i < *entries; ++i) {
    const std::size_t entry = *directory + 2 + i * kEntryBytes;
    const auto tag = numbers.at(entry, 2);
    if (!tag) return {};
    if (*tag != kOrientationTag || numbers.at(entry + 2, 2) != kShort) continue;
    const auto value = numbers.at(entry + 8, 2);
    if (value && *value >= 1 && *value <= 8) return {static_cast<int>(*value)};
    return {};
  }
  return {};
}

}  // namespace illum
