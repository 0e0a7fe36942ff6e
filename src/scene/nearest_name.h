// What somebody may have meant who wrote a name that does not exist.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace illum {

/// The one of `known` that takes the fewest single-character edits (Levenshtein 1966), letter case
/// not counting; empty where all are further away than a third of the name.
std::string nearestName(std::string_view name, std::span<const std::string_view> known);

}  // namespace illum
