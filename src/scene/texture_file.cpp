#include "scene/texture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/files.h"
#include "illum/colour.h"
#include "illum/error.h"
#include "image/formats.h"
#include "oiio/oiio_module.h"

namespace illum {
namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMaxTexels = std::uint64_t{16384} * 16384;

/// A format by its first bytes; OpenImageIO's name of its reader.
struct Signature {
  std::string_view bytes;
  const char* reader;
};
using namespace std::string_view_literals;
constexpr std::array kSignatures{
    Signature{"\x89PNG"sv, "png"}, Signature{"\xff\xd8\xff"sv, "jpeg"},
    Signature{"RIFF"sv, "webp"},   Signature{"II*\0"sv, "tiff"},
    Signature{"MM\0*"sv, "tiff"},  Signature{"BM"sv, "bmp"},
    Signature{"GIF8"sv, "gif"},    Signature{"\x76\x2f\x31\x01"sv, "openexr"},
    Signature{"#?"sv, "hdr"},
};

/// TGA has no signature: it is what nothing else is and is called so.
const char* readerOf(std::span<const std::byte> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Signature& signature : kSignatures)
    if (text.starts_with(signature.bytes)) return signature.reader;
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".tga" ? "targa" : nullptr;
}

Error damaged(const std::string& name, std::string_view found) {
  return inputError(name, "a picture", found);
}

void checkTexels(int width, int height, const std::string& name) {
  if (width <= 0 || height <= 0 ||
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) > kMaxTexels)
    throw Error(Fault::Input,
                fmt::format("{}: expected a picture of at most 16384 x 16384 texels, found {} x {}",
                            name, width, height));
}

/// Before memory is asked for on a header's word. A few bytes of WebP may be any number of texels
/// of one colour; of all others OpenEXR packs most closely.
void checkSize(const OiioTexture& texture, const std::string& name, std::uint64_t fileBytes,
               bool webp) {
  checkTexels(texture.width, texture.channels > 0 ? texture.height : 0, name);
  checkPictureSize(name, texture.width, texture.height, texture.channels, fileBytes,
                   webp ? std::numeric_limits<double>::infinity() : kExrSamplesPerByte);
}

/// OpenImageIO's own reader prints what it finds wrong.
Picture texelsOfPng(std::span<const std::byte> bytes, const std::string& name, TextureUse use) {
  const StoredPicture stored = decodePng(bytes, name);
  const bool wide = stored.bytes.empty();
  const Size size = wide ? stored.words.size() : stored.bytes.size();
  const int channels = wide ? stored.words.channels() : stored.bytes.channels();
  checkTexels(size.width, size.height, name);
  Picture texels(size, channels);
  const auto fill = [&](const auto& samples, float white) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const float value = static_cast<float>(samples[i]) / white;
      const bool alpha = channels == 4 && i % 4 == 3;
      texels.samples()[i] = use == TextureUse::Colour && !alpha ? linearFromDisplay(value) : value;
    }
  };
  if (wide) fill(stored.words.samples(), 65535);
  if (!wide) fill(stored.bytes.samples(), 255);
  return texels;
}

/// Linear texels of 1, 3 or 4 channels.
Picture texelsOf(const OiioTexture& texture, TextureUse use) {
  const int stored = texture.channels;
  const bool grey = stored < 3, alpha = stored == 2 || stored >= 4;
  const int channels = alpha ? 4 : grey ? 1 : 3;
  const bool decode = use == TextureUse::Colour && !texture.storedAsFloats;
  Picture texels({texture.width, texture.height}, channels);
  for (std::size_t p = 0; p < texels.size().pixels(); ++p) {
    const float* from = texture.samples.data() + p * static_cast<std::size_t>(stored);
    float* to = texels.samples().data() + p * static_cast<std::size_t>(channels);
    for (int c = 0; c < std::min(channels, 3); ++c) {
      const float value = from[grey ? 0 : c];
      to[c] = decode ? linearFromDisplay(value) : value;
    }
    if (alpha) to[3] = from[stored == 2 ? 1 : 3];
  }
  return texels;
}

}  // namespace

Texture textureFromBytes(std::span<const std::byte> bytes, const std::string& name,
                         TextureUse use) {
  const char* reader = readerOf(bytes, name);
  if (reader == nullptr)
    throw damaged(name, bytes.empty() ? "an empty file" : "another kind of file");
  if (reader == "png"sv) return {name, texelsOfPng(bytes, name, use)};
  const OiioTexture texture =
      oiioModule(name, reader).readTexture(bytes, name, reader, [&](const OiioTexture& declared) {
        checkSize(declared, name, bytes.size(), reader == "webp"sv);
      });
  if (!std::ranges::all_of(texture.samples, [](float x) { return std::isfinite(x); }))
    throw damaged(name, "texels that are not finite");
  return {name, texelsOf(texture, use)};
}

Texture readTexture(const std::filesystem::path& file, TextureUse use) {
  return textureFromBytes(readFile(file, kMaxFileBytes), file.string(), use);
}

}  // namespace illum
