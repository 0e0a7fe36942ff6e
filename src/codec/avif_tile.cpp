#include <avif/avif.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "codec/atlas.h"
#include "codec/tile_decoders.h"
#include "illum/error.h"

namespace illum {
namespace {

struct DecoderDeleter {
  void operator()(avifDecoder* decoder) const { avifDecoderDestroy(decoder); }
};
using DecoderPointer = std::unique_ptr<avifDecoder, DecoderDeleter>;

/// One thread, no metadata, nothing larger than the layout says.
DecoderPointer createDecoder(Size atlas) {
  DecoderPointer decoder(avifDecoderCreate());
  if (!decoder) throw Error(Fault::Machine, "out of memory for an AVIF decoder");
  decoder->codecChoice = AVIF_CODEC_CHOICE_DAV1D;
  decoder->maxThreads = 1;
  decoder->ignoreExif = AVIF_TRUE;
  decoder->ignoreXMP = AVIF_TRUE;
  decoder->imageSizeLimit = static_cast<std::uint32_t>(atlas.pixels());
  decoder->imageDimensionLimit = static_cast<std::uint32_t>(std::max(atlas.width, atlas.height));
  decoder->imageCountLimit = 1;
  return decoder;
}

/// What differs from the one kind of AVIF that tiles are; empty if nothing does.
std::string_view differenceOf(const avifImage& image, int bits, Size atlas) {
  if (image.width != static_cast<std::uint32_t>(atlas.width) ||
      image.height != static_cast<std::uint32_t>(atlas.height))
    return "another size";
  if (image.depth != static_cast<std::uint32_t>(bits)) return "another depth";
  if (image.yuvFormat != AVIF_PIXEL_FORMAT_YUV444) return "subsampled channels";
  if (image.yuvRange != AVIF_RANGE_FULL) return "limited range";
  if (image.matrixCoefficients != AVIF_MATRIX_COEFFICIENTS_IDENTITY) return "a colour matrix";
  if (image.transformFlags != AVIF_TRANSFORM_NONE) return "a geometric transform";
  return {};
}

void check(avifResult result, const avifDecoder& decoder, const std::string& source) {
  if (result == AVIF_RESULT_OK) return;
  if (result == AVIF_RESULT_OUT_OF_MEMORY)
    throw Error(Fault::Machine, fmt::format("{}: out of memory", source));
  const char* detail = decoder.diag.error[0] != '\0' ? decoder.diag.error : "no detail";
  throw Error(Fault::Input,
              fmt::format("{}: expected an AVIF picture, found a damaged one ({}: {})", source,
                          avifResultToString(result), detail));
}

void checkKind(const avifImage& image, int bits, Size atlas, const std::string& source) {
  const std::string_view difference = differenceOf(image, bits, atlas);
  if (!difference.empty())
    throw Error(Fault::Input,
                fmt::format("{}: expected an AVIF of {}x{}, {} bits, 4:4:4, full range, identity "
                            "matrix, found {}",
                            source, atlas.width, atlas.height, bits, difference));
}

/// ITU-T H.273, matrix coefficients 0: Y carries green, U blue, V red.
template <typename Sample>
AtlasView<const Sample> viewOf(const avifImage& image) {
  AtlasView<const Sample> view;
  constexpr std::array<int, 3> kPlaneOfChannel{AVIF_CHAN_V, AVIF_CHAN_Y, AVIF_CHAN_U};
  for (std::size_t c = 0; c < 3; ++c) {
    view.channels[c] = reinterpret_cast<const Sample*>(image.yuvPlanes[kPlaneOfChannel[c]]);
    view.rowStride[c] = image.yuvRowBytes[kPlaneOfChannel[c]] / sizeof(Sample);
  }
  return view;
}

template <typename Sample>
void unpack(const AtlasView<const Sample>& view, const AtlasLayout& layout, PlaneCodes& codes) {
  for (int k = 0; k < layout.planes; ++k) {
    const CellOrigin origin = cellOrigin(layout, k / 3);
    std::uint16_t* out = codes.plane(k).data();
    for (int y = 0; y < layout.tile.height; ++y)
      out = std::copy_n(view.at(k % 3, origin.x, origin.y + y), layout.tile.width, out);
  }
}

}  // namespace

void decodeAvifCodes(std::span<const std::byte> file, int bits, const AtlasLayout& layout,
                     PlaneCodes& codes, const std::string& source) {
  const DecoderPointer decoder = createDecoder(layout.atlas());
  check(avifDecoderSetIOMemory(decoder.get(), reinterpret_cast<const std::uint8_t*>(file.data()),
                               file.size()),
        *decoder, source);
  check(avifDecoderParse(decoder.get()), *decoder, source);
  checkKind(*decoder->image, bits, layout.atlas(), source);
  if (decoder->alphaPresent != AVIF_FALSE || decoder->imageCount != 1)
    throw Error(Fault::Input, fmt::format("{}: expected an AVIF still without alpha, found another "
                                          "kind of AVIF",
                                          source));
  check(avifDecoderNextImage(decoder.get()), *decoder, source);
  // The container's word was checked above; the coded picture may disagree with it.
  checkKind(*decoder->image, bits, layout.atlas(), source);

  codes.values.resize(static_cast<std::size_t>(layout.planes) * layout.tile.pixels());
  if (bits > 8)
    unpack(viewOf<std::uint16_t>(*decoder->image), layout, codes);
  else
    unpack(viewOf<std::uint8_t>(*decoder->image), layout, codes);
}

}  // namespace illum
