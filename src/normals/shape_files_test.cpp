#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/files.h"
#include "illum/error.h"
#include "illum/normals.h"
#include "illum/picture_io.h"
#include "image/formats.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

class ShapeFiles : public testing::Test {
 protected:
  ShapeFiles() { fs::create_directories(folder_); }
  ~ShapeFiles() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::temp_directory_path() / ("illum_normals-" + std::to_string(::getpid()));
};

Picture threeNormals() {
  Picture normals({3, 1}, 3);
  normals.at(0, 0, 2) = 1;
  normals.at(1, 0, 0) = -0.6F;
  normals.at(1, 0, 2) = 0.8F;
  return normals;  // the third is none
}

TEST_F(ShapeFiles, NormalsHaveTheUsualEncoding) {
  const fs::path file = folder_ / "n.png";
  writeNormals(file, threeNormals());
  const StoredPicture stored = decodePng(readFile(file, 1 << 20), file);
  ASSERT_EQ(stored.words.channels(), 4);
  EXPECT_EQ(stored.words.at(0, 0, 0), 32768);
  EXPECT_EQ(stored.words.at(0, 0, 2), 65535);
  EXPECT_EQ(stored.words.at(1, 0, 0), 13107);
  EXPECT_EQ(stored.words.at(1, 0, 3), 65535);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(stored.words.at(2, 0, c), 0);
}

TEST_F(ShapeFiles, NormalsAreFloatsInOpenExr) {
  writeNormals(folder_ / "n.exr", threeNormals());
  const Picture read = readPicture(folder_ / "n.exr");
  EXPECT_EQ(read.at(1, 0, 0), -0.6F);
  EXPECT_EQ(read.at(1, 0, 3), 1);
  EXPECT_EQ(read.at(2, 0, 3), 0);
}

TEST_F(ShapeFiles, HeightsGoFromBlackToWhiteOrAreFloats) {
  Picture heights({3, 1}, 1);
  heights.at(0, 0, 0) = -0.25F;
  heights.at(2, 0, 0) = 0.75F;
  const HeightRange range = writeHeights(folder_ / "z.png", heights);
  EXPECT_EQ(range.lowest, -0.25);
  EXPECT_EQ(range.highest, 0.75);
  const Picture png = readPicture(folder_ / "z.png");
  EXPECT_EQ(png.at(0, 0, 0), 0);
  EXPECT_NEAR(png.at(1, 0, 0), 0.25, 1e-5);
  EXPECT_EQ(png.at(2, 0, 0), 1);
  writeHeights(folder_ / "z.exr", heights);
  EXPECT_EQ(readPicture(folder_ / "z.exr"), heights);
}

TEST_F(ShapeFiles, AFlatSurfaceIsWritten) {
  EXPECT_EQ(writeHeights(folder_ / "z.png", Picture({2, 2}, 1)).highest, 0);
}

TEST_F(ShapeFiles, JpegIsRefused) {
  EXPECT_THROW(writeNormals(folder_ / "n.jpg", threeNormals()), Error);
  EXPECT_THROW(writeHeights(folder_ / "z.jpg", Picture({2, 2}, 1)), Error);
}

}  // namespace
}  // namespace illum
