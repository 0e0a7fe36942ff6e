// A picture that says where the object is.
#pragma once

#include "capture/file_pool.h"
#include "illum/picture.h"

namespace illum {

/// Coverage, one channel: the picture's grey (the mean of its colours) times its alpha, as it
/// stands in the file, upright. Throws Error if its size is not `expected` or it cannot be read
/// within `memoryBytes`.
BytePicture readMaskPicture(FilePool& pool, std::size_t file, Size expected,
                            std::uint64_t memoryBytes);

}  // namespace illum
