// File names as people compare them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace illum {

/// ASCII letters only: other bytes of UTF-8 stay.
inline std::string lowerCase(std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

}  // namespace illum
