// PNG, JPEG and OpenEXR. Every reader here takes untrusted files: sizes are checked before memory
// is allocated, and a bad file is an Error.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "illum/picture.h"

namespace illum {

enum class PictureFormat { Png, Jpeg, Exr };

/// By the file name's ending (.png, .jpg, .jpeg, .exr, any case). Throws Error (Fault::Usage)
/// otherwise.
PictureFormat pictureFormat(const std::filesystem::path& file);

/// A PNG (8 or 16 bit), JPEG (grey or RGB) or flat OpenEXR file (R G B or Y, with or without A; its
/// data window) as linear light; the file's first bytes decide which. PNG and JPEG are taken as
/// sRGB (a PNG with gAMA 1.0 as linear), OpenEXR by its chromaticities; profiles and orientation
/// tags are not looked at. Alpha is premultiplied. 1, 3 or 4 channels.
Picture readPicture(const std::filesystem::path& file);

/// An 8-bit PNG or JPEG as it stands in the file, without any transfer function; palettes are
/// expanded. 1, 3 or 4 channels.
BytePicture readBytePicture(const std::filesystem::path& file);

/// Encoded in memory. PNG: 1, 3 or 4 channels, sRGB chunk. JPEG: 1 or 3 channels, 4:4:4, quality
/// 1-100.
std::vector<std::byte> encodePng(const BytePicture& picture);
std::vector<std::byte> encodeJpeg(const BytePicture& picture, int quality);

/// Replaces `file` atomically: written beside it, flushed, renamed. On any failure the old file
/// stays. PNG and JPEG (quality 95) take displayBytes(linear, exposureStops), JPEG over black where
/// there is alpha; EXR stores float32 linear unclamped (colours times 2^exposureStops), Rec.709
/// chromaticities, alpha premultiplied. A BytePicture goes to PNG, and without alpha to JPEG. The
/// same picture gives the same bytes.
void writePicture(const std::filesystem::path& file, const Picture& linear,
                  double exposureStops = 0);
void writePicture(const std::filesystem::path& file, const BytePicture& picture);

}  // namespace illum
