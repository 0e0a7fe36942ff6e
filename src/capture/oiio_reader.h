// Photographs of every other format, by OpenImageIO.
#pragma once

#include "capture/photo_reader.h"

namespace illum {

/// As readHeader and openReader, for a file whose format is known and whose first bytes are `head`.
PhotographHeader readOiioHeader(FilePool& pool, std::size_t file, PhotographFormat format,
                                std::span<const std::byte> head);
std::unique_ptr<PhotographReader> openOiioReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header);

}  // namespace illum
