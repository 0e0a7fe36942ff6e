#include <avif/avif.h>
#include <fmt/format.h>

#include <memory>

#include "encode/tile_encoders.h"
#include "illum/error.h"

namespace illum {
namespace {

struct ImageDeleter {
  void operator()(avifImage* image) const { avifImageDestroy(image); }
};
struct EncoderDeleter {
  void operator()(avifEncoder* encoder) const { avifEncoderDestroy(encoder); }
};
using ImagePointer = std::unique_ptr<avifImage, ImageDeleter>;
using EncoderPointer = std::unique_ptr<avifEncoder, EncoderDeleter>;

void check(avifResult result) {
  if (result != AVIF_RESULT_OK)
    throw Error(Fault::Machine,
                fmt::format("cannot encode an AVIF picture: {}", avifResultToString(result)));
}

/// BT.709 primaries, sRGB transfer, identity matrix, full range: nothing stands between the codes
/// and what a browser hands out.
ImagePointer createImage(Size atlas, int bits) {
  ImagePointer image(avifImageCreate(static_cast<std::uint32_t>(atlas.width),
                                     static_cast<std::uint32_t>(atlas.height),
                                     static_cast<std::uint32_t>(bits), AVIF_PIXEL_FORMAT_YUV444));
  if (!image) throw Error(Fault::Machine, "out of memory for an AVIF picture");
  image->yuvRange = AVIF_RANGE_FULL;
  image->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
  image->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_IDENTITY;
  check(avifImageAllocatePlanes(image.get(), AVIF_PLANES_YUV));
  return image;
}

/// ITU-T H.273, matrix coefficients 0: Y carries green, U blue, V red.
template <typename Sample>
AtlasView<Sample> viewOf(const avifImage& image) {
  AtlasView<Sample> view;
  constexpr std::array<int, 3> kPlaneOfChannel{AVIF_CHAN_V, AVIF_CHAN_Y, AVIF_CHAN_U};
  for (std::size_t c = 0; c < 3; ++c) {
    view.channels[c] = reinterpret_cast<Sample*>(image.yuvPlanes[kPlaneOfChannel[c]]);
    view.rowStride[c] = image.yuvRowBytes[kPlaneOfChannel[c]] / sizeof(Sample);
  }
  return view;
}

EncoderPointer createEncoder(const EncodeSettings& settings) {
  EncoderPointer encoder(avifEncoderCreate());
  if (!encoder) throw Error(Fault::Machine, "out of memory for an AVIF encoder");
  const int quantizer = avifQuantizer(settings.quality);
  encoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
  encoder->maxThreads = 1;
  encoder->speed = settings.speed;
  encoder->minQuantizer = quantizer;
  encoder->maxQuantizer = quantizer;
  const auto option = [&](const char* key, const char* value) {
    avifEncoderSetCodecSpecificOption(encoder.get(), key, value);
  };
  option("end-usage", "q");
  option("cq-level", std::to_string(quantizer).c_str());
  option("tune", "psnr");
  option("aq-mode", "0");
  option("deltaq-mode", "0");
  option("sb-size", "64");  // 0.5-1 % fewer bytes than 128 at equal error (docs/performance.md)
  return encoder;
}

std::vector<std::byte> write(avifEncoder& encoder, const avifImage& image) {
  avifRWData data = AVIF_DATA_EMPTY;
  const std::unique_ptr<avifRWData, void (*)(avifRWData*)> guard(&data, avifRWDataFree);
  check(avifEncoderWrite(&encoder, &image, &data));
  const auto* first = reinterpret_cast<const std::byte*>(data.data);
  return {first, first + data.size};
}

}  // namespace

std::vector<std::byte> encodeAvifCodes(const PlaneCodes& codes, int bits, const AtlasLayout& layout,
                                       const EncodeSettings& settings) {
  const ImagePointer image = createImage(layout.atlas(), bits);
  if (bits > 8)
    fillAtlas(viewOf<std::uint16_t>(*image), layout, codes,
              static_cast<std::uint16_t>(1 << (bits - 1)));
  else
    fillAtlas(viewOf<std::uint8_t>(*image), layout, codes, std::uint8_t{128});
  return write(*createEncoder(settings), *image);
}

}  // namespace illum
