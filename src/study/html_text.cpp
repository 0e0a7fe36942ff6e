#include "study/html_text.h"

#include <algorithm>
#include <cstdint>

namespace illum {
namespace {

constexpr std::string_view kBase64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string_view entityOf(char character) {
  switch (character) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

/// Up to three bytes as four characters.
void appendGroup(std::span<const std::byte> bytes, std::string& text) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i)
    bits = bits << 8 | (i < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i]) : 0);
  for (std::size_t i = 0; i < 4; ++i)
    text += i <= bytes.size() ? kBase64[bits >> (18 - 6 * i) & 63] : '=';
}

}  // namespace

std::string htmlText(std::string_view text) {
  std::string escaped;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (const std::string_view entity = entityOf(character); !entity.empty()) {
      escaped += entity;
    } else if (byte < 0x20 || byte == 0x7f) {
      escaped += "\uFFFD";
    } else {
      escaped += character;
    }
  }
  return escaped;
}

std::string dataUri(std::string_view mediaType, std::span<const std::byte> bytes) {
  std::string uri = "data:" + std::string(mediaType) + ";base64,";
  uri.reserve(uri.size() + bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3)
    appendGroup(bytes.subspan(i, std::min<std::size_t>(3, bytes.size() - i)), uri);
  return uri;
}

}  // namespace illum
