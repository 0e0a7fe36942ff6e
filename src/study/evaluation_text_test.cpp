#include "study/evaluation_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "study/evaluation_for_test.h"

namespace illum {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The schema of docs/guide/evaluate.md: programs depend on every name in it.
TEST(EvaluationText, JsonHasTheDocumentedFields) {
  Evaluation evaluation = madeUpEvaluation({30, 31, 32, 33});
  evaluation.hasMask = true;
  const json parsed = json::parse(jsonOf(evaluation));
  EXPECT_EQ(parsed["version"], 1);
  EXPECT_EQ(parsed["bytes"], 123456);
  EXPECT_EQ(parsed["bitsPerPixel"], 4.5);
  EXPECT_EQ(parsed["mask"], true);
  EXPECT_EQ(parsed["used"]["lights"], 3);
  EXPECT_NEAR(parsed["used"]["psnr"], (30 + 31 + 33) / 3.0, 1e-12);
  EXPECT_EQ(parsed["heldOut"]["lights"], 1);
  EXPECT_EQ(parsed["heldOut"]["psnr"], 32);
  EXPECT_EQ(parsed["heldOut"]["ssim"], 0.9);
  EXPECT_EQ(parsed["heldOut"]["rms"], 0.05);
  EXPECT_EQ(parsed["heldOut"]["linear"]["psnr"], 33);
  EXPECT_EQ(parsed["heldOut"]["linear"]["rms"], 0.0224);
  EXPECT_EQ(parsed["heldOut"]["masked"]["psnr"], 31);
  ASSERT_EQ(parsed["lights"].size(), 4u);
  const json& light = parsed["lights"][2];
  EXPECT_EQ(light["name"], "image2.jpg");
  EXPECT_EQ(light["heldOut"], true);
  EXPECT_EQ(light["psnr"], 32);
  EXPECT_EQ(light["masked"]["ssim"], 0.8);
  EXPECT_EQ(light["direction"].size(), 3u);
  EXPECT_EQ(light["direction"][2], evaluation.lights[2].direction.z());
}

TEST(EvaluationText, JsonWritesNullForWhatDoesNotExist) {
  Evaluation evaluation = madeUpEvaluation({30, 31});
  evaluation.lights[0].all.ssim = kNan;
  evaluation.used.all.psnrDecibels = std::numeric_limits<double>::infinity();
  const std::string text = jsonOf(evaluation);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
  const json parsed = json::parse(text);
  EXPECT_TRUE(parsed["lights"][0]["ssim"].is_null());
  EXPECT_TRUE(parsed["used"]["psnr"].is_null());
  EXPECT_TRUE(parsed["lights"][0]["masked"].is_null());
  EXPECT_EQ(parsed["heldOut"]["lights"], 0);
  EXPECT_TRUE(parsed["heldOut"]["psnr"].is_null());
  EXPECT_TRUE(parsed["heldOut"].contains("linear"));
}

Evaluation ofTwoViews() {
  Evaluation evaluation = madeUpEvaluation({30, 31, 32});
  evaluation.views.push_back(evaluation.views[0]);
  evaluation.views[1].name = "side";
  evaluation.views[1].heldOut.all.psnrDecibels = 12;
  for (int light = 0; light < 3; ++light) {
    PictureResult picture = evaluation.pictures[static_cast<std::size_t>(light)];
    picture.view = 1;
    picture.all.psnrDecibels -= 10.5;
    evaluation.pictures.push_back(picture);
  }
  return evaluation;
}

TEST(EvaluationText, JsonNamesViewsOnlyWhereThereAreSeveral) {
  EXPECT_FALSE(json::parse(jsonOf(madeUpEvaluation({30, 31}))).contains("views"));
  const json views = json::parse(jsonOf(ofTwoViews()))["views"];
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0]["name"], "front");
  EXPECT_EQ(views[1]["name"], "side");
  EXPECT_EQ(views[1]["size"], json({40, 30}));
  EXPECT_EQ(views[1]["used"]["lights"], 2);
  EXPECT_EQ(views[1]["heldOut"]["psnr"], 12);
  ASSERT_EQ(views[1]["lights"].size(), 3u);
  EXPECT_EQ(views[1]["lights"][2]["name"], "image2.jpg");
  EXPECT_EQ(views[1]["lights"][2]["psnr"], 21.5);
  EXPECT_EQ(views[1]["lights"][2]["linear"]["psnr"], 33);
}

TEST(EvaluationText, TheTableNamesViewAndLightOfTheWorstPictures) {
  Evaluation evaluation = ofTwoViews();
  evaluation.views[1].name =
      "si\x1b"
      "de";
  const std::string table = tableOf(evaluation);
  EXPECT_THAT(table, HasSubstr("mean of 2 views"));
  EXPECT_THAT(table, testing::ContainsRegex("image0.jpg +used +19.50 .* in si\\?de\n"));
  EXPECT_LT(table.find("in si?de"), table.find("in front"));
  EXPECT_THAT(tableOf(madeUpEvaluation({30, 31})), Not(HasSubstr("view")));
}

TEST(EvaluationText, JsonSurvivesNamesThatAreNotUtf8) {
  Evaluation evaluation = madeUpEvaluation({30});
  evaluation.lights[0].name = "a\xff\"\\\n.jpg";
  EXPECT_EQ(json::parse(jsonOf(evaluation))["lights"][0]["name"], "a\uFFFD\"\\\n.jpg");
}

TEST(EvaluationText, TheTableNamesTheWorstLightsFirst) {
  const std::string table = tableOf(madeUpEvaluation({30, 20, 40, 25, 35, 36, 37, 38}));
  EXPECT_LT(table.find("image1.jpg"), table.find("image3.jpg"));
  EXPECT_LT(table.find("image3.jpg"), table.find("image0.jpg"));
  EXPECT_THAT(table, Not(HasSubstr("image2.jpg")));
  EXPECT_THAT(table, HasSubstr("123456 bytes"));
  EXPECT_THAT(table, Not(HasSubstr("inside the mask")));
}

TEST(EvaluationText, TheTableShowsMaskedFiguresOnlyWithAMask) {
  Evaluation evaluation = madeUpEvaluation({30, 31, 32});
  evaluation.hasMask = true;
  EXPECT_THAT(tableOf(evaluation), HasSubstr("inside the mask"));
}

TEST(EvaluationText, TheTableCannotCommandATerminal) {
  Evaluation evaluation = madeUpEvaluation({30});
  evaluation.lights[0].name = "\x1b[2J\r\n" + std::string(100, 'x');
  const std::string table = tableOf(evaluation);
  EXPECT_THAT(table, Not(HasSubstr("\x1b")));
  EXPECT_THAT(table, Not(HasSubstr("\r")));
  EXPECT_THAT(table, HasSubstr("?[2J??xxx"));
  EXPECT_THAT(table, HasSubstr("xxx..."));
}

TEST(EvaluationText, LongNamesAreCutBetweenCharacters) {
  EXPECT_EQ(printableName("abcdefgh", 8), "abcdefgh");
  EXPECT_EQ(printableName("abcdefghi", 8), "abcde...");
  EXPECT_EQ(printableName("aäöüßäöüß", 8), "aäö...");
}

TEST(EvaluationText, EqualLightsKeepTheirOrder) {
  EXPECT_EQ(worstFirst(madeUpEvaluation({5, 3, 5, 3})), (std::vector<std::size_t>{1, 3, 0, 2}));
  EXPECT_TRUE(worstFirst(Evaluation()).empty());
}

TEST(EvaluationText, NothingIsWrittenAsADash) {
  EXPECT_EQ(figureText(31.416, 2), "31.42");
  EXPECT_EQ(figureText(kNan, 2), "–");
}

}  // namespace
}  // namespace illum
