#pragma once

namespace illum {

/// The library's version; the file format has its own (docs/format.md).
inline constexpr const char* kVersion = "0.1.0";

}  // namespace illum
