#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <random>

#include "capture/test_photographs.h"
#include "core/memory.h"
#include "illum/capture.h"
#include "illum/colour.h"
#include "illum/error.h"

namespace illum {
namespace {

using test::Folder;
using test::Sketch;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using enum SampleType;

// A folder with photographs and lights.lp, and what its listener heard.
class PhotographsTest : public testing::Test {
 protected:
  void add(const std::string& name, const Sketch& sketch) {
    test::write(folder_ / name, sketch);
    names_.push_back(name);
  }
  void addSeveral(int count, const std::string& ending, Size size = {23, 17}, int channels = 3,
                  SampleType type = Byte,
                  const std::map<std::string, test::Attribute>& attributes = {}) {
    for (int i = 0; i < count; ++i) {
      Sketch sketch = test::sketch(i, size, channels, type);
      sketch.attributes = attributes;
      add("photo" + std::to_string(i) + ending, sketch);
    }
  }
  void writeLights() {
    folder_.writeText("lights.lp",
                      test::lightFileText(static_cast<int>(names_.size()), [this](int i) {
                        return names_[static_cast<std::size_t>(i)];
                      }));
  }
  std::unique_ptr<Capture> open(const PhotographOptions& options = {}) {
    return openPhotographs(folder_.path(), options, listener_);
  }
  std::string errorOf(const PhotographOptions& options = {}) {
    try {
      open(options);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  // Opens with so little memory that the least possible bands are read.
  std::unique_ptr<Capture> openInBands(PhotographOptions options = {}) {
    std::uint64_t enough = std::uint64_t{1} << 26, tooLittle = 0;
    while (enough - tooLittle > 256) {
      options.memoryBytes = tooLittle + (enough - tooLittle) / 2;
      test::Listener ignored;
      try {
        openPhotographs(folder_.path(), options, ignored);
        enough = options.memoryBytes;
      } catch (const Error&) {
        tooLittle = options.memoryBytes;
      }
    }
    options.memoryBytes = enough;
    return open(options);
  }

  Folder folder_;
  std::vector<std::string> names_;
  test::Listener listener_;
};

double byteOf(int seed, int x, int y, int c) {
  return std::lround(255 * test::pattern(seed, x, y, c));
}

TEST_F(PhotographsTest, BytesAreDividedBy255Exactly) {
  addSeveral(3, ".png");
  writeLights();
  const auto capture = open();
  EXPECT_EQ(capture->size(), (Size{23, 17}));
  EXPECT_EQ(capture->transfer(), Transfer::Display);
  EXPECT_EQ(capture->bandRows(), 17);
  EXPECT_FALSE(capture->hasMask());
  EXPECT_THAT(listener_.remarks, IsEmpty());
  const std::vector<float> samples = test::readAll(*capture);
  std::size_t at = 0;
  for (int light = 0; light < 3; ++light) {
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < 17; ++y) {
        for (int x = 0; x < 23; ++x) {
          ASSERT_EQ(samples[at++], static_cast<float>(byteOf(light, x, y, c)) / 255.0f)
              << light << " " << c << " " << x << " " << y;
        }
      }
    }
  }
}

TEST_F(PhotographsTest, LightsAreInTheOrderOfTheLightFileAndReadInAnyOrder) {
  addSeveral(3, ".png");
  folder_.writeText("lights.lp", "photo2.png 0 0 1\nphoto0.png 1 0 1\nphoto1.png 0 1 1\n");
  const auto capture = open();
  ASSERT_EQ(capture->lights().size(), 3u);
  EXPECT_EQ(capture->lights()[0].name, "photo2.png");
  const std::vector<int> lights{2, 0};
  std::vector<float> samples(2 * 3);
  capture->read(0, {5, 4, 1, 1}, lights, samples);
  EXPECT_EQ(samples[0], static_cast<float>(byteOf(1, 5, 4, 0)) / 255.0f);
  EXPECT_EQ(samples[3], static_cast<float>(byteOf(2, 5, 4, 0)) / 255.0f);
}

// What the stack is made of; every kind is read through memory and through bands.
struct Kind {
  const char* name;
  const char* ending;
  SampleType type = Byte;
  int channels = 3;
  std::map<std::string, test::Attribute> attributes = {};
  bool interlaced = false;
  bool scratch = false;
  int count = 5;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

// So large that bands take less memory than the whole.
constexpr Size kLarge{160, 600};

class KindTest : public PhotographsTest, public testing::WithParamInterface<Kind> {
 protected:
  void SetUp() override {
    const Kind& kind = GetParam();
    addSeveral(kind.count, kind.ending, kLarge, kind.channels, kind.type, kind.attributes);
    if (kind.interlaced) {
      for (int i = 0; i < kind.count; ++i) {
        test::writeInterlacedPng(folder_ / names_[static_cast<std::size_t>(i)],
                                 test::sketch(i, kLarge, kind.channels));
      }
    }
    writeLights();
  }
};

TEST_P(KindTest, BandsGiveWhatMemoryGives) {
  const Folder scratch;
  PhotographOptions options;
  options.scratch = scratch.path();
  const auto whole = open(options);
  EXPECT_EQ(whole->bandRows(), whole->size().height);
  EXPECT_THAT(listener_.remarks, IsEmpty());
  const auto bands = openInBands(options);
  EXPECT_LT(bands->bandRows(), whole->size().height);
  EXPECT_EQ(!listener_.remarks.empty(), GetParam().scratch) << "a scratch file is told";
  const std::vector<float> all = test::readAll(*whole);
  EXPECT_EQ(all, test::readAll(*bands));

  const Size size = whole->size();
  std::mt19937 random(7);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < 6; ++i) {
    Rectangle r{below(size.width), below(size.height), 0, 0};
    r.width = 1 + below(size.width - r.x);
    r.height = 1 + below(size.height - r.y);
    const std::vector<float> part = test::readAll(*whole, r);
    ASSERT_EQ(part, test::readAll(*bands, r)) << r.x << " " << r.y;
    std::size_t at = 0;
    for (std::size_t plane = 0; plane < 3 * names_.size(); ++plane) {
      for (int y = r.y; y < r.bottom(); ++y) {
        for (int x = r.x; x < r.right(); ++x) {
          const std::size_t pixel = static_cast<std::size_t>(y * size.width + x);
          ASSERT_EQ(part[at++], all[plane * size.pixels() + pixel])
              << plane << " " << x << " " << y;
        }
      }
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path())) << "the scratch file has no name";
  EXPECT_EQ(listener_.open, 0);
  EXPECT_EQ(listener_.expected, listener_.advanced);
}

INSTANTIATE_TEST_SUITE_P(
    All, KindTest,
    testing::Values(Kind{"jpeg", ".jpg"}, Kind{"greyJpeg", ".jpg", Byte, 1},
                    Kind{"progressive", ".jpg", Byte, 3, {{"jpeg:progressive", 1}}, false, true},
                    Kind{"png", ".png"}, Kind{"wordPng", ".png", Word},
                    Kind{"interlaced", ".png", Byte, 3, {}, true, true},
                    Kind{"rgba", ".png", Byte, 4}, Kind{"tiff", ".tif"},
                    Kind{"tiles", ".tif", Word, 3, {{"tile", 16}}}, Kind{"exr", ".exr", Float},
                    Kind{"bmp", ".bmp"}, Kind{"webp", ".webp", Byte, 3, {}, false, true, 14},
                    Kind{"mirrored", ".jpg", Byte, 3, {{"Orientation", 2}}},
                    Kind{"turned", ".jpg", Byte, 3, {{"Orientation", 6}}, false, true},
                    Kind{"upsideDown", ".tif", Byte, 3, {{"Orientation", 3}}, false, true}),
    [](const auto& test) { return test.param.name; });

TEST_F(PhotographsTest, ManyTasksReadBandsAtOnce) {
  addSeveral(6, ".jpg", kLarge);
  writeLights();
  const auto whole = open();
  const auto bands = openInBands();
  ASSERT_LT(bands->bandRows(), kLarge.height);
  tbb::parallel_for(0, 60, [&](int i) {
    const Rectangle r{i % 7, (i * 37) % 580, 50, 1 + i % 20};
    EXPECT_EQ(test::readAll(*bands, r), test::readAll(*whole, r)) << i;
  });
}

TEST_F(PhotographsTest, OrientationIsUndone) {
  const Size upright{12, 20};
  for (int exif = 1; exif <= 8; ++exif) {
    const bool exchanged = exif >= 5;
    const Size stored = exchanged ? Size{upright.height, upright.width} : upright;
    Sketch sketch;
    sketch.size = stored;
    sketch.attributes["Orientation"] = exif;
    // The definition in words: which upright pixel the stored (x, y) is.
    sketch.value = [&](int x, int y, int c) {
      const int w = upright.width - 1, h = upright.height - 1;
      const int xs[] = {x, w - x, w - x, x, y, w - y, w - y, y};
      const int ys[] = {y, y, h - y, h - y, x, x, h - x, h - x};
      return (xs[exif - 1] * 10 + ys[exif - 1] + c) / 255.0;
    };
    const Folder folder;
    test::write(folder / "a.tif", sketch);
    folder.writeText("lights.lp", "a.tif 0 0 1");
    const auto capture = openPhotographs(folder.path(), {}, listener_);
    ASSERT_EQ(capture->size(), upright) << exif;
    const std::vector<float> samples = test::readAll(*capture);
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < upright.height; ++y) {
        for (int x = 0; x < upright.width; ++x) {
          const auto at = static_cast<std::size_t>((c * upright.height + y) * upright.width + x);
          ASSERT_EQ(samples[at], static_cast<float>(x * 10 + y + c) / 255.0f)
              << exif << ": " << x << " " << y;
        }
      }
    }
  }
}

TEST_F(PhotographsTest, GreyAndColourAndDepthsMix) {
  add("grey.png", test::sketch(1, {23, 17}, 1));
  add("words.png", test::sketch(1, {23, 17}, 3, Word));
  add("colour.jpg", test::sketch(1));
  writeLights();
  const std::vector<float> samples = test::readAll(*open());
  const std::size_t pixels = 23 * 17;
  for (std::size_t p = 0; p < pixels; ++p) {
    EXPECT_EQ(samples[p], samples[p + pixels]);
    EXPECT_EQ(samples[p], samples[p + 2 * pixels]);
    EXPECT_NEAR(samples[p], samples[p + 3 * pixels], 0.51 / 255);
  }
}

TEST_F(PhotographsTest, IntensitiesDivideLinearLight) {
  addSeveral(3, ".png");
  folder_.writeText("lights.lp", "photo0.png 0 0 1 2\nphoto1.png 1 0 1 1\nphoto2.png 0 1 1 0.5\n");
  const auto capture = open();
  const std::vector<float> samples = test::readAll(*capture);
  const std::vector<float> intensities{2, 1, 0.5f};
  for (int light = 0; light < 3; ++light) {
    for (int x = 0; x < 23; ++x) {
      const float stored = static_cast<float>(byteOf(light, x, 3, 1)) / 255.0f;
      const float divided =
          linearFromDisplay(stored) / intensities[static_cast<std::size_t>(light)];
      const auto at = static_cast<std::size_t>(((light * 3 + 1) * 17 + 3) * 23 + x);
      EXPECT_NEAR(samples[at], displayFromLinear(divided), 1e-6) << light << " " << x;
    }
  }
}

// What test::readAll gets as bytes it compares with what it gets as floats.
TEST_F(PhotographsTest, BytesAreGivenWhereAllAreBytesAsTheyAre) {
  addSeveral(2, ".png");
  writeLights();
  EXPECT_NE(open()->bytes(), nullptr);
  PhotographOptions half;
  half.shrink = 2;
  EXPECT_EQ(openPhotographs(folder_.path(), half, listener_)->bytes(), nullptr);
  folder_.writeText("lights.lp", "photo0.png 0 0 1 1\nphoto1.png 1 0 1 0.5\n");
  EXPECT_EQ(open()->bytes(), nullptr);
  writeLights();
  add("words.png", test::sketch(1, {23, 17}, 3, Word));
  writeLights();
  EXPECT_EQ(open()->bytes(), nullptr);
}

TEST_F(PhotographsTest, IntensityFileOfTheFolderCounts) {
  addSeveral(2, ".exr", {23, 17}, 3, Float);
  writeLights();
  folder_.writeText("light_intensities.txt", "1 2 4\n8 8 8\n");
  const auto capture = open();
  EXPECT_EQ(capture->transfer(), Transfer::Linear);
  const std::vector<float> samples = test::readAll(*capture);
  const float intensities[2][3] = {{1, 2, 4}, {8, 8, 8}};
  for (int light = 0; light < 2; ++light) {
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(((light * 3 + c) * 17 + 5) * 23 + 9);
      EXPECT_FLOAT_EQ(samples[at],
                      static_cast<float>(test::pattern(light, 9, 5, c)) / intensities[light][c]);
    }
  }
}

TEST_F(PhotographsTest, TransferCanBeGiven) {
  addSeveral(1, ".png");
  writeLights();
  PhotographOptions options;
  options.transfer = Transfer::Linear;
  const auto capture = open(options);
  EXPECT_EQ(capture->transfer(), Transfer::Linear);
  EXPECT_EQ(test::readAll(*capture), test::readAll(*open()));
}

TEST_F(PhotographsTest, LinearAndEncodedPhotographsDoNotMix) {
  add("a.exr", test::sketch(1, {23, 17}, 3, Float));
  add("b.png", test::sketch(1));
  writeLights();
  EXPECT_EQ(errorOf(), (folder_ / "b.png").string() +
                           ": expected linear values as in a.exr, found sRGB-encoded ones");
}

TEST_F(PhotographsTest, MaskPictureCounts) {
  addSeveral(1, ".png");
  writeLights();
  Sketch mask = test::sketch(0, {23, 17}, 1);
  mask.value = [](int x, int y, int) { return (x + y) % 3 / 2.0; };
  test::write(folder_ / "mask.png", mask);
  PhotographOptions options;
  options.mask = folder_ / "mask.png";
  const auto capture = open(options);
  EXPECT_THAT(listener_.remarks, IsEmpty()) << "the mask is no photograph without a light";
  ASSERT_TRUE(capture->hasMask());
  std::vector<float> coverage(4);
  capture->readMask(0, {3, 2, 4, 1}, coverage);
  EXPECT_THAT(coverage, ElementsAre(1.0f, 0.0f, 128 / 255.0f, 1.0f));
}

TEST_F(PhotographsTest, AlphaIsTheMaskTheLeastOfAll) {
  for (int i = 0; i < 3; ++i) {
    Sketch sketch = test::sketch(i, {8, 100}, 4);
    sketch.attributes["oiio:UnassociatedAlpha"] = 1;
    sketch.value = [i](int x, int y, int c) {
      return c < 3 ? test::pattern(i, x, y, c) : x == i ? 51 / 255.0 : 1.0;
    };
    add("a" + std::to_string(i) + ".png", sketch);
  }
  add("opaque.png", test::sketch(9, {8, 100}));
  writeLights();
  for (const auto& capture : {open(), openInBands()}) {
    ASSERT_TRUE(capture->hasMask());
    std::vector<float> coverage(5 * 60);
    capture->readMask(0, {0, 20, 5, 60}, coverage);
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      EXPECT_EQ(coverage[i], i % 5 < 3 ? 51 / 255.0f : 1.0f) << i;
    }
    const std::vector<float> samples = test::readAll(*capture, {1, 2, 1, 1});
    EXPECT_EQ(samples[0], static_cast<float>(byteOf(0, 1, 2, 0)) / 255.0f) << "straight colours";
  }
}

TEST_F(PhotographsTest, WithoutMaskEverythingIsCovered) {
  addSeveral(1, ".png");
  writeLights();
  std::vector<float> coverage(6, 0.0f);
  open()->readMask(0, {0, 0, 3, 2}, coverage);
  EXPECT_THAT(coverage, testing::Each(1.0f));
}

TEST_F(PhotographsTest, CropIsAWindow) {
  addSeveral(4, ".jpg", kLarge);
  writeLights();
  PhotographOptions options;
  options.crop = Rectangle{7, 11, 130, 540};
  const std::vector<float> expected = test::readAll(*open(), {7, 11, 130, 540});
  EXPECT_EQ(openInBands(options)->bandRows(), 8);
  for (const auto& capture : {open(options), openInBands(options)}) {
    EXPECT_EQ(capture->size(), (Size{130, 540}));
    EXPECT_EQ(test::readAll(*capture), expected);
  }
}

// Means of linear light, by the definition.
TEST_F(PhotographsTest, ShrinkingAveragesLinearLight) {
  addSeveral(3, ".png", kLarge);
  writeLights();
  const auto full = open();
  PhotographOptions options;
  options.shrink = 3;
  options.crop = Rectangle{2, 5, 56, 590};
  EXPECT_EQ(openInBands(options)->bandRows(), 8);
  for (const auto& capture : {open(options), openInBands(options)}) {
    ASSERT_EQ(capture->size(), (Size{18, 196}));
    const std::vector<float> samples = test::readAll(*capture, {4, 1, 10, 20});
    std::size_t at = 0;
    const auto source = test::readAll(*full);
    for (int plane = 0; plane < 9; ++plane) {
      for (int y = 1; y < 21; ++y) {
        for (int x = 4; x < 14; ++x) {
          double sum = 0;
          for (int k = 0; k < 9; ++k) {
            const int sx = 2 + 3 * x + k % 3, sy = 5 + 3 * y + k / 3;
            sum +=
                linearFromDisplay(source[static_cast<std::size_t>((plane * 600 + sy) * 160 + sx)]);
          }
          ASSERT_NEAR(samples[at++], displayFromLinear(static_cast<float>(sum / 9)), 2e-6)
              << plane << " " << x << " " << y;
        }
      }
    }
  }
}

TEST_F(PhotographsTest, ImpossibleWindowsAreRefused) {
  addSeveral(1, ".png");
  writeLights();
  PhotographOptions options;
  options.crop = Rectangle{20, 0, 4, 4};
  EXPECT_EQ(errorOf(options),
            "crop: expected a rectangle within 23x17 pixels, found 4x4 at (20, 0)");
  options.crop = Rectangle{0, 0, 0, 4};
  EXPECT_THAT(errorOf(options), HasSubstr("found 0x4"));
  options.crop = Rectangle{2147483647, 0, 2147483647, 4};
  EXPECT_THAT(errorOf(options), HasSubstr("crop"));
  options.crop.reset();
  options.shrink = 18;
  EXPECT_EQ(errorOf(options), "shrink: expected at most 17, found 18");
  options.shrink = 0;
  EXPECT_THAT(errorOf(options), HasSubstr("shrink"));
}

TEST_F(PhotographsTest, SrgbProfileChangesNothing) {
  addSeveral(1, ".png", {23, 17}, 3, Byte, {{"ICCProfile", test::displayProfile()}});
  writeLights();
  const std::vector<float> samples = test::readAll(*open());
  EXPECT_EQ(samples[5 * 23 + 7], static_cast<float>(byteOf(0, 7, 5, 0)) / 255.0f);
}

TEST_F(PhotographsTest, AdobeRgbBecomesSrgb) {
  for (const std::string ending : {".png", ".jpg", ".tif"}) {
    const Folder folder;
    Sketch sketch = test::sketch(0);
    sketch.attributes["ICCProfile"] = test::powerProfile(563 / 256.0, true);
    // Inside of sRGB's gamut, and flat, so that JPEG keeps it.
    const double colour[3] = {150 / 255.0, 140 / 255.0, 100 / 255.0};
    sketch.value = [&](int, int, int c) { return colour[c]; };
    test::write(folder / ("a" + ending), sketch);
    folder.writeText("lights.lp", "a" + ending + " 0 0 1");
    const auto capture = openPhotographs(folder.path(), {}, listener_);
    EXPECT_EQ(capture->transfer(), Transfer::Display);
    const std::vector<float> samples = test::readAll(*capture, {3, 4, 1, 1});
    // Adobe RGB (1998) to linear Rec.709, both D65.
    const double toRec709[3][3] = {{1.39836, -0.39836, 0}, {0, 1, 0}, {0, -0.04293, 1.04293}};
    for (std::size_t c = 0; c < 3; ++c) {
      double linear = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        linear += toRec709[c][k] * std::pow(colour[k], 563 / 256.0);
      }
      EXPECT_NEAR(samples[c], displayFromLinear(static_cast<float>(linear)), 1.5 / 255)
          << ending << " " << c;
    }
  }
}

TEST_F(PhotographsTest, LinearProfileMeansLinear) {
  addSeveral(1, ".tif", {23, 17}, 3, Word, {{"ICCProfile", test::powerProfile(1, false)}});
  writeLights();
  const auto capture = open();
  EXPECT_EQ(capture->transfer(), Transfer::Linear);
  EXPECT_NEAR(test::readAll(*capture)[3], test::pattern(0, 3, 0, 0), 1.0 / 65535);
}

TEST_F(PhotographsTest, FloatsOfAnEncodingProfileBecomeLinear) {
  addSeveral(1, ".tif", {23, 17}, 3, Float, {{"ICCProfile", test::powerProfile(1.8, false)}});
  writeLights();
  const auto capture = open();
  EXPECT_EQ(capture->transfer(), Transfer::Linear);
  EXPECT_NEAR(test::readAll(*capture)[3], std::pow(test::pattern(0, 3, 0, 0), 1.8), 1e-4);
}

TEST_F(PhotographsTest, UnusualGammaBecomesSrgb) {
  addSeveral(1, ".png", {23, 17}, 3, Byte,
             {{"oiio:ColorSpace", std::string("GammaCorrected")}, {"oiio:Gamma", 1.5f}});
  writeLights();
  const auto samples = test::readAll(*open());
  const float linear = static_cast<float>(std::pow(byteOf(0, 3, 0, 0) / 255.0, 1.5));
  EXPECT_NEAR(samples[3], displayFromLinear(linear), 3e-3);
}

TEST_F(PhotographsTest, ProfilesAreLeftAloneWhenTheTransferIsGiven) {
  addSeveral(1, ".png", {23, 17}, 3, Byte, {{"ICCProfile", test::powerProfile(1.8, true)}});
  writeLights();
  PhotographOptions options;
  options.transfer = Transfer::Display;
  EXPECT_EQ(test::readAll(*open(options))[3], static_cast<float>(byteOf(0, 3, 0, 0)) / 255.0f);
  EXPECT_THAT(listener_.remarks, ElementsAre(HasSubstr("profile")));
}

TEST_F(PhotographsTest, FingerprintTellsEveryDifference) {
  addSeveral(3, ".png");
  writeLights();
  const std::string first = open()->fingerprint();
  EXPECT_EQ(open()->fingerprint(), first);
  EXPECT_EQ(openInBands()->fingerprint(), first) << "memory changes no sample";
  PhotographOptions options;
  options.shrink = 2;
  EXPECT_NE(open(options)->fingerprint(), first);
  options = {};
  options.crop = Rectangle{0, 0, 23, 16};
  EXPECT_NE(open(options)->fingerprint(), first);
  options = {};
  options.transfer = Transfer::Linear;
  EXPECT_NE(open(options)->fingerprint(), first);
  options = {};
  test::write(folder_ / "mask.png", test::sketch(0, {23, 17}, 1));
  options.mask = folder_ / "mask.png";
  EXPECT_NE(open(options)->fingerprint(), first);

  auto bytes = test::bytesOf(folder_ / "photo1.png");
  test::write(folder_ / "photo1.png", test::sketch(17));
  EXPECT_NE(open()->fingerprint(), first);
  test::writeBytes(folder_ / "photo1.png", bytes);
  EXPECT_EQ(open()->fingerprint(), first);
  folder_.writeText("lights.lp", "photo0.png 0 0 1\nphoto1.png 1 0 1\nphoto2.png 0 1 1\n");
  const std::string moved = open()->fingerprint();
  EXPECT_NE(moved, first);
  folder_.writeText("lights.lp", "photo0.png 0 0 1 2\nphoto1.png 1 0 1 2\nphoto2.png 0 1 1 3\n");
  EXPECT_NE(open()->fingerprint(), moved);
}

TEST_F(PhotographsTest, TooLittleMemoryIsOneSentenceWithTheLeast) {
  addSeveral(40, ".jpg", {200, 100});
  writeLights();
  PhotographOptions options;
  options.memoryBytes = 100000;
  std::string sentence = errorOf(options);
  ASSERT_THAT(sentence, HasSubstr("reading 40 photographs of 200x100 pixels needs at least "));
  ASSERT_THAT(sentence, HasSubstr("--max-memory gives it "));
  // The number that it names is enough, up to its rounding.
  const std::string begin = "at least ";
  const std::size_t at = sentence.find(begin) + begin.size();
  std::string number = sentence.substr(at, sentence.find(" of memory") - at);
  std::erase(number, ' ');
  options.memoryBytes = bytesFromText(number) / 100 * 105;
  EXPECT_NO_THROW(open(options)->residentBytes()) << sentence;
  EXPECT_LE(open(options)->residentBytes(), options.memoryBytes);
}

TEST_F(PhotographsTest, ResidentBytesKeepToTheLimit) {
  addSeveral(10, ".jpg", {200, 300});
  add("p.jpg", [] {
    Sketch sketch = test::sketch(3, {200, 300});
    sketch.attributes["jpeg:progressive"] = 1;
    return sketch;
  }());
  writeLights();
  for (std::uint64_t megabytes : {4, 5, 8, 20, 100}) {
    PhotographOptions options;
    options.memoryBytes = megabytes << 20;
    const auto capture = open(options);
    EXPECT_LE(capture->residentBytes(), options.memoryBytes);
    EXPECT_TRUE(capture->bandRows() % 8 == 0 || capture->bandRows() == 300);
  }
}

TEST_F(PhotographsTest, NamesAreForgivenWithOneRemark) {
  addSeveral(3, ".png");
  add("extra.png", test::sketch(1));
  folder_.writeText("lights.lp",
                    "C:\\shots\\PHOTO0.PNG 0 0 1\nphoto1.tif 1 0 0\nphoto2.jpg 0 1 0\n");
  open();
  EXPECT_THAT(listener_.remarks, ElementsAre(HasSubstr("upper and lower case"), HasSubstr("2 of 3"),
                                             HasSubstr("extra.png")));
}

TEST_F(PhotographsTest, ScratchNeedsAFolder) {
  addSeveral(2, ".jpg", {200, 300}, 3, Byte, {{"jpeg:progressive", 1}});
  writeLights();
  PhotographOptions options;
  options.memoryBytes = 800000;
  options.scratch = folder_ / "nowhere";
  const auto capture = open(options);
  EXPECT_THAT(listener_.remarks, ElementsAre(HasSubstr("scratch file of")));
  try {
    test::readAll(*capture);
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Machine);
    EXPECT_THAT(error.what(), HasSubstr("nowhere: cannot make a scratch file of"));
  }
}

}  // namespace
}  // namespace illum
