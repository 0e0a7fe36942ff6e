#include "illum/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "illum/colour.h"
#include "illum/error.h"
#include "study/fake_capture_for_test.h"
#include "study/object_for_test.h"

namespace illum {
namespace {

constexpr Size kSize{150, 70};

int pattern(int x, int y, int c) {
  return 40 + (3 * x + 5 * y + 50 * c) % 150;
}

float unit(int byte) {
  return static_cast<float>(byte) / 255;
}

class CountingProgress : public Progress {
 public:
  void begin(std::string_view, std::uint64_t total) override { total_ = total; }
  void advance(std::uint64_t steps) override { done_ += steps; }
  void end() override { ended_ = true; }
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_ = 0;
  bool ended_ = false;
};

Evaluation judged(const Object& object, const Capture& capture) {
  Progress progress;
  return evaluate(object, capture, progress);
}

TEST(Evaluate, APerfectObjectHas99DecibelsUnderEveryLight) {
  const TemporaryFolder folder("perfect");
  const auto lights = ringOfLights(7);
  const Object object = makeObject(folder.path() / "a.illum", {kSize, pattern, lights, {4}});
  const FakeCapture capture(kSize, Transfer::Display, lights,
                            [](int, int x, int y, int c) { return unit(pattern(x, y, c)); });
  CountingProgress progress;
  const Evaluation evaluation = evaluate(object, capture, progress);

  EXPECT_EQ(evaluation.used.lights, 6);
  EXPECT_EQ(evaluation.heldOut.lights, 1);
  EXPECT_EQ(evaluation.used.all.psnrDecibels, 99);
  EXPECT_EQ(evaluation.heldOut.all.psnrDecibels, 99);
  EXPECT_NEAR(evaluation.used.all.ssim, 1, 1e-6);
  EXPECT_EQ(evaluation.used.all.rms, 0);
  EXPECT_LT(evaluation.used.linearRms, 1e-6);
  EXPECT_FALSE(evaluation.hasMask);
  EXPECT_EQ(evaluation.bytes, std::filesystem::file_size(object.path()));
  EXPECT_NEAR(evaluation.bitsPerPixel, 8.0 * static_cast<double>(evaluation.bytes) / 10500, 1e-9);
  EXPECT_EQ(progress.total_, 14u) << "two rows of tiles under seven lights";
  EXPECT_EQ(progress.done_, 14u);
  EXPECT_TRUE(progress.ended_);
}

TEST(Evaluate, EachLightHasItsOwnErrorAndSummariesAreTheirMeans) {
  const TemporaryFolder folder("offsets");
  const auto lights = ringOfLights(6);
  const Object object = makeObject(folder.path() / "a.illum", {kSize, pattern, lights, {2, 5}});
  const FakeCapture capture(kSize, Transfer::Display, lights, [](int light, int x, int y, int c) {
    return unit(pattern(x, y, c) + light + 1);
  });
  const Evaluation evaluation = judged(object, capture);
  double used = 0, heldOut = 0;
  for (int light = 0; light < 6; ++light) {
    const LightResult& result = evaluation.lights[static_cast<std::size_t>(light)];
    const double expected = 20 * std::log10(255.0 / (light + 1));
    EXPECT_EQ(result.name, "light" + std::to_string(light) + ".png");
    EXPECT_EQ(result.heldOut, light % 3 == 2);
    EXPECT_NEAR(result.all.psnrDecibels, expected, 1e-9) << light;
    (result.heldOut ? heldOut : used) += expected / (result.heldOut ? 2 : 4);
  }
  EXPECT_NEAR(evaluation.used.all.psnrDecibels, used, 1e-9);
  EXPECT_NEAR(evaluation.heldOut.all.psnrDecibels, heldOut, 1e-9);
}

TEST(Evaluate, LinearFiguresCompareLinearLight) {
  const TemporaryFolder folder("linear");
  const auto lights = ringOfLights(1);
  const auto flat = [](int, int, int) { return 100; };
  const Object object = makeObject(folder.path() / "a.illum", {kSize, flat, lights, {}});
  const FakeCapture capture(kSize, Transfer::Linear, lights,
                            [](int, int, int, int) { return 2.5f; });
  const double error = 2.5 - double{linearFromDisplay(unit(100))};
  const Evaluation evaluation = judged(object, capture);
  EXPECT_NEAR(evaluation.used.linearRms, error, 1e-5);
  EXPECT_NEAR(evaluation.used.linearPsnrDecibels, -20 * std::log10(error), 1e-4);
  // On screen 2.5 is white.
  EXPECT_NEAR(evaluation.used.all.psnrDecibels, 20 * std::log10(255.0 / 155), 1e-9);
}

TEST(Evaluate, ALightsIntensityIsPartOfIt) {
  // The object shows 100 under light 1; photographed at an exposure of one half and divided by it.
  const TemporaryFolder folder("intensity");
  const auto lights = ringOfLights(3, {0.5f, 0.25f, 2.0f});
  const auto flat = [](int, int, int) { return 100; };
  const Object object = makeObject(folder.path() / "a.illum", {kSize, flat, lights, {}});
  const FakeCapture capture(kSize, Transfer::Display, lights,
                            [](int, int, int, int) { return unit(100); });
  EXPECT_EQ(judged(object, capture).used.all.psnrDecibels, 99);
}

TEST(Evaluate, OnlyLightsThatTheFitSawAreUsed) {
  const TemporaryFolder folder("heldout");
  const auto fitted = ringOfLights(4);
  const Object object = makeObject(folder.path() / "a.illum", {kSize, pattern, fitted, {1}});
  std::vector<LightFileEntry> lights = ringOfLights(4);
  lights[0].name = "renamed.jpg";                           // the direction was fitted
  lights[2].light.toLight = Direction::fromAngles(0.2, 2);  // another stack, the same name
  lights.push_back({"new.png", {Direction::fromAngles(0.1, 1), {1, 1, 1}}, 5});
  lights.push_back({"light1b.png", fitted[1].light, 6});  // the direction was left out
  const FakeCapture capture(kSize, Transfer::Display, lights,
                            [](int, int x, int y, int c) { return unit(pattern(x, y, c)); });
  const Evaluation evaluation = judged(object, capture);
  std::vector<bool> heldOut;
  for (const LightResult& light : evaluation.lights) heldOut.push_back(light.heldOut);
  EXPECT_THAT(heldOut, testing::ElementsAre(false, true, true, false, true, true));
  EXPECT_EQ(evaluation.used.lights, 2);
  EXPECT_EQ(evaluation.heldOut.lights, 4);
}

TEST(Evaluate, BandsAreReadOnceFromTheTopForAllLights) {
  // A sequential capture decodes all photographs side by side: going back costs all of them again.
  const TemporaryFolder folder("bands");
  const auto lights = ringOfLights(9);
  const Object object = makeObject(folder.path() / "a.illum", {kSize, pattern, lights, {}});
  const auto sample = [](int light, int x, int y, int c) {
    return unit(pattern(x, y, c) + (x * y + light) % 7);
  };
  const FakeCapture whole(kSize, Transfer::Display, lights, sample);
  FakeCapture bands(kSize, Transfer::Display, lights, sample);
  bands.withBandRows(16);
  Progress progress;
  const Evaluation expected = judged(object, whole);
  const Evaluation evaluation = evaluate(object, bands, progress, 1);
  EXPECT_EQ(bands.backwardReads(), 0);
  // 16 rows at most, and none across the tiles' border at row 64.
  EXPECT_EQ(bands.reads(), 9 * 5);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    EXPECT_EQ(evaluation.lights[i].all.psnrDecibels, expected.lights[i].all.psnrDecibels);
    EXPECT_EQ(evaluation.lights[i].all.ssim, expected.lights[i].all.ssim);
    EXPECT_NEAR(evaluation.lights[i].linearRms, expected.lights[i].linearRms, 1e-12);
  }

  const int before = bands.reads();
  htmlReport(object, bands, evaluation);
  EXPECT_EQ(bands.reads() - before, 6 * 5);
  EXPECT_EQ(bands.backwardReads(), 0);
}

/// Inside x < 75 the object is right, outside it is wrong by 20; the mask covers the inside alone.
struct HalfMasked {
  static int shown(int x, int y, int c) { return pattern(x, y, c) + (x < 75 ? 0 : 20); }
  static int covered(int x, int) { return x < 75 ? 255 : 0; }
  static float sample(int, int x, int y, int c) { return unit(pattern(x, y, c)); }
};

TEST(Evaluate, OutsideTheMaskEverythingIsBlack) {
  const TemporaryFolder folder("mask");
  const auto lights = ringOfLights(2);
  FlatObject flat{kSize, HalfMasked::shown, lights, {}};
  flat.coverageAt = HalfMasked::covered;
  const Object object = makeObject(folder.path() / "a.illum", flat);
  FakeCapture capture(kSize, Transfer::Display, lights, HalfMasked::sample);
  capture.withMask([](int x, int y) { return unit(HalfMasked::covered(x, y)); });
  const Evaluation evaluation = judged(object, capture);
  EXPECT_TRUE(evaluation.hasMask);
  EXPECT_EQ(evaluation.used.all.psnrDecibels, 99);
  EXPECT_EQ(evaluation.used.masked.psnrDecibels, 99);
}

TEST(Evaluate, TheObjectsMaskServesWhereTheCaptureHasNone) {
  const TemporaryFolder folder("objectmask");
  const auto lights = ringOfLights(2);
  FlatObject flat{kSize, HalfMasked::shown, lights, {}};
  flat.coverageAt = HalfMasked::covered;
  const Object object = makeObject(folder.path() / "a.illum", flat);
  const FakeCapture capture(kSize, Transfer::Display, lights, HalfMasked::sample);
  const Evaluation evaluation = judged(object, capture);
  EXPECT_TRUE(evaluation.hasMask);
  EXPECT_EQ(evaluation.used.all.psnrDecibels, 99);
}

TEST(Evaluate, AMaskThatTheObjectLostShowsAsError) {
  const TemporaryFolder folder("lostmask");
  const auto lights = ringOfLights(2);
  FlatObject flat{kSize, HalfMasked::shown, lights, {}};
  flat.coverageAt = [](int, int) { return 0; };
  const Object object = makeObject(folder.path() / "a.illum", flat);
  FakeCapture capture(kSize, Transfer::Display, lights, HalfMasked::sample);
  capture.withMask([](int, int) { return 1.0f; });
  EXPECT_LT(judged(object, capture).used.all.psnrDecibels, 10);
}

TEST(Evaluate, AMaskOfTheCaptureAloneOnlySeparatesFigures) {
  const TemporaryFolder folder("capturemask");
  const auto lights = ringOfLights(2);
  const Object object =
      makeObject(folder.path() / "a.illum", {kSize, HalfMasked::shown, lights, {}});
  FakeCapture capture(kSize, Transfer::Display, lights, HalfMasked::sample);
  capture.withMask([](int x, int y) { return unit(HalfMasked::covered(x, y)); });
  const Evaluation evaluation = judged(object, capture);
  EXPECT_TRUE(evaluation.hasMask);
  EXPECT_EQ(evaluation.used.masked.psnrDecibels, 99);
  EXPECT_NEAR(evaluation.used.all.psnrDecibels, 10 * std::log10(255 * 255 / 200.0), 1e-9);
}

TEST(Evaluate, AnotherSizeIsAnError) {
  const TemporaryFolder folder("size");
  const auto lights = ringOfLights(1);
  const Object object = makeObject(folder.path() / "a.illum", {kSize, pattern, lights, {}});
  const FakeCapture capture({151, 70}, Transfer::Display, lights,
                            [](int, int, int, int) { return 0.0f; });
  try {
    judged(object, capture);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), testing::HasSubstr("a.illum"));
    EXPECT_THAT(error.what(), testing::HasSubstr("150x70"));
    EXPECT_THAT(error.what(), testing::HasSubstr("151x70"));
  }
}

/// Three views, each wrong by one more under each further light, and by four more than the view
/// before.
struct ThreeViews {
  std::vector<LightFileEntry> lights = ringOfLights(3);
  FlatObject object{kSize, pattern, lights, {1}, {}, rowOfCameras(3, kSize), 7};
  FakeCapture capture{object.views, lights, sample};

  static float sample(int view, int light, int x, int y, int c) {
    return unit(pattern(x, y, c) + 7 * view + error(view, light));
  }
  static int error(int view, int light) { return 1 + light + 4 * view; }
  static double decibels(int view, int light) {
    return 20 * std::log10(255.0 / error(view, light));
  }
};

TEST(EvaluateViews, EveryViewIsJudgedUnderEveryLight) {
  const TemporaryFolder folder("views");
  const ThreeViews three;
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  const Evaluation evaluation = judged(object, three.capture);
  ASSERT_EQ(evaluation.pictures.size(), 9u);
  ASSERT_EQ(evaluation.views.size(), 3u);
  ASSERT_EQ(evaluation.lights.size(), 3u);
  double used = 0;
  for (int view = 0; view < 3; ++view) {
    for (int light = 0; light < 3; ++light) {
      const auto& picture = evaluation.pictures[static_cast<std::size_t>(3 * view + light)];
      EXPECT_EQ(picture.view, view);
      EXPECT_EQ(picture.light, light);
      EXPECT_NEAR(picture.all.psnrDecibels, ThreeViews::decibels(view, light), 1e-9);
      if (light != 1) used += ThreeViews::decibels(view, light) / 6;
    }
    const ViewResult& result = evaluation.views[static_cast<std::size_t>(view)];
    EXPECT_EQ(result.name, "front" + std::to_string(view));
    EXPECT_EQ(result.size, (Size{150 + 2 * view, 70}));
    EXPECT_EQ(result.used.lights, 2);
    EXPECT_NEAR(result.heldOut.all.psnrDecibels, ThreeViews::decibels(view, 1), 1e-9);
  }
  const double heldOut =
      (ThreeViews::decibels(0, 1) + ThreeViews::decibels(1, 1) + ThreeViews::decibels(2, 1)) / 3;
  EXPECT_NEAR(evaluation.used.all.psnrDecibels, used, 1e-9);
  EXPECT_NEAR(evaluation.heldOut.all.psnrDecibels, heldOut, 1e-9);
  EXPECT_NEAR(evaluation.lights[1].all.psnrDecibels, heldOut, 1e-9);
  EXPECT_EQ(evaluation.heldOut.lights, 1) << "lights, not pictures";
  EXPECT_NEAR(evaluation.bitsPerPixel,
              8.0 * static_cast<double>(evaluation.bytes) / ((150 + 152 + 154) * 70), 1e-9);
}

TEST(EvaluateViews, ViewsAreMatchedByTheirNames) {
  const TemporaryFolder folder("names");
  const ThreeViews three;
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  // The last two alone, in the other order.
  const FakeCapture capture({three.object.views[2], three.object.views[1]}, three.lights,
                            [](int view, int light, int x, int y, int c) {
                              return ThreeViews::sample(2 - view, light, x, y, c);
                            });
  const Evaluation evaluation = judged(object, capture);
  EXPECT_EQ(evaluation.views[0].name, "front2");
  EXPECT_NEAR(evaluation.pictures[0].all.psnrDecibels, ThreeViews::decibels(2, 0), 1e-9);
  EXPECT_NEAR(evaluation.pictures[5].all.psnrDecibels, ThreeViews::decibels(1, 2), 1e-9);
}

TEST(EvaluateViews, OneViewIsComparedWhateverItsName) {
  const TemporaryFolder folder("one");
  const auto lights = ringOfLights(2);
  FlatObject flat{kSize, pattern, lights, {}};
  flat.views = rowOfCameras(1, kSize);
  const Object object = makeObject(folder.path() / "a.illum", flat);
  const FakeCapture capture(kSize, Transfer::Display, lights,
                            [](int, int x, int y, int c) { return unit(pattern(x, y, c)); });
  EXPECT_EQ(judged(object, capture).used.all.psnrDecibels, 99);
}

TEST(EvaluateViews, AViewAfterTheOtherIsReadOnceFromTheTop) {
  const TemporaryFolder folder("order");
  ThreeViews three;
  three.capture.withBandRows(16);
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  CountingProgress progress;
  const Evaluation evaluation = evaluate(object, three.capture, progress, 1);
  EXPECT_EQ(three.capture.backwardReads(), 0);
  EXPECT_EQ(three.capture.reads(), 3 * 3 * 5);
  EXPECT_EQ(progress.total_, 45u);
  EXPECT_EQ(progress.done_, 45u);
  const Evaluation expected = judged(object, three.capture);
  EXPECT_EQ(evaluation.used.all.ssim, expected.used.all.ssim);
}

TEST(EvaluateViews, AMaskThatLeavesAViewEmptyIsNoPartOfMaskedMeans) {
  const TemporaryFolder folder("emptyview");
  ThreeViews three;
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  // Only the third view is as wide as this.
  three.capture.withMask([](int x, int) { return x < 152 ? 0.0f : 1.0f; });
  const Evaluation evaluation = judged(object, three.capture);
  EXPECT_TRUE(std::isnan(evaluation.views[0].used.masked.psnrDecibels));
  EXPECT_NEAR(evaluation.heldOut.masked.psnrDecibels, ThreeViews::decibels(2, 1), 1e-9);
  EXPECT_TRUE(std::isnan(evaluation.heldOut.masked.ssim)) << "no window is centred so far right";
  EXPECT_NEAR(evaluation.lights[1].masked.psnrDecibels, ThreeViews::decibels(2, 1), 1e-9);
}

void expectRefused(const Object& object, const Capture& capture,
                   const std::vector<std::string>& words) {
  try {
    judged(object, capture);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    for (const std::string& word : words) EXPECT_THAT(error.what(), testing::HasSubstr(word));
  }
}

TEST(EvaluateViews, AViewThatTheObjectLacksIsAnErrorBeforeAnythingIsRead) {
  const TemporaryFolder folder("lacks");
  const ThreeViews three;
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  std::vector<View> views = three.object.views;
  views[2].name = "back\n";
  const FakeCapture capture(views, three.lights, ThreeViews::sample);
  expectRefused(object, capture, {"a.illum", "\"back?\"", "3 views"});
  EXPECT_EQ(capture.reads(), 0);
}

TEST(EvaluateViews, PhotographsOfOneViewDoNotJudgeAnObjectOfMany) {
  const TemporaryFolder folder("stack");
  const ThreeViews three;
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  const FakeCapture capture(kSize, Transfer::Display, three.lights,
                            [](int, int, int, int) { return 0.0f; });
  expectRefused(object, capture, {"a.illum", "\"fake\""});
}

TEST(EvaluateViews, AnotherSizeOrPlaceIsAnError) {
  const TemporaryFolder folder("viewsize");
  const ThreeViews three;
  const Object object = makeObject(folder.path() / "a.illum", three.object);
  std::vector<View> views = three.object.views;
  std::get<PinholeCamera>(views[1].geometry).size.width = 99;
  expectRefused(object, FakeCapture(views, three.lights, ThreeViews::sample),
                {"a.illum", "\"front1\"", "152x70", "99x70"});
  views = three.object.views;
  std::get<PinholeCamera>(views[1].geometry).objectFromCamera.translation.y = 0.01;
  expectRefused(object, FakeCapture(views, three.lights, ThreeViews::sample),
                {"a.illum", "\"front1\"", "elsewhere"});
}

TEST(Evaluate, NoLightIsAnError) {
  const TemporaryFolder folder("none");
  const Object object =
      makeObject(folder.path() / "a.illum", {kSize, pattern, ringOfLights(1), {}});
  const FakeCapture capture(kSize, Transfer::Display, {}, [](int, int, int, int) { return 0.0f; });
  EXPECT_THROW(judged(object, capture), Error);
}

TEST(Evaluate, AFailingPhotographIsReportedAsItIs) {
  const TemporaryFolder folder("failing");
  const auto lights = ringOfLights(8);
  const Object object = makeObject(folder.path() / "a.illum", {kSize, pattern, lights, {}});
  const FakeCapture capture(kSize, Transfer::Display, lights, [](int light, int, int, int) {
    if (light == 5) throw Error(Fault::Input, "light5.png: cannot be read");
    return 0.5f;
  });
  try {
    judged(object, capture);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "light5.png: cannot be read");
  }
}

}  // namespace
}  // namespace illum
