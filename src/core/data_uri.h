// Bytes within a text: the "data:" addresses of HTML and glTF (RFC 2397, RFC 4648).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace illum {

/// "data:image/png;base64,...".
std::string dataUri(std::string_view mediaType, std::span<const std::byte> bytes);

/// What such a text holds; nothing if it is none, or not in base 64. Untrusted input is safe.
std::optional<std::vector<std::byte>> bytesOfDataUri(std::string_view uri);

}  // namespace illum
