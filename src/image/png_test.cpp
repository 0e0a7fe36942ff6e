#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <functional>

#include "core/files.h"
#include "illum/picture_io.h"
#include "image/formats.h"
#include "image/hostile_bytes_for_test.h"

namespace illum {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

using Bytes = std::vector<std::byte>;

StoredPicture decode(std::span<const std::byte> bytes) {
  return decodePng(bytes, "hostile");
}
Size sizeOf(const StoredPicture& stored) {
  return stored.bytes.empty() ? stored.words.size() : stored.bytes.size();
}
/// For the functions of hostile_bytes_for_test.h.
BytePicture decodeAny(std::span<const std::byte> bytes) {
  return {sizeOf(decode(bytes)), 1};
}

/// A PNG of any kind; `describe` may add chunks before the pixels. Rows are packed as in the file.
Bytes makePng(Size size, int colourType, int bitDepth, const std::vector<Bytes>& rows,
              int interlace = PNG_INTERLACE_NONE,
              const std::function<void(png_structp, png_infop)>& describe = {}) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, std::size_t length) {
        const auto* first = reinterpret_cast<const std::byte*>(data);
        auto* all = static_cast<Bytes*>(png_get_io_ptr(writer));
        all->insert(all->end(), first, first + length);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(size.width),
               static_cast<png_uint_32>(size.height), bitDepth, colourType, interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (describe) describe(png, info);
  png_write_info(png, info);
  std::vector<Bytes> copies = rows;
  std::vector<png_bytep> pointers;
  for (Bytes& row : copies) pointers.push_back(reinterpret_cast<png_bytep>(row.data()));
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

Bytes rowOf(std::initializer_list<int> values) {
  Bytes row;
  for (const int value : values) row.push_back(static_cast<std::byte>(value));
  return row;
}

BytePicture gradient(Size size, int channels) {
  BytePicture picture(size, channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < channels; ++c)
        picture.at(x, y, c) = static_cast<std::uint8_t>(x * 3 + y * 5 + c * 70 + x * y % 7);
  return picture;
}

TEST(Png, RoundTrips) {
  for (const int channels : {1, 3, 4}) {
    for (const Size size :
         {Size{1, 1}, Size{7, 5}, Size{65535, 1}, Size{1, 3000}, Size{300, 200}}) {
      const BytePicture picture = gradient(size, channels);
      const StoredPicture stored = decode(encodePng(picture));
      EXPECT_EQ(stored.bytes, picture) << size.width << 'x' << size.height << 'x' << channels;
      EXPECT_FALSE(stored.linear);
    }
  }
}

TEST(Png, WordsRoundTripAndSayWhatTheyAre) {
  for (const int channels : {1, 3, 4}) {
    PictureOf<std::uint16_t> picture({17, 5}, channels);
    for (std::size_t i = 0; i < picture.samples().size(); ++i)
      picture.samples()[i] = static_cast<std::uint16_t>(65535 - 771 * i);
    for (const PngTransfer transfer : {PngTransfer::Linear, PngTransfer::Unsaid}) {
      const StoredPicture stored = decode(encodePng(picture, transfer));
      EXPECT_EQ(stored.words, picture);
      EXPECT_EQ(stored.linear, transfer == PngTransfer::Linear);
    }
  }
}

bool contains(const Bytes& bytes, std::string_view text) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return all.find(text) != std::string_view::npos;
}

TEST(Png, SameBytesEveryTimeMarkedAsSrgb) {
  const Bytes bytes = encodePng(gradient({64, 64}, 3));
  EXPECT_EQ(bytes, encodePng(gradient({64, 64}, 3)));
  EXPECT_TRUE(contains(bytes, "sRGB"));
  EXPECT_FALSE(contains(bytes, "tIME"));
}

TEST(Png, CompressesWhatIsSmooth) {
  BytePicture smooth({256, 256}, 3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c) smooth.at(x, y, c) = static_cast<std::uint8_t>((x + y) / 2);
  const std::size_t length = encodePng(smooth).size();
  EXPECT_GT(length, 500U);
  EXPECT_LT(length, 4000U);
}

// Not from our encoder: a 2x2 picture with stored deflate blocks, written out by hand.
constexpr std::array<std::uint8_t, 82> kFrozen = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00,
    0x00, 0xFD, 0xD4, 0x9A, 0x73, 0x00, 0x00, 0x00, 0x19, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x01, 0x01, 0x0E, 0x00, 0xF1, 0xFF, 0x00, 0xFF, 0x00, 0x00, 0x00, 0xFF, 0x00, 0x00,
    0x00, 0x00, 0xFF, 0x0A, 0x14, 0x1E, 0x1A, 0x58, 0x03, 0x3A, 0xCD, 0x98, 0xDB, 0x4B,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

TEST(Png, FrozenBytes) {
  const StoredPicture stored = decode(std::as_bytes(std::span(kFrozen)));
  ASSERT_EQ(stored.bytes.size(), (Size{2, 2}));
  EXPECT_THAT(stored.bytes.row(0), ElementsAre(255, 0, 0, 0, 255, 0));
  EXPECT_THAT(stored.bytes.row(1), ElementsAre(0, 0, 255, 10, 20, 30));
}

TEST(Png, EveryProperTruncationIsRefused) {
  EXPECT_THAT(takenTruncations(std::as_bytes(std::span(kFrozen)), decodeAny), IsEmpty());
  EXPECT_THAT(takenTruncations(encodePng(gradient({9, 7}, 4)), decodeAny), IsEmpty());
}

TEST(Png, EveryBitFlipIsTakenOrRefused) {
  // A chunk's checksum reveals all; a flip in the name of a chunk that may be skipped is harmless.
  EXPECT_EQ(takenBitFlips(std::as_bytes(std::span(kFrozen)), decodeAny), 0U);
  EXPECT_LT(takenBitFlips(encodePng(gradient({9, 7}, 4)), decodeAny), 8U * 64);
}

/// With every chunk's checksum made right again, so that damage reaches what lies behind it.
Bytes withChecksums(std::span<const std::byte> damaged) {
  Bytes bytes(damaged.begin(), damaged.end());
  const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(bytes[i]); };
  for (std::size_t i = 8; i + 12 <= bytes.size();) {
    const std::size_t length = at(i) << 24 | at(i + 1) << 16 | at(i + 2) << 8 | at(i + 3);
    if (length > bytes.size() - i - 12) break;
    const std::uint32_t crc = crc32Of(std::span(bytes).subspan(i + 4, length + 4));
    for (std::size_t k = 0; k < 4; ++k)
      bytes[i + 8 + length + k] = static_cast<std::byte>(crc >> (24 - 8 * k));
    i += 12 + length;
  }
  return bytes;
}

TEST(Png, EveryBitFlipBehindTheChecksumsIsTakenOrRefused) {
  const auto decodeChecked = [](std::span<const std::byte> bytes) {
    return decodeAny(withChecksums(bytes));
  };
  EXPECT_GT(takenBitFlips(std::as_bytes(std::span(kFrozen)), decodeChecked), 50U);
  const Bytes palette =
      makePng({5, 2}, PNG_COLOR_TYPE_PALETTE, 2, {rowOf({0x1B, 0}), rowOf({0xE4, 0})},
              PNG_INTERLACE_ADAM7, [](png_structp png, png_infop info) {
                const png_color colours[4] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
                const png_byte alpha[2] = {0, 128};
                png_set_PLTE(png, info, colours, 4);
                png_set_tRNS(png, info, alpha, 2, nullptr);
              });
  EXPECT_GT(takenBitFlips(palette, decodeChecked), 50U);
}

TEST(Png, DeclaredSizesAreNotBelieved) {
  const std::array<std::array<std::uint8_t, 8>, 4> sizes = {{
      {0, 0, 0xFF, 0xFF, 0, 0, 0x3F, 0xFF},  // within the limits, but not in 82 bytes
      {0, 0, 0xFF, 0xFF, 0, 0, 0xFF, 0xFF},  // too many pixels
      {0, 1, 0, 0, 0, 0, 0, 1},              // too wide
      {0x7F, 0xFF, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF},
  }};
  for (const auto& size : sizes) {
    Bytes bytes(std::as_bytes(std::span(kFrozen)).begin(), std::as_bytes(std::span(kFrozen)).end());
    for (std::size_t i = 0; i < 8; ++i) bytes[16 + i] = static_cast<std::byte>(size[i]);
    EXPECT_FALSE(isTaken(withChecksums(bytes), decodeAny)) << testing::PrintToString(size);
  }
}

TEST(Png, GreyOfEveryDepth) {
  // The values 0, 1, 2 … of each depth, scaled to eight bits; sixteen stay as they are.
  const StoredPicture one = decode(makePng({2, 1}, PNG_COLOR_TYPE_GRAY, 1, {rowOf({0x40})}));
  EXPECT_THAT(one.bytes.row(0), ElementsAre(0, 255));
  const StoredPicture two = decode(makePng({4, 1}, PNG_COLOR_TYPE_GRAY, 2, {rowOf({0x1B})}));
  EXPECT_THAT(two.bytes.row(0), ElementsAre(0, 85, 170, 255));
  const StoredPicture four = decode(makePng({2, 1}, PNG_COLOR_TYPE_GRAY, 4, {rowOf({0x2F})}));
  EXPECT_THAT(four.bytes.row(0), ElementsAre(34, 255));
  const StoredPicture sixteen =
      decode(makePng({2, 1}, PNG_COLOR_TYPE_GRAY, 16, {rowOf({0x12, 0x34, 0xFF, 0xFE})}));
  EXPECT_THAT(sixteen.words.row(0), ElementsAre(0x1234, 0xFFFE));
  EXPECT_TRUE(sixteen.bytes.empty());
}

TEST(Png, ColourOfSixteenBits) {
  const StoredPicture stored =
      decode(makePng({1, 1}, PNG_COLOR_TYPE_RGB_ALPHA, 16, {rowOf({1, 2, 3, 4, 5, 6, 7, 8})}));
  EXPECT_THAT(stored.words.row(0), ElementsAre(0x102, 0x304, 0x506, 0x708));
}

TEST(Png, GreyWithAlphaBecomesColourWithAlpha) {
  const StoredPicture stored =
      decode(makePng({2, 1}, PNG_COLOR_TYPE_GRAY_ALPHA, 8, {rowOf({10, 20, 30, 40})}));
  EXPECT_THAT(stored.bytes.row(0), ElementsAre(10, 10, 10, 20, 30, 30, 30, 40));
}

TEST(Png, PalettesAndTransparentColoursAreExpanded) {
  const png_color colours[3] = {{1, 2, 3}, {40, 50, 60}, {255, 0, 9}};
  const auto opaque = [&](png_structp png, png_infop info) { png_set_PLTE(png, info, colours, 3); };
  const StoredPicture three = decode(
      makePng({3, 1}, PNG_COLOR_TYPE_PALETTE, 8, {rowOf({2, 0, 1})}, PNG_INTERLACE_NONE, opaque));
  EXPECT_THAT(three.bytes.row(0), ElementsAre(255, 0, 9, 1, 2, 3, 40, 50, 60));

  const auto transparent = [&](png_structp png, png_infop info) {
    const png_byte alpha[2] = {0, 99};
    png_set_PLTE(png, info, colours, 3);
    png_set_tRNS(png, info, alpha, 2, nullptr);
  };
  const StoredPicture four = decode(
      makePng({2, 1}, PNG_COLOR_TYPE_PALETTE, 8, {rowOf({1, 2})}, PNG_INTERLACE_NONE, transparent));
  EXPECT_THAT(four.bytes.row(0), ElementsAre(40, 50, 60, 99, 255, 0, 9, 255));

  const auto key = [&](png_structp png, png_infop info) {
    png_color_16 grey{};
    grey.gray = 7;
    png_set_tRNS(png, info, nullptr, 0, &grey);
  };
  const StoredPicture keyed =
      decode(makePng({2, 1}, PNG_COLOR_TYPE_GRAY, 8, {rowOf({7, 8})}, PNG_INTERLACE_NONE, key));
  EXPECT_THAT(keyed.bytes.row(0), ElementsAre(7, 7, 7, 0, 8, 8, 8, 255));
}

TEST(Png, APaletteThatIsTooShortIsRefusedOrBlack) {
  const auto one = [](png_structp png, png_infop info) {
    const png_color colour = {9, 9, 9};
    png_set_PLTE(png, info, &colour, 1);
  };
  const Bytes bytes =
      makePng({2, 1}, PNG_COLOR_TYPE_PALETTE, 8, {rowOf({0, 200})}, PNG_INTERLACE_NONE, one);
  if (!isTaken(bytes, decodeAny)) return;
  const StoredPicture stored = decode(bytes);
  EXPECT_THAT(stored.bytes.row(0), ElementsAre(9, 9, 9, 0, 0, 0));
}

TEST(Png, InterlacedPicturesAreTheSame) {
  const BytePicture picture = gradient({19, 23}, 3);
  std::vector<Bytes> rows;
  for (int y = 0; y < 23; ++y) {
    const auto row = std::as_bytes(picture.row(y));
    rows.emplace_back(row.begin(), row.end());
  }
  const Bytes bytes = makePng({19, 23}, PNG_COLOR_TYPE_RGB, 8, rows, PNG_INTERLACE_ADAM7);
  EXPECT_EQ(decode(bytes).bytes, picture);
  EXPECT_THAT(takenTruncations(bytes, decodeAny), IsEmpty());
}

TEST(Png, OnlyGammaOneWithoutAnSrgbChunkIsLinear) {
  const auto linearWith = [](const std::function<void(png_structp, png_infop)>& describe) {
    return decode(makePng({1, 1}, PNG_COLOR_TYPE_GRAY, 8, {rowOf({128})}, PNG_INTERLACE_NONE,
                          describe))
        .linear;
  };
  EXPECT_FALSE(linearWith({}));
  EXPECT_TRUE(linearWith([](auto png, auto info) { png_set_gAMA_fixed(png, info, 100000); }));
  EXPECT_FALSE(linearWith([](auto png, auto info) { png_set_gAMA_fixed(png, info, 45455); }));
}

TEST(Png, TextsAndClocksArePassedOver) {
  const auto chatty = [](png_structp png, png_infop info) {
    std::string text(100000, 'x');
    png_text entry{};
    entry.compression = PNG_TEXT_COMPRESSION_zTXt;
    char key[] = "Comment";
    entry.key = key;
    entry.text = text.data();
    entry.text_length = text.size();
    png_set_text(png, info, &entry, 1);
    png_set_pHYs(png, info, 1, 1, PNG_RESOLUTION_METER);
  };
  const Bytes bytes =
      makePng({1, 1}, PNG_COLOR_TYPE_GRAY, 8, {rowOf({128})}, PNG_INTERLACE_NONE, chatty);
  ASSERT_TRUE(contains(bytes, "zTXt"));
  EXPECT_THAT(decode(bytes).bytes.row(0), ElementsAre(128));
}

}  // namespace
}  // namespace illum
