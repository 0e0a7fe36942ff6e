#include "light/light_line.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace illum {
namespace {

struct LineCase {
  const char* line;
  const char* name;
  std::vector<double> numbers;
};

TEST(NamedNumbers, ReadsHoweverFieldsAreSetApart) {
  const LineCase cases[] = {
      {"a.jpg 0.1 -0.2 0.9", "a.jpg", {0.1, -0.2, 0.9}},
      {"a.jpg\t0.1\t+.2\t9e-1", "a.jpg", {0.1, 0.2, 0.9}},
      {"a.jpg,0.1,-0.2,1.", "a.jpg", {0.1, -0.2, 1}},
      {"a.jpg ; 0 ; 0 ; 1", "a.jpg", {0, 0, 1}},
      {"a.jpg, 0, 0, 1, 2.5", "a.jpg", {0, 0, 1, 2.5}},
      {"a.jpg 0 0 1 2 3 4", "a.jpg", {0, 0, 1, 2, 3, 4}},
      {"0 0 1 a.jpg", "a.jpg", {0, 0, 1}},
      {"0,0,1,2,a.jpg", "a.jpg", {0, 0, 1, 2}},
      {"0,0,1,12 a b.jpg", "12 a b.jpg", {0, 0, 1}},
      {"a b  c.jpg 0 0 1", "a b  c.jpg", {0, 0, 1}},
      {"a b.jpg,0,0,1", "a b.jpg", {0, 0, 1}},
      {"Smith, John.jpg 0 0 1", "Smith, John.jpg", {0, 0, 1}},
      {"\"a, b.jpg\",0,0,1", "a, b.jpg", {0, 0, 1}},
      {"'a b.jpg' 0 0 1", "a b.jpg", {0, 0, 1}},
      {"\"a \"\"b\"\".jpg\";0;0;1", "a \"b\".jpg", {0, 0, 1}},
      {"'90s.jpg 0 0 1", "'90s.jpg", {0, 0, 1}},
      {"2020 01 05.jpg 0 0 1", "2020 01 05.jpg", {0, 0, 1}},
      {"0001 0 0 1", "0001", {0, 0, 1}},
      {"\"1\" 0 0 1", "1", {0, 0, 1}},
      {"17,a.jpg,0,0,1", "a.jpg", {0, 0, 1}},
      {"a.jpg;0,5;-0,25;0,75", "a.jpg", {0.5, -0.25, 0.75}},
      {"a.jpg 0,5 0 1,5e-1", "a.jpg", {0.5, 0, 0.15}},
      {"C:\\My photos\\a b.jpg 0 0 1", "C:\\My photos\\a b.jpg", {0, 0, 1}},
      {"IMG #1.jpg 0 0 1", "IMG #1.jpg", {0, 0, 1}},
      {"IMG #1.jpg 0 0 1 # the 1 2 3", "IMG #1.jpg", {0, 0, 1}},
      {"a.jpg 0 0 1 // was 0 1 0", "a.jpg", {0, 0, 1}},
      {"a.jpg,0,0,1, # top", "a.jpg", {0, 0, 1}},
      {"\xC3\xA9t\xC3\xA9.jpg 0 0 1", "\xC3\xA9t\xC3\xA9.jpg", {0, 0, 1}},
  };
  for (const LineCase& expected : cases) {
    const auto read = readNamedNumbers(expected.line, {3, 4, 6});
    ASSERT_TRUE(read) << expected.line;
    EXPECT_EQ(read->name, expected.name) << expected.line;
    EXPECT_EQ(read->numbers, expected.numbers) << expected.line;
  }
}

TEST(NamedNumbers, RefusesWhatIsIncompleteOrAmbiguous) {
  for (const char* line :
       {"a.jpg", "a.jpg 0", "a.jpg 0 0", "0 0 1", "a.jpg 0 0 1 2 3", "a.jpg,,0,0,1", ",0,0,1",
        "a.jpg 0 0 x", "a.jpg 0 0 1 2 3 4 5", "1 2 3 4 5 6 7 8", "0 0 1 a.jpg 5", "a.jpg 0 0 0x1",
        "# a.jpg 0 0 1 b"}) {
    const auto read = readNamedNumbers(line, {3, 4, 6});
    EXPECT_FALSE(read) << line << " was read as " << read->name;
  }
}

TEST(NamedNumbers, ReadsWhatIsNotFiniteSoThatItCanBeNamed) {
  for (const char* number : {"nan", "-NaN", "inf", "-Infinity", "1.#QNAN", "-1.#IND", "1e999"}) {
    const auto read = readNamedNumbers(std::string("a.jpg 0 0 ") + number, {3});
    ASSERT_TRUE(read) << number;
    EXPECT_FALSE(std::isfinite(read->numbers[2])) << number;
  }
}

TEST(NamedNumbers, MayLackANameWhereThatIsAllowed) {
  const auto three = readNamedNumbers("1 2 3", {1, 3}, true);
  ASSERT_TRUE(three);
  EXPECT_EQ(three->name, "");
  EXPECT_EQ(three->numbers, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(readNamedNumbers("0001 2", {1, 3}, true)->name, "0001");
  EXPECT_FALSE(readNamedNumbers("1 2 3", {3}, false));
}

// Each of these is quadratic for a careless reader; a million of them must not take minutes.
TEST(NamedNumbers, HostileLinesAreReadInLinearTime) {
  std::string quotes = "a", comments = "a", commas = "a", doubled = "\"";
  while (quotes.size() < 4000) quotes += " \"x";
  while (comments.size() < 4000) comments += " #";
  while (commas.size() < 4000) commas += " 1,5";
  while (doubled.size() < 4000) doubled += "\"\" ";
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i)
    for (const std::string& line : {quotes, comments, commas, doubled})
      readNamedNumbers(line, {3, 4, 6});
  // 3 MB; linear work takes a fraction of a second, quadratic work minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(LightLines, SkipsWhatSaysNothingAndCountsAll) {
  const std::filesystem::path source = "lights.lp";
  LightLines lines("\xEF\xBB\xBF  first ,;\r\n\r\n# no\n // no\n\t\nsecond\rthird", source);
  const std::pair<const char*, int> expected[] = {{"first", 1}, {"second", 6}, {"third", 7}};
  for (const auto& [text, number] : expected) {
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.text(), text);
    EXPECT_EQ(lines.number(), number);
  }
  EXPECT_FALSE(lines.next());
  EXPECT_FALSE(lines.next());
}

TEST(LightLines, RefusesWhatIsNoText) {
  const std::filesystem::path source = "lights.lp";
  EXPECT_THROW(LightLines(std::string_view("a\0b", 3), source), Error);
  EXPECT_THROW(LightLines("\xFF\xFE\x61", source), Error);
  const std::string text(4097, 'x');
  EXPECT_THROW(LightLines(text, source).next(), Error);
  EXPECT_TRUE(LightLines(std::string_view(text).substr(1), source).next());
}

TEST(Names, LoseTheirFolders) {
  EXPECT_EQ(withoutFolders("C:\\My photos\\a b.jpg"), "a b.jpg");
  EXPECT_EQ(withoutFolders("../x/a.jpg"), "a.jpg");
  EXPECT_EQ(withoutFolders("a.jpg"), "a.jpg");
  EXPECT_EQ(withoutFolders("\\\\server\\share\\a.jpg"), "a.jpg");
  EXPECT_EQ(withoutFolders("photos/"), "");
}

TEST(Shown, IsShortAndPrintable) {
  EXPECT_EQ(shown("a\x1B[31m\tb\x7F"), "a?[31m?b?");
  EXPECT_EQ(shown(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(shown(std::string(61, 'x')), std::string(60, 'x') + "…");
  EXPECT_EQ(shown(std::string(59, 'x') + "\xC3\xA9z"), std::string(59, 'x') + "…");
}

}  // namespace
}  // namespace illum
