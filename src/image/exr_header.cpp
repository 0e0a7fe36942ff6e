#include "image/exr_header.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "illum/error.h"
#include "image/formats.h"

namespace illum {
namespace {

// "OpenEXR File Layout", openexr.com: a magic number, a version with flags, then attributes of the
// form name \0 type \0 length value, and an empty name at the end. Numbers are little endian.
constexpr std::uint32_t kNonFlatFlags = 0x1800;  // deep data, several parts

struct Attribute {
  std::string_view name, type;
  std::span<const std::byte> value;
};

std::uint32_t number(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

std::int64_t signedNumber(std::span<const std::byte> bytes, std::size_t offset) {
  return std::bit_cast<std::int32_t>(number(bytes, offset));
}

/// Rows that are compressed together, by the number of the compression.
std::int64_t rowsInBlock(unsigned compression) {
  constexpr std::int64_t kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  return compression < std::size(kRows) ? kRows[compression] : 256;
}

class HeaderWalk {
 public:
  HeaderWalk(std::span<const std::byte> bytes, const std::filesystem::path& source)
      : file_(bytes), rest_(bytes), source_(source) {}

  void check() {
    if (rest_.size() < 8) throw damaged("the file ends early");
    if ((number(rest_, 4) & kNonFlatFlags) != 0)
      throw inputError(source_, "a flat OpenEXR picture of one part", "deep data or several parts");
    rest_ = rest_.subspan(8);
    for (Attribute attribute = next(); !attribute.name.empty(); attribute = next()) take(attribute);
    checkSizes();
  }

 private:
  Error damaged(std::string_view what) const {
    return inputError(source_, "a sound OpenEXR picture", what);
  }

  std::string_view nextText() {
    const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
    if (end == rest_.end()) throw damaged("a header without end");
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    const std::string_view text(reinterpret_cast<const char*>(rest_.data()), length);
    rest_ = rest_.subspan(length + 1);
    return text;
  }

  Attribute next() {
    Attribute attribute;
    attribute.name = nextText();
    if (attribute.name.empty()) return attribute;
    attribute.type = nextText();
    if (rest_.size() < 4 || number(rest_, 0) > rest_.size() - 4)
      throw damaged("an attribute that is longer than the file");
    attribute.value = rest_.subspan(4, number(rest_, 0));
    rest_ = rest_.subspan(4 + attribute.value.size());
    return attribute;
  }

  void take(const Attribute& attribute) {
    const std::span<const std::byte> value = attribute.value;
    if (attribute.name == "dataWindow" && value.size() == 16) {
      width_ = signedNumber(value, 8) - signedNumber(value, 0) + 1;
      height_ = signedNumber(value, 12) - signedNumber(value, 4) + 1;
    } else if (attribute.name == "compression" && value.size() == 1) {
      blockRows_ = rowsInBlock(std::to_integer<unsigned>(value[0]));
    } else if (attribute.name == "channels") {
      channels_ = countChannels(value);
    } else if (attribute.name == "tiles" && value.size() == 9) {
      tiled_ = true;
      tileWidth_ = number(value, 0);
      tileHeight_ = number(value, 4);
    } else if (attribute.type == "preview") {
      checkPreview(value);
    }
  }

  /// Each channel is a name, a zero and 16 bytes; a zero ends the list.
  static int countChannels(std::span<const std::byte> list) {
    int count = 0;
    while (!list.empty() && list[0] != std::byte{0}) {
      const auto end = std::find(list.begin(), list.end(), std::byte{0});
      const auto length = static_cast<std::size_t>(end - list.begin());
      list = list.subspan(std::min(list.size(), length + 17));
      ++count;
    }
    return count;
  }

  void checkPreview(std::span<const std::byte> value) const {
    const bool whole = value.size() >= 8 &&
                       std::uint64_t{number(value, 0)} * number(value, 4) == (value.size() - 8) / 4;
    if (!whole) throw damaged("a preview of another size than it declares");
  }

  void checkSizes() const {
    checkPictureSize(source_, width_, height_, channels_, file_.size(), kExrSamplesPerByte);
    checkBlock(width_, blockRows_);
    if (!tiled_) return;
    if (tileWidth_ == 0 || tileHeight_ == 0) throw damaged("tiles without pixels");
    checkBlock(tileWidth_, tileHeight_);
    // The table of tiles holds eight bytes for each.
    const std::int64_t columns = (width_ + tileWidth_ - 1) / tileWidth_;
    const std::int64_t rows = (height_ + tileHeight_ - 1) / tileHeight_;
    if (static_cast<std::uint64_t>(columns * rows) > file_.size() / 8)
      throw damaged("more tiles than the file can hold");
  }

  /// Blocks and tiles may exceed the picture; a few million samples are granted to every file.
  void checkBlock(std::int64_t width, std::int64_t height) const {
    constexpr double kGranted = 1 << 22;
    const double samples =
        static_cast<double>(width) * static_cast<double>(height) * static_cast<double>(channels_);
    if (samples > kGranted + kExrSamplesPerByte * static_cast<double>(file_.size()))
      throw damaged("blocks larger than the file can hold");
  }

  std::span<const std::byte> file_, rest_;
  const std::filesystem::path& source_;
  std::int64_t width_ = 0, height_ = 0;
  std::int64_t blockRows_ = 256;
  bool tiled_ = false;
  std::int64_t tileWidth_ = 0, tileHeight_ = 0;
  int channels_ = 0;
};

}  // namespace

void checkExrHeader(std::span<const std::byte> bytes, const std::filesystem::path& source) {
  HeaderWalk(bytes, source).check();
}

}  // namespace illum
