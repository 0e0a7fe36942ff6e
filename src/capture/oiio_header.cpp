#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>

#include "capture/oiio_picture.h"
#include "capture/oiio_reader.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kKibibyte = 1024;

struct Cost {
  bool sequential = true;
  std::uint64_t bytes = 0;
};

// What OpenImageIO 2.4 holds while a picture is open; oiio_reader's tests hold it to what is
// measured.
Cost costOf(const OIIO::ImageSpec& spec, PhotographFormat format, std::uint64_t fileBytes,
            bool packedBmp) {
  const std::uint64_t row = spec.scanline_bytes(true) + 4u * static_cast<unsigned>(spec.width);
  const auto height = static_cast<std::uint64_t>(spec.height);
  const std::uint64_t pixels = height * static_cast<unsigned>(spec.width);
  const auto together = static_cast<unsigned>(rowsTogether(spec, format));
  switch (format) {
    case PhotographFormat::Tiff:
      if (together == 0) return {false, fileBytes + 256 * kKibibyte + (kOiioRowsPerCall + 4) * row};
      return {spec.get_string_attribute("planarconfig") != "separate",
              256 * kKibibyte + 4 * together * row};
    case PhotographFormat::OpenExr:
      return {true, 640 * kKibibyte + 5 * together * row};
    case PhotographFormat::Bmp:
      return {!packedBmp, 64 * kKibibyte + 4 * row + (packedBmp ? row * height + fileBytes : 0)};
    case PhotographFormat::Hdr:
    case PhotographFormat::Dpx:
      return {true, 128 * kKibibyte + 4 * row};
    case PhotographFormat::Sgi:
      return {true, 128 * kKibibyte + 4 * row + 32 * height};
    case PhotographFormat::Targa:
      return {false, 64 * kKibibyte + row * (height + kOiioRowsPerCall)};
    case PhotographFormat::Pnm:
      return {false, fileBytes + 64 * kKibibyte + kOiioRowsPerCall * row};
    default:
      return {false, fileBytes + 24 * pixels};
  }
}

// What relates the samples to light, as far as the format itself tells.
void readTransfer(const OIIO::ImageSpec& spec, const std::filesystem::path& path,
                  PhotographHeader& header) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  std::string lower = space;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == "kodaklog") throw inputError(path, "linear or sRGB values", "logarithmic ones");
  if (lower == "linear" || header.format == PhotographFormat::Raw ||
      header.type == SampleType::Float) {
    header.transfer = Transfer::Linear;
    return;
  }
  const double gamma = spec.get_float_attribute("oiio:Gamma", 0.0f);
  const bool told = lower.starts_with("gamma") && std::isfinite(gamma) && gamma > 0.1 && gamma < 10;
  // 1/0.45455, as most programs write it, means sRGB.
  if (!told || std::abs(gamma - 2.2) < 0.05) return;
  if (std::abs(gamma - 1) < 0.01) {
    header.transfer = Transfer::Linear;
  } else {
    header.gamma = gamma;
  }
}

std::vector<std::byte> profileOf(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
  if (profile == nullptr || profile->type().basesize() != 1) return {};
  const auto* bytes = static_cast<const std::byte*>(profile->data());
  return {bytes, bytes + profile->datasize()};
}

void refuseWhatIsNoPhotograph(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
  if (spec.width < 1 || spec.height < 1) throw inputError(path, "a picture", "an empty one");
  if (spec.deep || spec.depth > 1) throw inputError(path, "a flat picture", "a deep one");
  if (spec.nchannels < 1) throw inputError(path, "a picture with channels", "none");
  if (spec.get_int_attribute("tiff:PhotometricInterpretation", 0) == 5 ||
      spec.get_string_attribute("tiff:ColorSpace") == "CMYK") {
    throw inputError(path, "a grey or RGB picture", "one for print (CMYK)");
  }
  const bool cropped =
      spec.full_width > 0 && (spec.x != spec.full_x || spec.y != spec.full_y ||
                              spec.width != spec.full_width || spec.height != spec.full_height);
  if (cropped) {
    throw inputError(path, "a data window equal to the display window", "a cropped picture");
  }
}

bool isPackedBmp(std::span<const std::byte> head) {
  constexpr std::size_t kCompressionAt = 30;
  if (head.size() <= kCompressionAt) return false;
  const auto compression = std::to_integer<int>(head[kCompressionAt]);
  return compression == 1 || compression == 2;
}

}  // namespace

PhotographHeader readOiioHeader(FilePool& pool, std::size_t file, PhotographFormat format,
                                std::span<const std::byte> head) {
  const std::filesystem::path path = pool.path(file);
  OiioPicture picture(pool, file, format);
  const OIIO::ImageSpec& spec = picture.spec();
  refuseWhatIsNoPhotograph(spec, path);

  PhotographHeader header;
  header.format = format;
  header.stored = {spec.width, spec.height};
  const int orientation = spec.get_int_attribute("Orientation", 1);
  header.orientation = {orientation >= 1 && orientation <= 8 ? orientation : 1};
  const OiioChannels choice = chooseChannels(spec, format, path);
  header.colours = choice.colours;
  header.alpha = choice.alpha;
  header.type = sampleTypeOf(spec);
  header.profile = profileOf(spec);
  readTransfer(spec, path, header);
  const Cost cost =
      costOf(spec, format, pool.bytes(file), format == PhotographFormat::Bmp && isPackedBmp(head));
  header.sequential = cost.sequential;
  // Our own chunk of rows comes on top, twice where its type changes, as does the header's copy.
  header.decoderBytes =
      cost.bytes + header.profile.size() +
      2 * header.rowBytes() *
          static_cast<unsigned>(std::max(rowsTogether(spec, format), kOiioRowsPerCall));
  return header;
}

}  // namespace illum
