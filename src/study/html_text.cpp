#include "study/html_text.h"

namespace illum {
namespace {

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

}  // namespace illum
