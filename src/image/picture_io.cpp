#include "illum/picture_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/files.h"
#include "illum/colour.h"
#include "illum/error.h"
#include "image/formats.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxFileBytes = 8ULL << 30;
constexpr int kJpegQuality = 95;

bool beginsWith(std::span<const std::byte> bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

/// By the first bytes, which cannot be misnamed.
PictureFormat formatOf(std::span<const std::byte> bytes, const fs::path& file) {
  if (beginsWith(bytes, "\x89PNG\r\n\x1A\n")) return PictureFormat::Png;
  if (beginsWith(bytes, "\xFF\xD8\xFF")) return PictureFormat::Jpeg;
  if (beginsWith(bytes, "\x76\x2F\x31\x01")) return PictureFormat::Exr;
  throw inputError(file, "a PNG, JPEG or OpenEXR picture",
                   bytes.empty() ? "an empty file" : "something else");
}

/// Linear light of every value that a sample of type T can have.
template <typename T>
std::vector<float> linearTable(bool linear) {
  constexpr std::size_t kValues = std::size_t{1} << (8 * sizeof(T));
  std::vector<float> table(kValues);
  for (std::size_t i = 0; i < kValues; ++i) {
    const auto unit = static_cast<float>(static_cast<double>(i) / (kValues - 1));
    table[i] = linear ? unit : linearFromDisplay(unit);
  }
  return table;
}

void premultiply(std::span<float> rgba) {
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) rgba[i + c] *= rgba[i + 3];
}

template <typename T>
Picture linearPicture(const PictureOf<T>& stored, bool linear) {
  const std::vector<float> table = linearTable<T>(linear);
  constexpr float kMaxValue = static_cast<float>(static_cast<T>(~T{0}));
  Picture picture(stored.size(), stored.channels());
  const std::span<const T> from = stored.samples();
  const std::span<float> to = picture.samples();
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = table[from[i]];
  if (stored.channels() != 4) return picture;
  for (std::size_t i = 3; i < from.size(); i += 4) to[i] = static_cast<float>(from[i]) / kMaxValue;
  premultiply(to);
  return picture;
}

Picture linearPicture(const StoredPicture& stored) {
  return stored.bytes.empty() ? linearPicture(stored.words, stored.linear)
                              : linearPicture(stored.bytes, stored.linear);
}

Picture exposed(const Picture& linear, double exposureStops) {
  Picture result = linear;
  const auto scale = static_cast<float>(std::exp2(exposureStops));
  const std::size_t step = linear.channels() == 4 ? 4 : 1;
  for (std::size_t i = 0; i < result.samples().size(); i += step)
    for (std::size_t c = 0; c < std::min<std::size_t>(step, 3); ++c)
      result.samples()[i + c] *= scale;
  return result;
}

/// What premultiplied colours are over black.
Picture withoutAlpha(const Picture& rgba) {
  Picture rgb(rgba.size(), 3);
  for (int y = 0; y < rgb.height(); ++y)
    for (int x = 0; x < rgb.width(); ++x)
      for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = rgba.at(x, y, c);
  return rgb;
}

}  // namespace

void checkPictureSize(const fs::path& source, std::int64_t width, std::int64_t height, int channels,
                      std::uint64_t fileBytes, double samplesPerByte) {
  const auto found = [&] { return fmt::format("{} x {}", width, height); };
  if (width < 1 || height < 1 || width > kMaxPictureSide || height > kMaxPictureSide)
    throw inputError(source, fmt::format("sides of 1 to {} pixels", kMaxPictureSide), found());
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > kMaxPicturePixels)
    throw inputError(source, fmt::format("at most {} pixels", kMaxPicturePixels), found());
  if (static_cast<double>(pixels) * channels > samplesPerByte * static_cast<double>(fileBytes))
    throw inputError(source, fmt::format("data for {} pixels", found()),
                     fmt::format("a file of only {} bytes", fileBytes));
}

PictureFormat pictureFormat(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c;
  });
  if (ending == ".png") return PictureFormat::Png;
  if (ending == ".jpg" || ending == ".jpeg") return PictureFormat::Jpeg;
  if (ending == ".exr") return PictureFormat::Exr;
  throw Error(Fault::Usage,
              fmt::format("{}: expected a picture's name that ends in .png, .jpg, .jpeg or .exr",
                          file.string()));
}

Picture readPicture(const fs::path& file) {
  const std::vector<std::byte> bytes = readFile(file, kMaxFileBytes);
  switch (formatOf(bytes, file)) {
    case PictureFormat::Png:
      return linearPicture(decodePng(bytes, file));
    case PictureFormat::Jpeg:
      return linearPicture(decodeJpeg(bytes, file));
    case PictureFormat::Exr:
      break;
  }
  return decodeExr(bytes, file);
}

BytePicture readBytePicture(const fs::path& file) {
  const std::vector<std::byte> bytes = readFile(file, kMaxFileBytes);
  const PictureFormat format = formatOf(bytes, file);
  if (format == PictureFormat::Exr)
    throw inputError(file, "an 8-bit PNG or JPEG", "an OpenEXR picture");
  StoredPicture stored =
      format == PictureFormat::Png ? decodePng(bytes, file) : decodeJpeg(bytes, file);
  if (stored.bytes.empty()) throw inputError(file, "an 8-bit PNG or JPEG", "16 bits a sample");
  return std::move(stored.bytes);
}

void writePicture(const fs::path& file, const Picture& linear, double exposureStops) {
  switch (pictureFormat(file)) {
    case PictureFormat::Exr:
      writeFileAtomically(file,
                          encodeExr(exposureStops == 0 ? linear : exposed(linear, exposureStops)));
      return;
    case PictureFormat::Jpeg:
      if (linear.channels() == 4) {
        writePicture(file, displayBytes(withoutAlpha(linear), exposureStops));
        return;
      }
      [[fallthrough]];
    case PictureFormat::Png:
      writePicture(file, displayBytes(linear, exposureStops));
      return;
  }
}

void writePicture(const fs::path& file, const BytePicture& picture) {
  switch (pictureFormat(file)) {
    case PictureFormat::Png:
      writeFileAtomically(file, encodePng(picture));
      return;
    case PictureFormat::Jpeg:
      writeFileAtomically(file, encodeJpeg(picture, kJpegQuality));
      return;
    case PictureFormat::Exr:
      throw Error(
          Fault::Usage,
          fmt::format("{}: expected .png or .jpg for display-referred samples", file.string()));
  }
}

}  // namespace illum
