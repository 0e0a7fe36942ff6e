// The orientation tag of an Exif block.
#pragma once

#include <cstddef>
#include <span>

#include "capture/orientation.h"

namespace illum {

/// `tiff`: the TIFF structure inside an Exif block, without the "Exif\0\0" before it. Upright if
/// the block is damaged or does not tell. Untrusted input is safe.
Orientation orientationFromExif(std::span<const std::byte> tiff);

}  // namespace illum
