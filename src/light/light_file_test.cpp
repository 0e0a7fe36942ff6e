#include "illum/light_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <random>

#include "illum/error.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

LightFile parse(std::string_view text) {
  return parseLightFile(text, "lights.lp");
}

std::vector<std::string> names(const LightFile& lights) {
  std::vector<std::string> result;
  for (const LightFileEntry& entry : lights.entries) result.push_back(entry.name);
  return result;
}

std::string errorOf(std::string_view text) {
  try {
    const LightFile lights = parse(text);
    return "no error, " + std::to_string(lights.entries.size()) + " entries";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input) << error.what();
    return error.what();
  }
}

void expectTwo(std::string_view text) {
  SCOPED_TRACE(std::string(text));
  LightFile lights;
  ASSERT_NO_THROW(lights = parse(text));
  ASSERT_THAT(names(lights), ElementsAre("a b.jpg", "c.jpg"));
  EXPECT_THAT(lights.remarks, IsEmpty());
  EXPECT_EQ(lights.entries[0].light.toLight, Direction());
  EXPECT_NEAR(lights.entries[1].light.toLight.x(), 0.6, 1e-12);
  EXPECT_NEAR(lights.entries[1].light.toLight.z(), 0.8, 1e-12);
  EXPECT_EQ(lights.entries[1].light.intensity, (LinearRgb{1, 1, 1}));
}

TEST(LightFile, FormsFoundInTheWild) {
  expectTwo("2\na b.jpg 0 0 1\nc.jpg 0.6 0 0.8\n");
  expectTwo("a b.jpg 0 0 1\nc.jpg 0.6 0 0.8");
  expectTwo("2\r\na b.jpg 0 0 1\r\nc.jpg 0.6 0 0.8\r\n");
  expectTwo("2\ra b.jpg 0 0 1\rc.jpg 0.6 0 0.8\r");
  expectTwo(
      "\xEF\xBB\xBF"
      "2\na b.jpg 0 0 1\nc.jpg 0.6 0 0.8\n");
  expectTwo("  2  \n\n  a b.jpg\t0\t0\t1  \n\n\nc.jpg\t0.6 0  0.8\n\n");
  expectTwo("# dome 7\n2\n// top\na b.jpg 0 0 1 # zenith\nc.jpg 0.6 0 0.8 // east\n");
  expectTwo("name,x,y,z\na b.jpg,0,0,1\nc.jpg,0.6,0,0.8\n");
  expectTwo("x;y;z;image\n0;0;1;a b.jpg\n0.6;0;0.8;c.jpg\n");
  expectTwo("2\nfile lx ly lz\n0 0 1 a b.jpg\n.6 0 .8 c.jpg\n");
  expectTwo("name x y z\n2\n\"a b.jpg\" 0 0 1\n\"c.jpg\" 0.6 0 0.8\n");
  expectTwo("2,,,\na b.jpg,0,0,1,\nc.jpg,0.6,0,0.8,\n");
  expectTwo("C:\\RTI data\\jpeg-exports\\a b.jpg 0 0 1\nD:\\c.jpg 0.6 0 0.8\n");
  expectTwo("/home/me/my photos/a b.jpg 0 0 1\n./c.jpg 6e-1 0 +0.8\n");
  expectTwo("a b.jpg 0 0 1.0005\nc.jpg 0.6 0 0.8\n");
}

TEST(LightFile, LinesAreNumberedAsInTheFile) {
  const LightFile lights = parse("2\n\n# x\na.jpg 0 0 1\r\n\r\nb.jpg 1 0 0\n");
  EXPECT_EQ(lights.entries[0].line, 4);
  EXPECT_EQ(lights.entries[1].line, 6);
}

TEST(LightFile, IntensitiesInFourAndSixNumbers) {
  const LightFile lights = parse("a.jpg 0 0 1 2.5\nb.jpg 0 0 1 1 2 3\nc.jpg 0 0 1\n");
  EXPECT_EQ(lights.entries[0].light.intensity, (LinearRgb{2.5F, 2.5F, 2.5F}));
  EXPECT_EQ(lights.entries[1].light.intensity, (LinearRgb{1, 2, 3}));
  EXPECT_EQ(lights.entries[2].light.intensity, (LinearRgb{1, 1, 1}));
}

TEST(LightFile, LightsMayBeAnywhereOnTheSphere) {
  const LightFile lights = parse("a.jpg 0 0 -1\nb.jpg 0 -1 0\nc.jpg 0 0 1");
  EXPECT_EQ(lights.entries[0].light.toLight.z(), -1);
  EXPECT_EQ(lights.entries[1].light.toLight.y(), -1);
  EXPECT_THAT(lights.remarks, IsEmpty());
}

TEST(LightFile, RemarksOnLengthsOnce) {
  const LightFile lights = parse("a.jpg 0 0 0.79\nb.jpg 0 1.06 0\nc.jpg 1 0 0\n");
  EXPECT_EQ(lights.entries[1].light.toLight.y(), 1);
  EXPECT_THAT(lights.remarks, ElementsAre(AllOf(HasSubstr("2 of 3"), HasSubstr("0.79 to 1.06"),
                                                HasSubstr("normalised"))));
}

TEST(LightFile, PositionsBecomeDirections) {
  const LightFile lights = parse("a.jpg 0 0 450\nb.jpg 300 0 400\n");
  EXPECT_NEAR(lights.entries[1].light.toLight.x(), 0.6, 1e-15);
  EXPECT_THAT(lights.remarks, ElementsAre(AllOf(HasSubstr("450 to 500"), HasSubstr("positions"))));
}

TEST(LightFile, DuplicatesAreMergedWithARemark) {
  const char* text = "a.jpg 0 0 1\nb.jpg 1 0 0\na.jpg 0 0 1\nb.jpg 1 0 0\n";
  const LightFile lights = parse(text);
  EXPECT_THAT(names(lights), ElementsAre("a.jpg", "b.jpg"));
  EXPECT_THAT(lights.remarks,
              ElementsAre(AllOf(HasSubstr("2 repeated"), HasSubstr("line 3 repeats line 1"))));
  EXPECT_EQ(names(parse("4\n" + std::string(text))).size(), 2U) << "the count is of lines";
  EXPECT_EQ(names(parse("2\n" + std::string(text))).size(), 2U) << "the count is of photographs";
  EXPECT_THAT(errorOf("3\n" + std::string(text)), HasSubstr("3 entries"));
}

TEST(LightFile, TwoPhotographsMayShareALight) {
  EXPECT_THAT(names(parse("a.jpg 0 0 1\nb.jpg 0 0 1\n")), ElementsAre("a.jpg", "b.jpg"));
}

TEST(LightFile, RemarksOnDecimalCommas) {
  const LightFile lights = parse("a.jpg;0,6;0;0,8\nb.jpg;0;0;1\n");
  EXPECT_NEAR(lights.entries[0].light.toLight.x(), 0.6, 1e-12);
  EXPECT_THAT(lights.remarks, ElementsAre(HasSubstr("decimal commas")));
}

TEST(LightFile, RemarksWhenEveryLightIsBehind) {
  EXPECT_THAT(parse("a.jpg 0 0 -1\nb.jpg 0.6 0 -0.8\n").remarks, ElementsAre(HasSubstr("behind")));
}

struct BadCase {
  std::string text;
  const char* sentence;
};

TEST(LightFile, HostileFilesAreOneSentence) {
  const BadCase cases[] = {
      {"", "no entry at all"},
      {"\n\n# nothing\n", "no entry at all"},
      {"0\n", "no entry at all"},
      {"\xEF\xBB\xBF", "no entry at all"},
      {"name x y z\n", "no entry at all"},
      {"3\na.jpg 0 0 1\nb.jpg 0 1 0\n", "expected 3 entries, as line 1 says, found 2"},
      {"# c\n1\na.jpg 0 0 1\nb.jpg 0 1 0\n", "expected 1 entries, as line 2 says, found 2"},
      {"0\na.jpg 0 0 1\n", "expected 0 entries, as line 1 says, found 1"},
      {"99999999999999999999999\na.jpg 0 0 1\n", "found 1"},
      {"-1\na.jpg 0 0 1\n", "lights.lp:1: expected a photograph's name"},
      {"2.0\na.jpg 0 0 1\nb.jpg 0 1 0", "lights.lp:1:"},
      {"1\n1\na.jpg 0 0 1\n", "lights.lp:2:"},
      {"a.jpg 0 0 1\n1\n", "lights.lp:2:"},
      {"a.jpg\n", "lights.lp:1:"},
      {"a.jpg 0 1\n", "found 'a.jpg 0 1'"},
      {"a.jpg 0 0 1 1 1\n", "3, 4 or 6 numbers"},
      {"0 0 1\n", "a photograph's name"},
      {"\"\" 0 0 1\n", "a photograph's name"},
      {"C:\\photos\\ 0 0 1\n", "a photograph's name"},
      {".. 0 0 1\n", "a photograph's name"},
      {"a/. 0 0 1\n", "a photograph's name"},
      {"a.jpg nan 0 1\n", "finite coordinates"},
      {"a.jpg 0 inf 1\n", "finite coordinates"},
      {"a.jpg 0 0 -1.#IND\n", "finite coordinates"},
      {"a.jpg 0 0 1e400\n", "finite coordinates"},
      {"a.jpg 0 0 0\n", "the zero vector"},
      {"a.jpg 0 -0.0 0e5\n", "the zero vector"},
      {"a.jpg 0 0 1 0\n", "positive, finite intensity"},
      {"a.jpg 0 0 1 -2\n", "positive, finite intensity, found -2"},
      {"a.jpg 0 0 1 1 1 nan\n", "positive, finite intensity"},
      {"a.jpg 0 0 1 1e300\n", "positive, finite intensity"},
      {"a.jpg 0 0 1 1e-300\n", "positive, finite intensity"},
      {"a.jpg 0 0 1\na.jpg 0 1 0\n", "lights.lp:2: expected one light for 'a.jpg', as in line 1"},
      {"a.jpg 0 0 1 1\na.jpg 0 0 1 2\n", "one light for 'a.jpg'"},
      {"x/a.jpg 0 0 1\ny/a.jpg 0 1 0\n", "one light for 'a.jpg'"},
      {"header x y z\nheader x y z\na.jpg 0 0 1\n", "lights.lp:2:"},
      {"a.jpg 0 0 1\nname x y z\n", "lights.lp:2:"},
      {"a.jpg,,0,0,1\n", "lights.lp:1:"},
      {std::string("a.jpg\0 0 0 1\n", 13), "binary data"},
      {"\xFF\xD8\xFF\xE0JFIF", "lights.lp:1:"},
      {std::string("\xFF\xFE"
                   "a\0",
                   4),
       "UTF-16"},
      {std::string(5000, 'x'), "at most 4096 bytes, found 5000 bytes"},
      {std::string(4000, '9'), "no entry at all"},
      {std::string(4000, '1') + " 0 0 1 0 0 0 0", "lights.lp:1:"},
      {"a.jpg 0 0 1\nb.jpg 0 0\x1B[2J 1\n", "?[2J"},
  };
  for (const BadCase& bad : cases) {
    const std::string sentence = errorOf(bad.text);
    EXPECT_THAT(sentence, AllOf(HasSubstr(bad.sentence), HasSubstr("lights.lp")))
        << testing::PrintToString(bad.text.substr(0, 80));
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
    EXPECT_LT(sentence.size(), 300U);
  }
}

TEST(LightFile, EveryTruncationIsReadOrRefused) {
  const std::string whole =
      "\xEF\xBB\xBF"
      "3\r\nname,x,y,z\r\n\"a b.jpg\",0,0,1\r\n"
      "c.jpg,0.6,0,0.8,2 # x\r\nd.jpg;0,5;0,5;0,5\r\n";
  EXPECT_EQ(parse(whole).entries.size(), 3U);
  int read = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    try {
      const LightFile lights = parse(whole.substr(0, length));
      EXPECT_EQ(lights.entries.size(), 3U) << length << ": the count line must have been checked";
      ++read;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input) << length;
    }
  }
  EXPECT_GE(read, 2) << "without its last line end the file is complete";
}

TEST(LightFile, RandomTextIsReadOrRefused) {
  const char* const pieces[] = {"a",   "b.jpg", "0",     "1",  "-0.5",
                                "0,5", "nan",   "1e999", "'",  "\"",
                                " ",   " ",     " ",     "\t", ",",
                                ";",   "\n",    "\r\n",  "#",  "//",
                                "\\",  "+",     "-1",    ".",  "\xEF\xBB\xBF",
                                "\xC3"};
  std::mt19937 random(3);
  int read = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string text;
    for (unsigned n = random() % 24; n > 0; --n) text += pieces[random() % std::size(pieces)];
    try {
      for (const LightFileEntry& entry : parse(text).entries) {
        EXPECT_FALSE(entry.name.empty()) << text;
        EXPECT_NEAR(length(entry.light.toLight.vector()), 1, 1e-12) << text;
        EXPECT_GT(entry.light.intensity.g, 0) << text;
        ++read;
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input) << text;
    }
  }
  EXPECT_GT(read, 100);
}

TEST(LightFile, EntriesAreLimited) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += std::to_string(i) + " 0 0 1\n";
  EXPECT_THAT(errorOf(text + "x 0 0 1\n"),
              HasSubstr("lights.lp:1000001: expected at most 1000000 entries"));
}

class LightFiles : public testing::Test {
 protected:
  LightFiles() : folder_(fs::path(testing::TempDir()) / ("lights-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~LightFiles() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(LightFiles, AreReadFromDisk) {
  std::ofstream(folder_ / "lights.lp") << "1\na.jpg 0 0 1\n";
  EXPECT_THAT(names(readLightFile(folder_ / "lights.lp")), ElementsAre("a.jpg"));
  EXPECT_THROW(readLightFile(folder_ / "missing.lp"), Error);
  EXPECT_THROW(readLightFile(folder_), Error);
}

TEST_F(LightFiles, LargerThanTheLimitAreRefusedUnread) {
  const fs::path file = folder_ / "huge.lp";
  std::ofstream(file) << "1\n";
  fs::resize_file(file, (64ULL << 20) + 1);  // sparse
  try {
    readLightFile(file);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("at most 67108864 bytes"));
  }
}

// Real files, where they are at hand: as many lights as photographs, all unit, all lit from the
// front.
TEST(LightFile, RealStacks) {
  const char* variable = std::getenv("ILLUM_SHARED");
  const fs::path data =
      (variable != nullptr ? fs::path(variable) : fs::path(ILLUM_SOURCE_DIR) / ".." / "shared") /
      "data";
  if (!fs::is_directory(data)) GTEST_SKIP() << "no test data at " << data;
  int stacks = 0;
  for (const auto& folder : fs::directory_iterator(data)) {
    const fs::path stack = folder.path() / "stack";
    if (!fs::exists(stack / "lights.lp")) continue;
    const LightFile lights = readLightFile(stack / "lights.lp");
    EXPECT_THAT(lights.remarks, IsEmpty()) << stack;
    for (const LightFileEntry& entry : lights.entries) {
      EXPECT_TRUE(fs::exists(stack / entry.name)) << stack << entry.name;
      EXPECT_GT(entry.light.toLight.z(), 0) << stack << entry.name;
    }
    const auto files = std::distance(fs::directory_iterator(stack), fs::directory_iterator());
    EXPECT_EQ(static_cast<std::ptrdiff_t>(lights.entries.size()) + 1, files) << stack;
    ++stacks;
  }
  EXPECT_GE(stacks, 8);
}

}  // namespace
}  // namespace illum
