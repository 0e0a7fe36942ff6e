#include "capture/photo_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <cstring>

#include "capture/test_photographs.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kPlenty = std::uint64_t{1} << 32;

struct Decoded {
  PhotographHeader header;
  std::vector<double> units;  // samples, white = 1
};

std::vector<double> unitsOf(SampleType type, const std::vector<std::byte>& samples) {
  std::vector<double> units;
  for (std::size_t at = 0; at < samples.size(); at += bytesOf(type)) {
    if (type == SampleType::Byte) {
      units.push_back(std::to_integer<int>(samples[at]) / 255.0);
    } else if (type == SampleType::Word) {
      std::uint16_t word = 0;
      std::memcpy(&word, &samples[at], sizeof word);
      units.push_back(word / 65535.0);
    } else {
      float value = 0;
      std::memcpy(&value, &samples[at], sizeof value);
      units.push_back(value);
    }
  }
  return units;
}

// `rowsAtATime` in turn, so that readers are asked for what does not fit their chunks.
Decoded decode(const std::filesystem::path& file, std::vector<int> rowsAtATime = {3, 1, 40}) {
  FilePool pool;
  const std::size_t number = pool.add(file);
  Decoded result{readHeader(pool, number, kPlenty), {}};
  const auto reader = openReader(pool, number, result.header);
  const int height = result.header.stored.height;
  std::vector<std::byte> samples(result.header.rowBytes() * static_cast<std::size_t>(height));
  std::size_t turn = 0;
  for (int row = 0; row < height;) {
    const int count = std::min(rowsAtATime[turn++ % rowsAtATime.size()], height - row);
    reader->read(count, samples.data() + result.header.rowBytes() * static_cast<std::size_t>(row));
    row += count;
  }
  result.units = unitsOf(result.header.type, samples);
  return result;
}

// What a lossless file of the sketch holds.
double stored(const test::Sketch& sketch, int x, int y, int c) {
  const double value = sketch.value(x, y, c);
  if (sketch.type == SampleType::Byte) return std::lround(255 * value) / 255.0;
  if (sketch.type == SampleType::Word) return std::lround(65535 * value) / 65535.0;
  return static_cast<float>(value);
}

double worstDifference(const Decoded& decoded, const test::Sketch& sketch) {
  double worst = 0;
  std::size_t at = 0;
  for (int y = 0; y < sketch.size.height; ++y) {
    for (int x = 0; x < sketch.size.width; ++x) {
      for (int c = 0; c < sketch.channels; ++c) {
        worst = std::max(worst, std::abs(decoded.units.at(at++) - stored(sketch, x, y, c)));
      }
    }
  }
  return worst;
}

struct Case {
  std::string name;
  SampleType type = SampleType::Byte;
  int channels = 3;
  double tolerance = 0;
  bool sequential = true;
  Transfer transfer = Transfer::Display;
  std::map<std::string, test::Attribute> attributes = {};
};

void PrintTo(const Case& test, std::ostream* out) {
  *out << test.name << " x" << test.channels;
}

class Format : public testing::TestWithParam<Case> {};

TEST_P(Format, GivesTheSamplesThatWereWritten) {
  const Case& test = GetParam();
  const test::Folder folder;
  test::Sketch sketch = test::sketch(1, {45, 83}, test.channels, test.type);
  sketch.attributes = test.attributes;
  sketch.attributes["oiio:UnassociatedAlpha"] = 1;
  const auto file = folder / test.name.substr(test.name.find('/') + 1);
  test::write(file, sketch);

  const Decoded decoded = decode(file);
  EXPECT_EQ(decoded.header.stored, sketch.size);
  EXPECT_EQ(decoded.header.type, test.type);
  EXPECT_EQ(decoded.header.channels(), test.channels);
  EXPECT_EQ(decoded.header.alpha, test.channels % 2 == 0);
  EXPECT_EQ(decoded.header.sequential, test.sequential);
  EXPECT_EQ(decoded.header.transfer, test.transfer);
  EXPECT_EQ(decoded.header.orientation.exif, 1);
  ASSERT_EQ(decoded.units.size(), sketch.size.pixels() * static_cast<unsigned>(test.channels));
  EXPECT_LE(worstDifference(decoded, sketch), test.tolerance);
}

using enum SampleType;
constexpr double kJpeg = 0.15, kHalf = 1e-3, kRgbe = 0.01;
const std::string kNone = "none";

INSTANTIATE_TEST_SUITE_P(
    All, Format,
    testing::Values(
        Case{"baseline/a.jpg",
             Byte,
             3,
             kJpeg,
             true,
             Transfer::Display,
             {{"Compression", "jpeg:95"}}},
        Case{"grey/a.jpg", Byte, 1, kJpeg},
        Case{"progressive/a.jpg",
             Byte,
             3,
             kJpeg,
             false,
             Transfer::Display,
             {{"jpeg:progressive", 1}}},
        Case{"rgb/a.png"}, Case{"grey/a.png", Byte, 1}, Case{"rgba/a.png", Byte, 4},
        Case{"greyalpha/a.png", Byte, 2}, Case{"words/a.png", Word, 3},
        Case{"wordsalpha/a.png", Word, 4}, Case{"wordsgrey/a.png", Word, 1},
        Case{"lzw/a.tif", Byte, 3, 0, true, Transfer::Display, {{"compression", "lzw"}}},
        Case{"plain/a.tif", Word, 3, 0, true, Transfer::Display, {{"compression", kNone}}},
        Case{"zip/a.tif", Word, 1, 0, true, Transfer::Display, {{"compression", "zip"}}},
        Case{"tiles/a.tif", Byte, 3, 0, true, Transfer::Display, {{"tile", 16}}},
        Case{"planes/a.tif", Byte, 3, 0, false, Transfer::Display, {{"planarconfig", "separate"}}},
        Case{"float/a.tif", Float, 3, 0, true, Transfer::Linear},
        Case{
            "straight/a.tif", Byte, 4, 0, true, Transfer::Display, {{"oiio:UnassociatedAlpha", 1}}},
        Case{"zip/a.exr", Float, 3, 0, true, Transfer::Linear, {{"compression", "zip"}}},
        Case{"piz/a.exr", Float, 3, 0, true, Transfer::Linear, {{"compression", "piz"}}},
        Case{"grey/a.exr", Float, 1, 0, true, Transfer::Linear},
        Case{"tiles/a.exr", Float, 3, 0, true, Transfer::Linear, {{"tile", 16}}},
        Case{"hdr/a.hdr", Float, 3, kRgbe, true, Transfer::Linear}, Case{"rgb/a.bmp"},
        Case{"rgb/a.tga", Byte, 3, 0, false}, Case{"rgba/a.tga", Byte, 4, 0, false},
        Case{"rgb/a.ppm", Byte, 3, 0, false}, Case{"grey/a.pgm", Byte, 1, 0, false},
        Case{"rgb/a.dpx"}, Case{"words/a.dpx", Word, 3}, Case{"rgb/a.sgi"},
        Case{"rgb/a.jp2", Byte, 3, kJpeg, false}, Case{"rgb/a.webp", Byte, 3, kJpeg, false}));

TEST(Photograph, InterlacedPngIsDecodedAtOnce) {
  const test::Folder folder;
  const test::Sketch sketch = test::sketch(2);
  test::writeInterlacedPng(folder / "a.png", sketch);
  const Decoded decoded = decode(folder / "a.png");
  EXPECT_FALSE(decoded.header.sequential);
  EXPECT_EQ(worstDifference(decoded, sketch), 0);
}

TEST(Photograph, HalfFloatsBecomeFloats) {
  const test::Folder folder;
  test::Sketch sketch = test::sketch(2, {23, 17}, 3, Float);
  sketch.attributes["oiio:half"] = 1;
  test::write(folder / "a.exr", sketch);
  const Decoded decoded = decode(folder / "a.exr");
  EXPECT_EQ(decoded.header.type, Float);
  EXPECT_LE(worstDifference(decoded, sketch), kHalf);
  EXPECT_GT(worstDifference(decoded, sketch), 0);
}

TEST(Photograph, NegativeAndBrightLightIsKept) {
  const test::Folder folder;
  test::Sketch sketch = test::sketch(2, {23, 17}, 3, Float);
  sketch.value = [](int x, int y, int c) { return x - 10.5 * y + c; };
  test::write(folder / "a.exr", sketch);
  EXPECT_EQ(worstDifference(decode(folder / "a.exr"), sketch), 0);
}

// The colours that a premultiplied file was made from come back; under alpha 0 there are none.
TEST(Photograph, PremultipliedColoursAreDivided) {
  for (const char* name : {"a.exr", "a.tif"}) {
    const test::Folder folder;
    const auto straight = [](int x, int y, int c) { return test::pattern(3, x, y, c); };
    const auto alpha = [](int x) { return (x % 5) / 4.0; };
    test::Sketch sketch = test::sketch(3, {23, 17}, 4, Float);
    sketch.value = [&](int x, int y, int c) {
      return c == 3 ? alpha(x) : static_cast<float>(straight(x, y, c)) * alpha(x);
    };
    test::write(folder / name, sketch);
    const Decoded decoded = decode(folder / name);
    ASSERT_TRUE(decoded.header.alpha) << name;
    for (int y = 0; y < 17; ++y) {
      for (int x = 0; x < 23; ++x) {
        for (int c = 0; c < 4; ++c) {
          const double expected = c == 3 ? alpha(x) : alpha(x) > 0 ? straight(x, y, c) : 0;
          const double found = decoded.units[static_cast<std::size_t>((y * 23 + x) * 4 + c)];
          EXPECT_NEAR(found, expected, 1e-6) << name << " " << x << " " << y << " " << c;
        }
      }
    }
  }
}

TEST(Photograph, LayersOfExrAreFoundByName) {
  const test::Folder folder;
  test::Sketch sketch = test::sketch(4, {23, 17}, 3, Float);
  sketch.attributes["channelnames"] = "beauty.R,beauty.G,beauty.B";
  test::write(folder / "a.exr", sketch);
  EXPECT_EQ(worstDifference(decode(folder / "a.exr"), sketch), 0);
}

TEST(Photograph, PngGammaTellsTheTransfer) {
  const test::Folder folder;
  struct Gamma {
    float gamma;
    Transfer transfer;
    double header;
  };
  for (const Gamma& test : {Gamma{1.0f, Transfer::Linear, 0}, Gamma{2.2f, Transfer::Display, 0},
                            Gamma{1.8f, Transfer::Display, 1.8}}) {
    test::Sketch sketch = test::sketch(1);
    sketch.attributes["oiio:ColorSpace"] =
        test.gamma == 1 ? std::string("linear") : "GammaCorrected" + std::to_string(test.gamma);
    sketch.attributes["oiio:Gamma"] = test.gamma;
    test::write(folder / "a.png", sketch);
    const Decoded decoded = decode(folder / "a.png");
    EXPECT_EQ(decoded.header.transfer, test.transfer) << test.gamma;
    EXPECT_NEAR(decoded.header.gamma, test.header, 0.02) << test.gamma;
  }
}

TEST(Photograph, OrientationTagsAreReadFromEveryFormatThatHasThem) {
  const Size size{23, 17};
  for (const std::string name : {"a.jpg", "a.tif", "a.exr", "a.png", "a.webp"}) {
    for (int exif = 1; exif <= 8; ++exif) {
      const test::Folder folder;
      test::Sketch sketch = test::sketch(1, size, 3, name == "a.exr" ? Float : Byte);
      sketch.attributes["Orientation"] = exif;
      test::write(folder / name, sketch);
      if (name == "a.png") test::addPngExif(folder / name, exif);
      if (name == "a.webp") test::addWebpChunks(folder / name, size, exif, {});
      EXPECT_EQ(decode(folder / name).header.orientation.exif, exif) << name;
    }
  }
}

TEST(Photograph, LosslessWebpKeepsStraightColours) {
  for (const int channels : {3, 4}) {
    const test::Folder folder;
    const test::Sketch sketch = test::sketch(5, {23, 17}, channels);
    test::writeLosslessWebp(folder / "a.webp", sketch);
    const Decoded decoded = decode(folder / "a.webp");
    EXPECT_EQ(decoded.header.channels(), channels);
    EXPECT_FALSE(decoded.header.sequential);
    EXPECT_EQ(worstDifference(decoded, sketch), 0) << channels;
  }
}

TEST(Photograph, SixteenBitPnm) {
  for (const int channels : {1, 3}) {
    const test::Folder folder;
    const test::Sketch sketch = test::sketch(5, {23, 17}, channels, Word);
    test::writeWordPnm(folder / "a.pnm", sketch);
    const Decoded decoded = decode(folder / "a.pnm");
    EXPECT_EQ(decoded.header.type, Word);
    // OpenImageIO goes through floats and is one step off here and there.
    EXPECT_LE(worstDifference(decoded, sketch), 1.01 / 65535) << channels;
  }
}

// The plan of memory rests on these figures: what is measured must not exceed what was said, nor
// lie below a twentieth of it where it matters.
TEST(Photograph, DecodersHoldNoMoreThanTheySay) {
  const test::Folder folder;
  struct Kind {
    const char* name;
    SampleType type;
    std::map<std::string, test::Attribute> attributes;
  };
  const std::vector<Kind> kinds{
      {"a.jpg", Byte, {}},
      {"p.jpg", Byte, {{"jpeg:progressive", 1}}},
      {"a.png", Byte, {}},
      {"w.png", Word, {}},
      {"l.tif", Byte, {{"compression", "lzw"}}},
      {"z.tif", Word, {{"compression", "zip"}}},
      {"n.tif", Byte, {{"compression", kNone}}},
      {"t.tif", Byte, {{"tile", 64}}},
      {"z.exr", Float, {{"compression", "zip"}}},
      {"d.exr", Float, {{"compression", "dwab"}}},
      {"t.exr", Float, {{"tile", 64}}},
      {"a.hdr", Float, {}},
      {"a.bmp", Byte, {}},
      {"a.tga", Byte, {}},
      {"a.ppm", Byte, {}},
      {"a.dpx", Byte, {}},
      {"a.sgi", Byte, {}},
      {"a.jp2", Byte, {}},
      {"a.webp", Byte, {}},
  };
  for (const Kind& kind : kinds) {
    test::Sketch sketch = test::sketch(1, {700, 300}, 3, kind.type);
    sketch.attributes = kind.attributes;
    test::write(folder / kind.name, sketch);
    FilePool pool;
    const std::size_t file = pool.add(folder / kind.name);
    const PhotographHeader header = readHeader(pool, file, kPlenty);
    std::vector<std::byte> row(8 * header.rowBytes());
    openReader(pool, file, header)->read(8, row.data());  // what libraries keep for good
    const auto used = [] {
      const auto info = mallinfo2();
      return info.uordblks + info.hblkhd;
    };
    const std::size_t before = used();
    const auto reader = openReader(pool, file, header);
    reader->read(8, row.data());
    const std::size_t held = used() - before;
    EXPECT_LE(held, header.decoderBytes) << kind.name;
    RecordProperty(kind.name, std::to_string(held) + " of " + std::to_string(header.decoderBytes));
    if (std::getenv("ILLUM_SHOW_MEMORY") != nullptr) {
      std::printf("%-8s %9zu of %9zu\n", kind.name, held,
                  static_cast<std::size_t>(header.decoderBytes));
    }
  }
}

}  // namespace
}  // namespace illum
