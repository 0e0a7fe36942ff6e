#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "illum/error.h"
#include "illum/light_file.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class LightIntensities : public testing::Test {
 protected:
  LightIntensities() : file_(fs::path(testing::TempDir()) / ("li-" + std::to_string(::getpid()))) {}
  ~LightIntensities() override { fs::remove(file_); }

  LightFile read(std::string_view text, std::string_view lights = "a.jpg 0 0 1\nb.jpg 1 0 0\n") {
    LightFile result = parseLightFile(lights, "lights.lp");
    std::ofstream(file_, std::ios::binary) << text;
    readLightIntensities(file_, result);
    return result;
  }

  void expect(std::string_view text, LinearRgb a, LinearRgb b) {
    SCOPED_TRACE(std::string(text));
    LightFile lights;
    ASSERT_NO_THROW(lights = read(text));
    EXPECT_EQ(lights.entries[0].light.intensity, a);
    EXPECT_EQ(lights.entries[1].light.intensity, b);
  }

  fs::path file_;
};

TEST_F(LightIntensities, ByPlace) {
  const LinearRgb a{1.5F, 2, 2.5F}, b{3, 4, 5}, two{2, 2, 2}, half{0.5F, 0.5F, 0.5F};
  expect("1.5 2 2.5\n3 4 5\n", a, b);
  expect("1.5,2,2.5\r\n3,4,5", a, b);
  expect("R G B\n1.5 2 2.5\n\n# second\n3 4 5\n", a, b);
  expect("2\n1.5 2 2.5\n3 4 5\n", a, b);
  expect("2\n0.5\n", two, half);
  expect("2\n2\n0.5\n", two, half);
  expect(
      "\xEF\xBB\xBF"
      "2.0\n5e-1\n",
      two, half);
}

TEST_F(LightIntensities, ByName) {
  const LinearRgb a{1.5F, 2, 2.5F}, b{3, 4, 5}, two{2, 2, 2}, half{0.5F, 0.5F, 0.5F};
  expect("b.jpg 3 4 5\na.jpg 1.5 2 2.5\n", a, b);
  expect("image,intensity\nC:\\x\\a.jpg,2\n\"b.jpg\",0.5\n", two, half);
  expect("2\na.jpg 2\nb.jpg 0.5\n", two, half);
  expect("a.jpg 2\nb.jpg 0.5\nc.jpg 7\na.jpg 2\n", two, half);
}

TEST_F(LightIntensities, ByNamesThatAreNumbers) {
  const LightFile lights = read("002 0.5\n001 2\n", "001 0 0 1\n002 1 0 0\n");
  EXPECT_EQ(lights.entries[0].light.intensity.r, 2);
  EXPECT_EQ(lights.entries[1].light.intensity.r, 0.5F);
}

TEST_F(LightIntensities, ReplaceThoseOfTheLightFile) {
  const LightFile lights = read("2\n3\n", "a.jpg 0 0 1 7\nb.jpg 1 0 0 8\n");
  EXPECT_EQ(lights.entries[0].light.intensity.r, 2);
  EXPECT_EQ(lights.entries[1].light.intensity.r, 3);
}

TEST_F(LightIntensities, HostileFilesAreOneSentence) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected 2 intensities, one for each light, found 0"},
      {"1 1 1\n", "found 1"},
      {"1 1 1\n2 2 2\n3 3 3\n", "found 3"},
      {"1 1\n2 2\n", "an intensity for 'a.jpg'"},
      {"1 1 1 1 1\n", "one or three numbers"},
      {"1 0 1\n1 1 1\n", "positive, finite intensity, found 0"},
      {"1 1 1\n-1 1 1\n", ":2: expected a positive, finite intensity"},
      {"nan\n1\n", "positive, finite intensity"},
      {"1e39\n1\n", "positive, finite intensity"},
      {"a.jpg 1\n", "an intensity for 'b.jpg'"},
      {"a.jpg 1\nb.jpg 1\na.jpg 2\n",
       "one intensity for 'a.jpg', as in line 1, found another in line 3"},
      {"a.jpg 1\n1\n", "names in every line or in none"},
      {"1\n1.5\nb.jpg 1\n", "names in every line or in none"},
      {"a.jpg one\nb.jpg two\n", "one or three numbers"},
  };
  for (const auto& [text, sentence] : cases) {
    try {
      read(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input) << text;
      EXPECT_THAT(error.what(), HasSubstr(sentence)) << text;
    }
  }
}

TEST_F(LightIntensities, AFailureChangesNothing) {
  LightFile lights = parseLightFile("a.jpg 0 0 1 7\nb.jpg 1 0 0 8\n", "lights.lp");
  std::ofstream(file_) << "a.jpg 1\n";
  EXPECT_THROW(readLightIntensities(file_, lights), Error);
  EXPECT_EQ(lights.entries[0].light.intensity.r, 7);
}

}  // namespace
}  // namespace illum
