#include "scene/uri.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace illum {
namespace {

bool isHexDigit(char c) {
  return std::isxdigit(static_cast<unsigned char>(c)) != 0;
}

/// Of a name without escapes.
bool nameStaysBelow(std::string_view name) {
  constexpr std::string_view kSeparators = "/\\";
  const bool odd = std::ranges::any_of(
      name, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0 || c == ':'; });
  if (name.empty() || odd || kSeparators.find(name.front()) != std::string_view::npos) return false;
  int depth = 0;
  while (!name.empty() && depth >= 0) {
    const std::string_view part = name.substr(0, name.find_first_of(kSeparators));
    if (part == "..") --depth;
    if (part != ".." && part != "." && !part.empty()) ++depth;
    name.remove_prefix(std::min(part.size() + 1, name.size()));
  }
  return depth > 0;
}

}  // namespace

std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && isHexDigit(text[i + 1]) &&
        isHexDigit(text[i + 2])) {
      out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

bool staysBelow(const std::string& uri) {
  return nameStaysBelow(uri) && nameStaysBelow(unescaped(uri));
}

}  // namespace illum
