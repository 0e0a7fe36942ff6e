#include "json/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace illum::fields {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonText, PutsShortRecordsOnOneLine) {
  EXPECT_EQ(jsonText(Json{{"b", 1}, {"a", {1, 2.5}}}), "{\"b\":1,\"a\":[1,2.5]}\n");
}

TEST(JsonText, IndentsLongRecordsThatNest) {
  const std::string word(90, 'w');
  const Json root{{"text", word}, {"list", {1, 2}}};
  EXPECT_EQ(jsonText(root), "{\n  \"text\": \"" + word + "\",\n  \"list\": [1,2]\n}\n");
}

TEST(JsonText, WritesBytesThatAreNotUtf8AsReplacement) {
  EXPECT_EQ(jsonText(Json{{"name", "\xff"}}), "{\"name\":\"\xef\xbf\xbd\"}\n");
}

}  // namespace
}  // namespace illum::fields
