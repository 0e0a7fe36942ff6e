// JPEG photographs, by libjpeg-turbo itself: rows go from the decoder to where they stay without a
// copy.
#pragma once

#include "capture/photo_reader.h"

namespace illum {

/// As readHeader and openReader, for files that begin as JPEG files do.
PhotographHeader readJpegHeader(FilePool& pool, std::size_t file);
std::unique_ptr<PhotographReader> openJpegReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header);

}  // namespace illum
