// How files of JSON are laid out.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace illum::fields {

/// What nests and is long goes over several lines, all else on one. Bytes that are not UTF-8 become
/// U+FFFD.
std::string jsonText(const nlohmann::ordered_json& root);

}  // namespace illum::fields
