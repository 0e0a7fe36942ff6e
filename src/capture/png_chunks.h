// The chain of chunks of a PNG file (ISO/IEC 15948).
#pragma once

#include "capture/file_pool.h"

namespace illum {

/// Follows the chain to its IEND, so that a file that was cut off is noticed before anything is
/// decoded. Throws Error naming the photograph. True if the picture is interlaced.
bool checkPngChunks(FilePool& pool, std::size_t file);

}  // namespace illum
