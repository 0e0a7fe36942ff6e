// WebP photographs, by libwebp itself: OpenImageIO 2.4 leaves out orientation and profile, and
// premultiplies.
#pragma once

#include "capture/photo_reader.h"

namespace illum {

/// As readHeader and openReader, for files that begin as WebP files do.
PhotographHeader readWebpHeader(FilePool& pool, std::size_t file);
std::unique_ptr<PhotographReader> openWebpReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header);

}  // namespace illum
