#include "study/html_text.h"

#include <gtest/gtest.h>

#include <vector>

namespace illum {
namespace {

std::string base64(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return dataUri("a/b", bytes).substr(std::string_view("data:a/b;base64,").size());
}

// The test vectors of RFC 4648, section 10.
TEST(HtmlText, Base64FollowsTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff\xbf"), "+/+/");
}

TEST(HtmlText, MarkupBecomesText) {
  EXPECT_EQ(htmlText("a.jpg"), "a.jpg");
  EXPECT_EQ(htmlText("<script>\"&'"), "&lt;script&gt;&quot;&amp;&#39;");
  EXPECT_EQ(htmlText("Schüssel ø"), "Schüssel ø");
}

TEST(HtmlText, ControlCharactersAreReplaced) {
  EXPECT_EQ(htmlText(std::string_view("a\0b", 3)), "a\uFFFDb");
  EXPECT_EQ(htmlText("\x1b[31m\n\x7f"), "\uFFFD[31m\uFFFD\uFFFD");
}

}  // namespace
}  // namespace illum
