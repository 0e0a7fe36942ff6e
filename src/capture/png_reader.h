// PNG photographs, by libpng itself: OpenImageIO's reader lets libpng print.
#pragma once

#include "capture/photo_reader.h"

namespace illum {

/// As readHeader and openReader, for files that begin as PNG files do.
PhotographHeader readPngHeader(FilePool& pool, std::size_t file);
std::unique_ptr<PhotographReader> openPngReader(FilePool& pool, std::size_t file,
                                                const PhotographHeader& header);

}  // namespace illum
