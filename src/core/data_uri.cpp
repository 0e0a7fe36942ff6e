#include "core/data_uri.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace illum {
namespace {

constexpr std::string_view kBase64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::string_view kMark = ";base64,";

/// Up to three bytes as four characters.
void appendGroup(std::span<const std::byte> bytes, std::string& text) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i)
    bits = bits << 8 | (i < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i]) : 0);
  for (std::size_t i = 0; i < 4; ++i)
    text += i <= bytes.size() ? kBase64[bits >> (18 - 6 * i) & 63] : '=';
}

/// The number of each character, 64 for one that base 64 does not have.
constexpr std::array<std::uint8_t, 256> kSixBits = [] {
  std::array<std::uint8_t, 256> table{};
  table.fill(64);
  for (std::size_t i = 0; i < kBase64.size(); ++i)
    table[static_cast<unsigned char>(kBase64[i])] = static_cast<std::uint8_t>(i);
  return table;
}();

}  // namespace

std::string dataUri(std::string_view mediaType, std::span<const std::byte> bytes) {
  std::string uri = "data:" + std::string(mediaType) + std::string(kMark);
  uri.reserve(uri.size() + bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3)
    appendGroup(bytes.subspan(i, std::min<std::size_t>(3, bytes.size() - i)), uri);
  return uri;
}

std::optional<std::vector<std::byte>> bytesOfDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!uri.starts_with("data:") || comma == std::string_view::npos ||
      !uri.substr(0, comma + 1).ends_with(kMark))
    return std::nullopt;
  std::string_view text = uri.substr(comma + 1);
  for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char character : text) {
    const std::uint8_t six = kSixBits[static_cast<unsigned char>(character)];
    if (six == 64) return std::nullopt;
    bits = bits << 6 | six;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held));
  }
  return bytes;
}

}  // namespace illum
