// One decoder and one encoder for each picture format, in memory. Decoders take untrusted bytes;
// their errors begin with `source`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "illum/picture.h"

namespace illum {

/// Samples as a PNG or JPEG stores them, palettes and transparent colours expanded: 1, 3 or 4
/// channels, alpha straight. One of the two pictures is empty.
struct StoredPicture {
  BytePicture bytes;
  PictureOf<std::uint16_t> words;  ///< where there are 16 bits a sample
  bool linear = false;             ///< else sRGB
};

StoredPicture decodePng(std::span<const std::byte> bytes, const std::filesystem::path& source);
StoredPicture decodeJpeg(std::span<const std::byte> bytes, const std::filesystem::path& source);
/// Linear Rec.709.
Picture decodeExr(std::span<const std::byte> bytes, const std::filesystem::path& source);

/// What a PNG says of its samples: Linear writes a gAMA of 1, Unsaid nothing, as is usual for
/// samples that are no colours.
enum class PngTransfer { Linear, Unsaid };

/// 16 bits a sample, 1, 3 or 4 channels, as they are.
std::vector<std::byte> encodePng(const PictureOf<std::uint16_t>& picture, PngTransfer transfer);

/// How an OpenEXR file keeps samples. Halves have 11 significant bits, to 65504.
enum class ExrSamples { Float, Half };

/// Floats as they are; halves are rounded to nearest. Throws Error (Fault::Input) for what is
/// beyond the range of halves, infinity excepted.
std::vector<std::byte> encodeExr(const Picture& linear, ExrSamples samples = ExrSamples::Float);

/// OpenEXR's densest schemes (DWA) keep 2 bytes of 64 equal samples and deflate them, at best to a
/// 1032nd.
inline constexpr double kExrSamplesPerByte = 64 / 2 * 1032;

inline constexpr int kMaxPictureSide = 65535;
inline constexpr std::uint64_t kMaxPicturePixels = 1ULL << 30;

/// Throws Error unless both sides are in 1 … kMaxPictureSide, the picture has at most
/// kMaxPicturePixels, and a file of `fileBytes` can hold its samples, of which a format packs at
/// most `samplesPerByte` into one byte. So that no memory is asked for on a header's word alone.
void checkPictureSize(const std::filesystem::path& source, std::int64_t width, std::int64_t height,
                      int channels, std::uint64_t fileBytes, double samplesPerByte);

}  // namespace illum
