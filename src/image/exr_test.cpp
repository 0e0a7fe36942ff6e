#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPreviewImage.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <limits>
#include <map>

#include "core/files.h"
#include "illum/picture_io.h"
#include "image/formats.h"
#include "image/hostile_bytes_for_test.h"

namespace illum {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Bytes = std::vector<std::byte>;

Picture decode(std::span<const std::byte> bytes) {
  return decodeExr(bytes, "hostile");
}

Picture pattern(Size size, int channels) {
  Picture picture(size, channels);
  float value = -3;
  for (float& sample : picture.samples()) sample = value += 0.37F;
  return picture;
}

std::string refusalOf(std::span<const std::byte> bytes) {
  try {
    decode(bytes);
    return "taken";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Exr, RoundTripsExactly) {
  for (const int channels : {1, 3, 4})
    for (const Size size : {Size{1, 1}, Size{7, 40}, Size{5000, 1}, Size{1, 500}}) {
      const Picture picture = pattern(size, channels);
      EXPECT_EQ(decode(encodeExr(picture)), picture)
          << size.width << 'x' << size.height << 'x' << channels;
    }
}

TEST(Exr, KeepsEveryKindOfFloat) {
  using Limits = std::numeric_limits<float>;
  const float values[] = {
      Limits::infinity(), -Limits::infinity(), Limits::denorm_min(), -0.0F, Limits::max(), -1e-30F,
      Limits::quiet_NaN()};
  Picture picture({7, 1}, 1);
  std::copy(std::begin(values), std::end(values), picture.samples().begin());
  const Picture read = decode(encodeExr(picture));
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(std::bit_cast<std::uint32_t>(read.samples()[i]),
              std::bit_cast<std::uint32_t>(values[i]));
}

TEST(Exr, HalvesAreRoundedToNearest) {
  Picture picture({3, 1}, 1);
  picture.at(0, 0, 0) = 0.1F;
  picture.at(1, 0, 0) = std::numeric_limits<float>::infinity();
  picture.at(2, 0, 0) = -65504;
  const auto bytes = encodeExr(picture, ExrSamples::Half);
  const Picture back = decode(bytes);
  EXPECT_EQ(back.at(0, 0, 0), 0.0999755859375F);
  EXPECT_EQ(back.at(1, 0, 0), picture.at(1, 0, 0));
  EXPECT_EQ(back.at(2, 0, 0), -65504);
  picture.at(2, 0, 0) = 65536;
  try {
    encodeExr(picture, ExrSamples::Half);
    ADD_FAILURE() << "65536 is no half";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "half precision: expected values to 65504, found 65536");
  }
}

TEST(Exr, SameBytesEveryTime) {
  EXPECT_EQ(encodeExr(pattern({50, 40}, 3)), encodeExr(pattern({50, 40}, 3)));
}

/// Files that our encoder does not write come from the library itself, by way of a file.
class ForeignExr : public testing::Test {
 protected:
  ForeignExr() : file_(testing::TempDir() + "exr-" + std::to_string(::getpid()) + ".exr") {}
  ~ForeignExr() override { std::filesystem::remove(file_); }

  /// 2x2 pixels of one type; the n-th named channel has the values n, 2n / 3n, 4n.
  Bytes make(const std::vector<std::string>& names, Imf::PixelType type,
             Imf::Header header = Imf::Header(2, 2), int sampling = 1) {
    std::map<std::string, std::vector<char>> data;
    Imf::FrameBuffer buffer;
    const Imath::Box2i window = header.dataWindow();
    float place = 0;
    for (const std::string& name : names) {
      header.channels().insert(name, Imf::Channel(type, sampling, sampling));
      ++place;
      for (int i = 1; i <= 4; ++i) append(data[name], type, place * static_cast<float>(i));
      const std::size_t bytes = data[name].size() / 4;
      buffer.insert(name, Imf::Slice::Make(type, data[name].data(), window, bytes,
                                           2 * bytes / static_cast<std::size_t>(sampling), sampling,
                                           sampling));
    }
    {
      Imf::OutputFile output(file_.c_str(), header, 0);
      output.setFrameBuffer(buffer);
      output.writePixels(2);
    }
    return readFile(file_, 1 << 20);
  }

  static void append(std::vector<char>& samples, Imf::PixelType type, float value) {
    const auto put = [&](const auto& sample) {
      const char* bytes = reinterpret_cast<const char*>(&sample);
      samples.insert(samples.end(), bytes, bytes + sizeof(sample));
    };
    if (type == Imf::FLOAT) put(value);
    if (type == Imf::HALF) put(Imath::half(value));
    if (type == Imf::UINT) put(static_cast<unsigned>(value));
  }

  std::string file_;
};

TEST_F(ForeignExr, EveryTypeOfSampleIsRead) {
  for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
    const Picture colour = decode(make({"R", "G", "B"}, type));
    ASSERT_EQ(colour.channels(), 3) << type;
    EXPECT_THAT(colour.row(1), ElementsAre(3, 6, 9, 4, 8, 12)) << type;
    const Picture grey = decode(make({"Y"}, type));
    ASSERT_EQ(grey.channels(), 1) << type;
    EXPECT_THAT(grey.row(0), ElementsAre(1, 2)) << type;
  }
}

TEST_F(ForeignExr, AlphaAndOtherChannels) {
  EXPECT_THAT(decode(make({"A", "R", "G", "B", "Z"}, Imf::HALF)).row(0),
              ElementsAre(2, 3, 4, 1, 4, 6, 8, 2));
  EXPECT_THAT(decode(make({"Y", "A"}, Imf::HALF)).row(0), ElementsAre(1, 1, 1, 2, 2, 2, 2, 4));
}

TEST_F(ForeignExr, ChannelsThatMakeNoPictureAreRefused) {
  EXPECT_EQ(refusalOf(make({"Z"}, Imf::FLOAT)),
            "hostile: expected channels R, G, B or Y, found others");
  EXPECT_THAT(refusalOf(make({"R", "G"}, Imf::FLOAT)), HasSubstr("channels R, G, B or Y"));
  EXPECT_THAT(refusalOf(make({"Y", "RY", "BY"}, Imf::HALF)), HasSubstr("channels R, G, B or Y"));
  EXPECT_THAT(refusalOf(make({"R", "G", "B"}, Imf::HALF, Imf::Header(2, 2), 2)),
              HasSubstr("R subsampled"));
}

TEST_F(ForeignExr, TheDataWindowIsThePicture) {
  const Imath::Box2i data({-5, 7}, {-4, 8});
  Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), data);
  const Picture picture = decode(make({"Y"}, Imf::FLOAT, header));
  ASSERT_EQ(picture.size(), (Size{2, 2}));
  EXPECT_THAT(picture.row(1), ElementsAre(3, 4));
}

TEST_F(ForeignExr, OtherPrimariesAreConverted) {
  Imf::Header header(2, 2);
  // Primaries swapped: what the file calls red is our green, and so on.
  const Imf::Chromaticities ours;
  Imf::addChromaticities(header, Imf::Chromaticities(ours.green, ours.blue, ours.red, ours.white));
  const Picture picture = decode(make({"R", "G", "B"}, Imf::FLOAT, header));
  EXPECT_NEAR(picture.at(0, 0, 1), 1, 1e-5);
  EXPECT_NEAR(picture.at(0, 0, 2), 2, 1e-5);
  EXPECT_NEAR(picture.at(0, 0, 0), 3, 1e-5);
}

TEST_F(ForeignExr, OurFilesSayRec709AndFloat) {
  writeFileAtomically(file_, encodeExr(pattern({3, 2}, 4)));
  Imf::InputFile input(file_.c_str(), 0);
  ASSERT_TRUE(Imf::hasChromaticities(input.header()));
  const Imf::Chromaticities colours = Imf::chromaticities(input.header());
  EXPECT_FLOAT_EQ(colours.red.x, 0.64F);
  EXPECT_FLOAT_EQ(colours.green.y, 0.6F);
  EXPECT_FLOAT_EQ(colours.white.x, 0.3127F);
  for (const char* name : {"R", "G", "B", "A"})
    EXPECT_EQ(input.header().channels()[name].type, Imf::FLOAT);
}

TEST_F(ForeignExr, EveryProperTruncationIsRefused) {
  EXPECT_THAT(takenTruncations(encodeExr(pattern({5, 3}, 3)), decode), IsEmpty());
  EXPECT_THAT(takenTruncations(make({"R", "G", "B"}, Imf::HALF), decode), IsEmpty());
}

TEST_F(ForeignExr, EveryBitFlipIsTakenOrRefused) {
  const Bytes ours = encodeExr(pattern({5, 3}, 3));
  EXPECT_LT(takenBitFlips(ours, decode), 8 * ours.size());
  Imf::Header header(2, 2);
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
        Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    header.compression() = compression;
    const Bytes bytes = make({"R", "G", "B"}, Imf::HALF, header);
    EXPECT_LT(takenBitFlips(bytes, decode), 8 * bytes.size()) << compression;
  }
}

/// Where the value of an attribute begins: behind its name, its type and its length.
std::size_t valueOf(const Bytes& bytes, std::string_view nameAndType) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t head = all.find(nameAndType);
  EXPECT_NE(head, all.npos) << nameAndType;
  return head + nameAndType.size() + 4;
}

void put(Bytes& bytes, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(value >> (8 * i));
}

TEST_F(ForeignExr, DeclaredSizesAreNotBelieved) {
  const Bytes bytes = encodeExr(pattern({5, 3}, 3));
  const std::size_t window = valueOf(bytes, {"dataWindow\0box2i\0", 17});
  const auto declared = [&](std::uint32_t right, std::uint32_t bottom) {
    Bytes damaged = bytes;
    put(damaged, window + 8, right);
    put(damaged, window + 12, bottom);
    return damaged;
  };
  ASSERT_EQ(declared(4, 2), bytes);
  EXPECT_FALSE(isTaken(declared(65534, 2), decode));
  EXPECT_THAT(refusalOf(declared(65534, 16000)), HasSubstr("data for 65535 x 16001 pixels"));
  EXPECT_THAT(refusalOf(declared(0x7FFFFFFE, 0x7FFFFFFE)), HasSubstr("sides of 1 to 65535"));
  EXPECT_THAT(refusalOf(declared(0xFFFFFFFE, 0)), HasSubstr("found -1 x 1"));
}

TEST_F(ForeignExr, DeclaredAttributesAreNotBelieved) {
  const Bytes bytes = encodeExr(pattern({5, 3}, 3));
  Bytes damaged = bytes;
  put(damaged, valueOf(bytes, {"channels\0chlist\0", 16}) - 4, 0x7FFFFFFF);
  EXPECT_THAT(refusalOf(damaged), HasSubstr("longer than the file"));

  Imf::Header header(2, 2);
  header.setPreviewImage(Imf::PreviewImage(2, 1));
  const Bytes previewed = make({"Y"}, Imf::HALF, header);
  EXPECT_TRUE(isTaken(previewed, decode));
  damaged = previewed;
  put(damaged, valueOf(previewed, {"preview\0preview\0", 16}), 0x20000002);
  EXPECT_THAT(refusalOf(damaged), HasSubstr("a preview of another size"));
}

TEST_F(ForeignExr, TiledFilesAreReadButDeclaredTilesNotBelieved) {
  Imf::Header header(2, 2);
  header.setTileDescription(Imf::TileDescription(1, 2));
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  const float samples[] = {1, 2, 3, 4};
  Imf::FrameBuffer buffer;
  buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, samples, header.dataWindow(), 4, 8));
  {
    Imf::TiledOutputFile output(file_.c_str(), header, 0);
    output.setFrameBuffer(buffer);
    output.writeTiles(0, 1, 0, 0);
  }
  const Bytes bytes = readFile(file_, 1 << 20);
  EXPECT_THAT(decode(bytes).row(1), ElementsAre(3, 4));

  const std::size_t tiles = valueOf(bytes, {"tiles\0tiledesc\0", 15});
  Bytes damaged = bytes;
  put(damaged, tiles, 0);
  EXPECT_THAT(refusalOf(damaged), HasSubstr("tiles without pixels"));
  put(damaged, tiles, 60000);
  put(damaged, tiles + 4, 60000);
  EXPECT_THAT(refusalOf(damaged), HasSubstr("blocks larger"));
  damaged = bytes;
  const std::size_t window = valueOf(bytes, {"dataWindow\0box2i\0", 17});
  put(damaged, window + 8, 1000);
  put(damaged, window + 12, 1000);
  EXPECT_THAT(refusalOf(damaged), HasSubstr("more tiles"));
  EXPECT_LT(takenBitFlips(bytes, decode), 8 * bytes.size());
}

TEST(Exr, SeveralPartsAreRefused) {
  Bytes bytes = encodeExr(pattern({5, 3}, 3));
  bytes[5] |= std::byte{0x10};
  EXPECT_THAT(refusalOf(bytes), HasSubstr("a flat OpenEXR picture of one part"));
}

}  // namespace
}  // namespace illum
