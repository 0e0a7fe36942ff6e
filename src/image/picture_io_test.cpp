#include "illum/picture_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "core/files.h"
#include "illum/colour.h"
#include "illum/error.h"
#include "image/formats.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PictureIo : public testing::Test {
 protected:
  PictureIo() : folder_(fs::path(testing::TempDir()) / ("pictures-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~PictureIo() override { fs::remove_all(folder_); }

  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

template <typename Action>
void expectError(Fault fault, const std::string& part, const Action& action) {
  try {
    action();
    ADD_FAILURE() << "no error, expected one with: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

Picture ramp(int channels) {
  Picture picture({16, 8}, channels);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < channels; ++c)
        picture.at(x, y, c) =
            c == 3 ? 1 : linearFromDisplay(static_cast<float>(x * 16 + y + c) / 255);
  return picture;
}

TEST(PictureFormat, IsTheNamesEnding) {
  EXPECT_EQ(pictureFormat("a.png"), PictureFormat::Png);
  EXPECT_EQ(pictureFormat("dir.exr/a.b.PNG"), PictureFormat::Png);
  EXPECT_EQ(pictureFormat("a.jpg"), PictureFormat::Jpeg);
  EXPECT_EQ(pictureFormat("a.JPeG"), PictureFormat::Jpeg);
  EXPECT_EQ(pictureFormat("a.exr"), PictureFormat::Exr);
  for (const char* name : {"", "a", "png", ".png", "a.png.txt", "a.tif", "a.exr/b"})
    expectError(Fault::Usage, "ends in .png", [&] { pictureFormat(name); });
}

TEST_F(PictureIo, EightBitsSurviveTheWayThroughLinearLight) {
  for (const int channels : {1, 3, 4}) {
    const Picture linear = ramp(channels);
    writePicture(folder_ / "a.png", linear);
    EXPECT_EQ(readBytePicture(folder_ / "a.png"), displayBytes(linear));
    const Picture read = readPicture(folder_ / "a.png");
    ASSERT_EQ(read.channels(), channels);
    for (std::size_t i = 0; i < read.samples().size(); ++i)
      ASSERT_EQ(read.samples()[i], linear.samples()[i]) << i << " of " << channels;
  }
}

TEST_F(PictureIo, ExrIsUnclampedAndExposedButForAlpha) {
  Picture linear({1, 1}, 4);
  const float samples[] = {-0.5F, 3, 1000, 0.25F};
  std::copy(std::begin(samples), std::end(samples), linear.samples().begin());
  writePicture(folder_ / "a.exr", linear);
  EXPECT_EQ(readPicture(folder_ / "a.exr"), linear);
  writePicture(folder_ / "a.exr", linear, 1);
  const Picture exposed = readPicture(folder_ / "a.exr");
  EXPECT_THAT(exposed.samples(), testing::ElementsAre(-1, 6, 2000, 0.25F));
}

TEST_F(PictureIo, ExposureOfDisplayPictures) {
  Picture linear({1, 1}, 3);
  for (float& sample : linear.samples()) sample = 0.05F;
  writePicture(folder_ / "a.png", linear, 2);
  EXPECT_EQ(readBytePicture(folder_ / "a.png").at(0, 0, 1), displayByteFromLinear(0.2F));
}

TEST_F(PictureIo, AlphaIsStraightInPngAndPremultipliedInMemory) {
  Picture linear({1, 1}, 4);
  const float samples[] = {0.25F, 0.125F, 0, 0.5F};
  std::copy(std::begin(samples), std::end(samples), linear.samples().begin());
  writePicture(folder_ / "a.png", linear);
  const BytePicture stored = readBytePicture(folder_ / "a.png");
  EXPECT_EQ(stored.at(0, 0, 0), displayByteFromLinear(0.5F));
  EXPECT_EQ(stored.at(0, 0, 3), 128);
  const Picture read = readPicture(folder_ / "a.png");
  EXPECT_NEAR(read.at(0, 0, 0), 0.25, 0.003);
  EXPECT_NEAR(read.at(0, 0, 1), 0.125, 0.003);
  EXPECT_FLOAT_EQ(read.at(0, 0, 3), 128.0F / 255);
}

TEST_F(PictureIo, JpegIsOverBlackWhereThereIsAlpha) {
  Picture linear({8, 8}, 4);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 4; ++c) linear.at(x, y, c) = c == 3 ? 0.5F : 0.2F;
  writePicture(folder_ / "a.jpg", linear);
  const BytePicture stored = readBytePicture(folder_ / "a.jpg");
  ASSERT_EQ(stored.channels(), 3);
  EXPECT_NEAR(stored.at(4, 4, 0), displayByteFromLinear(0.2F), 1);
}

TEST_F(PictureIo, JpegIsReadAsSrgb) {
  writePicture(folder_ / "a.jpeg", ramp(1));
  const BytePicture bytes = readBytePicture(folder_ / "a.jpeg");
  const Picture linear = readPicture(folder_ / "a.jpeg");
  EXPECT_EQ(displayBytes(linear), bytes);
}

/// A one-pixel PNG of 16 bits with grey and alpha, linear by its gAMA of 1.
std::vector<std::byte> linearSixteenBits() {
  std::vector<std::byte> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, std::size_t length) {
        const auto* first = reinterpret_cast<const std::byte*>(data);
        auto* all = static_cast<std::vector<std::byte>*>(png_get_io_ptr(writer));
        all->insert(all->end(), first, first + length);
      },
      nullptr);
  png_set_IHDR(png, info, 1, 1, 16, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_INTERLACE_NONE, 0, 0);
  png_set_gAMA_fixed(png, info, 100000);
  png_write_info(png, info);
  const png_byte row[] = {0x80, 0x00, 0x40, 0x00};
  png_write_row(png, row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

TEST_F(PictureIo, SixteenBitsAndLinearPngs) {
  writeFileAtomically(folder_ / "a.png", linearSixteenBits());
  const Picture linear = readPicture(folder_ / "a.png");
  ASSERT_EQ(linear.channels(), 4);
  const double alpha = 0x4000 / 65535.0;
  EXPECT_NEAR(linear.at(0, 0, 3), alpha, 1e-7);
  EXPECT_NEAR(linear.at(0, 0, 0), alpha * 0x8000 / 65535.0, 1e-7);
  expectError(Fault::Input, "16 bits a sample", [&] { readBytePicture(folder_ / "a.png"); });
}

TEST_F(PictureIo, TheContentDecidesNotTheName) {
  writeFileAtomically(folder_ / "a.jpg", encodePng(displayBytes(ramp(3))));
  EXPECT_EQ(readBytePicture(folder_ / "a.jpg"), displayBytes(ramp(3)));
}

TEST_F(PictureIo, WhatIsNoPictureIsRefused) {
  std::ofstream(folder_ / "empty.png");
  std::ofstream(folder_ / "text.png") << "not a picture";
  expectError(Fault::Input, "found an empty file", [&] { readPicture(folder_ / "empty.png"); });
  expectError(Fault::Input, "text.png: expected a PNG, JPEG or OpenEXR picture",
              [&] { readPicture(folder_ / "text.png"); });
  expectError(Fault::Input, "No such file", [&] { readPicture(folder_ / "missing.png"); });
  expectError(Fault::Input, "Is a directory", [&] { readBytePicture(folder_); });
  writePicture(folder_ / "a.exr", ramp(3));
  expectError(Fault::Input, "an OpenEXR picture", [&] { readBytePicture(folder_ / "a.exr"); });
}

TEST_F(PictureIo, AFailedWriteLeavesNothing) {
  const Picture linear = ramp(3);
  expectError(Fault::Usage, "ends in .png", [&] { writePicture(folder_ / "a.gif", linear); });
  expectError(Fault::Usage, "display-referred",
              [&] { writePicture(folder_ / "a.exr", displayBytes(linear)); });
  expectError(Fault::Usage, "1 or 3 channels",
              [&] { writePicture(folder_ / "a.jpg", displayBytes(ramp(4))); });
  expectError(Fault::Machine, "cannot write",
              [&] { writePicture(folder_ / "missing" / "a.png", linear); });
  EXPECT_EQ(filesInFolder(), 0U);
}

TEST(PictureSize, IsBoundedByLimitsAndByTheFile) {
  EXPECT_NO_THROW(checkPictureSize("a", 65535, 16384, 3, 1 << 30, 4));
  const struct {
    std::int64_t width, height;
    const char* found;
  } cases[] = {
      {0, 1, "0 x 1"}, {1, -1, "1 x -1"}, {65536, 1, "65536 x 1"}, {65535, 65535, "65535 x 65535"}};
  for (const auto& bad : cases)
    expectError(Fault::Input, bad.found,
                [&] { checkPictureSize("a", bad.width, bad.height, 1, 1ULL << 40, 1); });
  EXPECT_NO_THROW(checkPictureSize("a", 10, 10, 3, 300, 1));
  expectError(Fault::Input, "only 299 bytes", [] { checkPictureSize("a", 10, 10, 3, 299, 1); });
}

}  // namespace
}  // namespace illum
