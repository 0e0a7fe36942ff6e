// Text from files inside HTML and SVG.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace illum {

/// `text` as it may stand in an element or a quoted attribute: markup characters as entities,
/// control characters (which HTML forbids) as U+FFFD. Any bytes are safe.
std::string htmlText(std::string_view text);

/// "data:image/png;base64,..." (RFC 2397, RFC 4648).
std::string dataUri(std::string_view mediaType, std::span<const std::byte> bytes);

}  // namespace illum
