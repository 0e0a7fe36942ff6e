// Folders that nobody should have: each is one sentence that names the file, and never more than
// that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <random>

#include "capture/test_photographs.h"
#include "illum/capture.h"
#include "illum/error.h"

namespace illum {
namespace {

using test::Folder;
using test::Sketch;
using testing::HasSubstr;
using enum SampleType;

constexpr Size kSize{160, 600};

// A stack of three, whose second photograph is the one that things happen to.
struct Stack {
  explicit Stack(const std::string& ending, SampleType type = Byte,
                 const std::map<std::string, test::Attribute>& attributes = {}, int channels = 3)
      : victim(folder / ("b" + ending)) {
    for (const char* stem : {"a", "b", "c"}) {
      Sketch sketch = test::sketch(stem[0], kSize, channels, type);
      sketch.attributes = attributes;
      test::write(folder / (stem + ending), sketch);
    }
    folder.writeText("lights.lp", test::lightFileText(
                                      3, [&](int i) { return std::string(1, "abc"[i]) + ending; }));
  }

  Folder folder;
  std::filesystem::path victim;
};

struct Outcome {
  bool failed = false;
  Fault fault = Fault::Input;
  std::string sentence;
};

Outcome readEverything(const Folder& folder, std::uint64_t memoryBytes) {
  test::Listener listener;
  PhotographOptions options;
  options.memoryBytes = memoryBytes;
  Outcome outcome;
  try {
    const auto capture = openPhotographs(folder.path(), options, listener);
    test::readAll(*capture, {0, 0, 8, capture->size().height});
  } catch (const Error& error) {
    outcome = {true, error.fault(), error.what()};
  }
  EXPECT_EQ(listener.open, 0) << "a stage of progress was left open";
  return outcome;
}

constexpr std::uint64_t kPlenty = std::uint64_t{256} << 20;

// Enough for bands and not for everything. Floats are larger.
std::uint64_t littleFor(const Folder& folder) {
  return std::filesystem::exists(folder / "a.exr") ? 6500000 : 2500000;
}

void expectOneSentence(const Folder& folder, const std::string& name, const std::string& part) {
  for (const std::uint64_t memory : {kPlenty, littleFor(folder)}) {
    const Outcome outcome = readEverything(folder, memory);
    EXPECT_TRUE(outcome.failed) << name << " " << part << " with " << memory;
    EXPECT_EQ(outcome.fault, Fault::Input) << outcome.sentence;
    EXPECT_THAT(outcome.sentence, HasSubstr(name));
    EXPECT_THAT(outcome.sentence, HasSubstr(part));
    EXPECT_EQ(outcome.sentence.find('\n'), std::string::npos) << outcome.sentence;
    EXPECT_LT(outcome.sentence.size(), 400u) << outcome.sentence;
  }
}

TEST(HostilePhotographs, Missing) {
  const Stack stack(".png");
  std::filesystem::remove(stack.victim);
  expectOneSentence(stack.folder, "lights.lp", "\"b.png\" of line 3");
}

TEST(HostilePhotographs, MissingSeveral) {
  const Stack stack(".png");
  std::filesystem::remove(stack.folder / "a.png");
  std::filesystem::remove(stack.victim);
  expectOneSentence(stack.folder, "lights.lp", "\"a.png\" of line 2 and 1 others");
}

TEST(HostilePhotographs, Empty) {
  const Stack stack(".jpg");
  test::writeBytes(stack.victim, {});
  expectOneSentence(stack.folder, "b.jpg", "found an empty file");
}

TEST(HostilePhotographs, OneByte) {
  const Stack stack(".png");
  test::writeBytes(stack.victim, {std::byte{0x89}});
  expectOneSentence(stack.folder, "b.png", "expected a PNG picture");
}

TEST(HostilePhotographs, Text) {
  const Stack stack(".jpg");
  stack.folder.writeText("b.jpg", "this is no picture at all, but it is long enough to be one\n");
  expectOneSentence(stack.folder, "b.jpg", "expected a JPEG picture, found something else");
}

TEST(HostilePhotographs, NamedAfterAnotherFormat) {
  const Stack stack(".jpg");
  test::write(stack.folder / "other.png", test::sketch(1, kSize));
  std::filesystem::rename(stack.folder / "other.png", stack.victim);
  expectOneSentence(stack.folder, "b.jpg", "expected a JPEG picture as its name says, found a PNG");
}

TEST(HostilePhotographs, ResizedAndTurned) {
  for (const Size size : {Size{160, 599}, Size{600, 160}, Size{1, 1}}) {
    const Stack stack(".png");
    test::write(stack.victim, test::sketch(1, size));
    expectOneSentence(stack.folder, "b.png",
                      "expected 160x600 pixels as a.png, found " + std::to_string(size.width) +
                          "x" + std::to_string(size.height));
  }
}

TEST(HostilePhotographs, FolderInItsPlace) {
  const Stack stack(".png");
  std::filesystem::remove(stack.victim);
  std::filesystem::create_directory(stack.victim);
  expectOneSentence(stack.folder, "lights.lp", "b.png");
}

TEST(HostilePhotographs, PipeInItsPlace) {
  const Stack stack(".png");
  std::filesystem::remove(stack.victim);
  ASSERT_EQ(mkfifo(stack.victim.c_str(), 0600), 0);
  expectOneSentence(stack.folder, "lights.lp", "b.png");
}

TEST(HostilePhotographs, DanglingLink) {
  const Stack stack(".png");
  std::filesystem::remove(stack.victim);
  std::filesystem::create_symlink("nowhere.png", stack.victim);
  expectOneSentence(stack.folder, "lights.lp", "b.png");
}

TEST(HostilePhotographs, NoFolderNoLightsNoChoice) {
  const Stack stack(".png");
  test::Listener listener;
  const auto sentenceOf = [&](const std::filesystem::path& path) -> std::string {
    try {
      openPhotographs(path, {}, listener);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input);
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(sentenceOf(stack.folder / "nowhere"), HasSubstr("nowhere: cannot open the folder"));
  EXPECT_THAT(sentenceOf(stack.victim), HasSubstr("b.png: expected a folder"));
  std::filesystem::rename(stack.folder / "lights.lp", stack.folder / "one.lp");
  std::filesystem::copy(stack.folder / "one.lp", stack.folder / "two.lp");
  EXPECT_THAT(sentenceOf(stack.folder.path()), HasSubstr("found one.lp, two.lp"));
  std::filesystem::remove(stack.folder / "one.lp");
  std::filesystem::remove(stack.folder / "two.lp");
  EXPECT_THAT(sentenceOf(stack.folder.path()), HasSubstr("expected a light file"));
}

TEST(HostilePhotographs, NotFinite) {
  struct Bad {
    float value;
    const char* word;
  };
  for (const Bad bad : {Bad{std::numeric_limits<float>::quiet_NaN(), "nan"},
                        Bad{std::numeric_limits<float>::infinity(), "inf"},
                        Bad{-std::numeric_limits<float>::infinity(), "-inf"}}) {
    for (const int exif : {1, 6}) {
      const Stack stack(".exr", Float, {{"Orientation", exif}});
      Sketch sketch = test::sketch(1, kSize, 3, Float);
      sketch.attributes["Orientation"] = exif;
      sketch.value = [&](int x, int y, int c) {
        return x == 17 && y == 301 && c == 1 ? static_cast<double>(bad.value) : 0.5;
      };
      test::write(stack.victim, sketch);
      const std::string pixel = exif == 1 ? "(17, 301)" : "(298, 17)";
      expectOneSentence(
          stack.folder, "b.exr",
          std::string("expected finite samples, found ") + bad.word + " at pixel " + pixel);
    }
  }
}

TEST(HostilePhotographs, ChangedBetweenOpeningAndReading) {
  const Stack stack(".png");
  test::Listener listener;
  const auto capture = openPhotographs(stack.folder.path(), {}, listener);
  // The pool keeps files open; an overwritten one changes under it.
  auto bytes = test::bytesOf(stack.victim);
  for (std::size_t i = bytes.size() / 2; i < bytes.size(); ++i) bytes[i] = std::byte{0};
  test::writeBytes(stack.victim, bytes);
  EXPECT_THROW(test::readAll(*capture), Error);
  EXPECT_THROW(test::readAll(*capture), Error) << "asking again is no way around it";
}

struct FormatCase {
  const char* name;
  const char* ending;
  SampleType type = Byte;
  std::map<std::string, test::Attribute> attributes = {};
  bool interlaced = false;
};

void PrintTo(const FormatCase& format, std::ostream* out) {
  *out << format.name;
}

class HostileFormat : public testing::TestWithParam<FormatCase> {
 protected:
  HostileFormat() : stack_(GetParam().ending, GetParam().type, GetParam().attributes) {
    if (!GetParam().interlaced) return;
    for (const char* name : {"a.png", "b.png", "c.png"}) {
      test::writeInterlacedPng(stack_.folder / name, test::sketch(name[0], kSize));
    }
  }
  Stack stack_;
};

TEST_P(HostileFormat, Truncated) {
  const std::vector<std::byte> whole = test::bytesOf(stack_.victim);
  for (const int eighths : {1, 4, 7}) {
    const auto length = whole.size() * static_cast<std::size_t>(eighths) / 8;
    test::writeBytes(stack_.victim,
                     {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    expectOneSentence(stack_.folder, stack_.victim.filename().string(), "expected");
  }
  for (const std::size_t length : {2, 19, 60}) {
    test::writeBytes(stack_.victim,
                     {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    expectOneSentence(stack_.folder, stack_.victim.filename().string(), "expected");
  }
}

class HostileEnd : public HostileFormat {};

// Formats with an end mark.
TEST_P(HostileEnd, LastByteMissing) {
  std::vector<std::byte> bytes = test::bytesOf(stack_.victim);
  bytes.pop_back();
  test::writeBytes(stack_.victim, bytes);
  expectOneSentence(stack_.folder, stack_.victim.filename().string(), "expected");
}

// A changed file may still be a picture; it must be one or an error, and nothing for the
// sanitizers.
TEST_P(HostileFormat, BitsFlipped) {
  const std::vector<std::byte> whole = test::bytesOf(stack_.victim);
  std::mt19937 random(11);
  for (int i = 0; i < 16; ++i) {
    std::vector<std::byte> bytes = whole;
    // The first third of the attempts goes for the header.
    const std::size_t reach = i < 8 ? std::min<std::size_t>(bytes.size(), 256) : bytes.size();
    for (int k = 0; k < 1 + i % 3; ++k) bytes[random() % reach] ^= std::byte{1} << random() % 8;
    test::writeBytes(stack_.victim, bytes);
    const Outcome outcome = readEverything(stack_.folder, kPlenty);
    if (outcome.failed) {
      EXPECT_THAT(outcome.sentence, HasSubstr(stack_.victim.filename().string()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, HostileFormat,
    testing::Values(FormatCase{"jpeg", ".jpg"},
                    FormatCase{"progressive", ".jpg", Byte, {{"jpeg:progressive", 1}}},
                    FormatCase{"png", ".png"}, FormatCase{"interlaced", ".png", Byte, {}, true},
                    FormatCase{"tiffLzw", ".tif", Byte, {{"compression", std::string("lzw")}}},
                    FormatCase{"tiffPlain", ".tif", Word, {{"compression", std::string("none")}}},
                    FormatCase{"tiffTiles", ".tif", Byte, {{"tile", 64}}},
                    FormatCase{"exr", ".exr", Float},
                    FormatCase{"exrTiles", ".exr", Float, {{"tile", 64}}},
                    FormatCase{"hdr", ".hdr", Float}, FormatCase{"bmp", ".bmp"},
                    FormatCase{"targa", ".tga"}, FormatCase{"pnm", ".ppm"},
                    FormatCase{"dpx", ".dpx"}, FormatCase{"sgi", ".sgi"},
                    FormatCase{"jpeg2000", ".jp2"}, FormatCase{"webp", ".webp"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    All, HostileEnd,
    testing::Values(FormatCase{"jpeg", ".jpg"},
                    FormatCase{"progressive", ".jpg", Byte, {{"jpeg:progressive", 1}}},
                    FormatCase{"png", ".png"}, FormatCase{"interlaced", ".png", Byte, {}, true},
                    FormatCase{"webp", ".webp"}),
    [](const auto& test) { return test.param.name; });

void patch(const std::filesystem::path& file, std::size_t at, std::initializer_list<int> values) {
  std::vector<std::byte> bytes = test::bytesOf(file);
  for (const int value : values) bytes.at(at++) = static_cast<std::byte>(value);
  test::writeBytes(file, bytes);
}

std::size_t find(const std::filesystem::path& file, std::initializer_list<int> values) {
  const std::vector<std::byte> bytes = test::bytesOf(file);
  const auto found = std::search(bytes.begin(), bytes.end(), values.begin(), values.end(),
                                 [](std::byte b, int v) { return b == static_cast<std::byte>(v); });
  return static_cast<std::size_t>(found - bytes.begin());
}

TEST(HostilePhotographs, HugeDeclaredSizes) {
  // The size in SOF0 (JPEG), IHDR (PNG), the VP8 frame (WebP), the bitmap header (BMP).
  const Stack jpeg(".jpg");
  patch(jpeg.victim, find(jpeg.victim, {0xff, 0xc0}) + 5, {0xff, 0xdc, 0xff, 0xdc});
  expectOneSentence(jpeg.folder, "b.jpg", "expected 160x600 pixels as a.jpg, found 65500x65500");
  const Stack progressive(".jpg", Byte, {{"jpeg:progressive", 1}});
  for (const char* name : {"a.jpg", "b.jpg", "c.jpg"}) {
    const auto file = progressive.folder / name;
    patch(file, find(file, {0xff, 0xc2}) + 5, {0xff, 0xdc, 0xff, 0xdc});
  }
  const Outcome outcome = readEverything(progressive.folder, kPlenty);
  EXPECT_EQ(outcome.fault, Fault::Machine);
  EXPECT_THAT(outcome.sentence, HasSubstr("needs at least"));
  const Stack bmp(".bmp");
  patch(bmp.victim, 18, {0, 0, 0, 0x70, 0, 0, 0, 0x70});
  expectOneSentence(bmp.folder, "b.bmp", "expected");
}

TEST(HostilePhotographs, PrintColours) {
  // A JPEG of four components is not written by OpenImageIO: change the number of a grey one's. It
  // is refused for that or for the damage, whichever is seen first.
  const Stack stack(".jpg", Byte, {}, 1);
  patch(stack.victim, find(stack.victim, {0xff, 0xc0}) + 9, {4});
  expectOneSentence(stack.folder, "b.jpg", "expected");
}

TEST(HostilePhotographs, DamagedProfile) {
  std::vector<std::byte> profile = test::powerProfile(1.8, true);
  for (std::size_t i = 4; i < profile.size(); i += 3) profile[i] = std::byte{0x5a};
  const Stack stack(".tif");
  Sketch sketch = test::sketch(1, kSize);
  sketch.attributes["ICCProfile"] = profile;
  test::write(stack.victim, sketch);
  expectOneSentence(stack.folder, "b.tif", "colour profile");
}

TEST(HostilePhotographs, MaskOfAnotherSizeOrKind) {
  const Stack stack(".png");
  test::Listener listener;
  PhotographOptions options;
  const auto sentenceOf = [&](const std::string& name) -> std::string {
    options.mask = stack.folder / name;
    try {
      openPhotographs(stack.folder.path(), options, listener);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  test::write(stack.folder / "small.png", test::sketch(1, {16, 60}, 1));
  stack.folder.writeText("text.png", "no picture");
  EXPECT_THAT(sentenceOf("small.png"),
              HasSubstr("small.png: expected a mask of 160x600 pixels, found 16x60"));
  EXPECT_THAT(sentenceOf("text.png"), HasSubstr("text.png: expected a PNG picture"));
  EXPECT_THAT(sentenceOf("nowhere.png"), HasSubstr("nowhere.png: cannot open"));
}

}  // namespace
}  // namespace illum
