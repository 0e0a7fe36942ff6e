// A look at an OpenEXR file's header before the library sees it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace illum {

/// OpenEXR 3.1 allocates attributes, rows and tiles by the sizes that a header declares. This walks
/// the header and throws Error unless the file is a flat picture of one part, every attribute lies
/// within the file, and the file is long enough for the rows and tiles that it declares.
void checkExrHeader(std::span<const std::byte> bytes, const std::filesystem::path& source);

}  // namespace illum
