// Parsing JSON that somebody else wrote.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace illum {

/// The parsed text. Throws Error for what is not JSON, for records that name a field twice and for
/// what nests deeper than a scene file can, before memory grows with it.
nlohmann::json guardedJson(std::string_view text, const std::string& source);

}  // namespace illum
