#include "study/html_text.h"

#include <gtest/gtest.h>

namespace illum {
namespace {

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
