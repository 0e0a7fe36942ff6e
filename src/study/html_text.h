// Text from files inside HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace illum {

/// `text` as it may stand in an element or a quoted attribute: markup characters as entities,
/// control characters (which HTML forbids) as U+FFFD. Any bytes are safe.
std::string htmlText(std::string_view text);

}  // namespace illum
