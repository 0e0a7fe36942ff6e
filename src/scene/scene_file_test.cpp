#include "scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "illum/error.h"
#include "illum/picture_io.h"
#include "scene/capture_cost.h"
#include "scene/hair_file.h"
#include "scene/test_files.h"

namespace illum {
namespace {

using testing::HasSubstr;

std::string errorOf(const std::filesystem::path& file, const SceneFileOptions& options = {}) {
  RememberedRemarks remarks;
  try {
    readScene(file, options, remarks);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "no error";
}

std::string sceneWith(const std::string& fields) {
  return R"({"illumScene": 1, )" + fields + "}";
}

TEST(SceneFile, AMeshFileAloneIsFramedBySelf) {
  const ScratchFolder folder;
  RememberedRemarks remarks;
  const auto file = folder.write("t.gltf", triangleGltf("", "", R"(, "translation": [100, 0, 0])"));
  EXPECT_TRUE(isSceneFile(file));
  const SceneCapture capture = readScene(file, {}, remarks);
  EXPECT_EQ(capture.setup.views.size(), 25u);
  EXPECT_EQ(capture.setup.lights.size(), 64u);
  EXPECT_GT(capture.setup.lightRadiusRadians, 0.05);
  const Bounds bounds = boundsOf(capture.scene);
  EXPECT_NEAR(bounds.low.x, -1, 1e-6);
  EXPECT_NEAR(bounds.high.y, 1, 1e-6);
}

TEST(SceneFile, ShapesMaterialsHairAndLightFile) {
  const ScratchFolder folder;
  BytePicture picture({1, 1}, 3);
  picture.samples()[0] = 255;
  folder.write("t.png", encodePng(picture));
  folder.write("hair.txt", "# two hairs\n0 0 0\n0 1 0\n\n1 0 0\n1 0.5 0\n1 1 0 # tip\n");
  folder.write("l.lp", "2\na.jpg 0 0 1\nb.jpg 1 0 1 7\n");
  const auto file = folder.write("s.json", sceneWith(R"(
    "materials": {"red": {"baseColourTexture": "t.png"}, "fur": {"kind": "hair"}},
    "meshes": [{"shape": "box", "material": "red", "scale": [1, 2, 3], "translate": [0, 5, 0]},
               {"shape": "sphere"}, {"shape": "teapot"}, {"shape": "rectangle"}],
    "hair": [{"file": "hair.txt", "material": "fur", "radius": [0.02, 0.01], "scale": 2}],
    "views": [{"panorama": {"eye": [0, 0, 9], "size": [30, 15]}}, {"camera": {"size": [16, 16]}}],
    "lights": {"file": "l.lp"})"));
  RememberedRemarks remarks;
  const SceneCapture capture = readScene(file, {}, remarks);
  const Scene& scene = capture.scene;
  ASSERT_EQ(scene.meshes.size(), 4u);
  EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.meshes[0].material)).name, "red");
  EXPECT_EQ(scene.textures.at(0).texels.at(0, 0, 0), 1);
  EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.meshes[1].material)).name, "plain");
  EXPECT_NEAR(length(boundsOf(scene).high - Vector3{2.04, 7, 3}), 0, 1e-6);
  ASSERT_EQ(scene.curves.at(0).firstPoints.size(), 2u);
  EXPECT_EQ(scene.curves[0].points.size(), 4u + 5u);
  EXPECT_FLOAT_EQ(scene.curves[0].points[1][3], 0.04F) << "radii grow with the hair";
  ASSERT_EQ(capture.setup.lights.size(), 2u);
  EXPECT_EQ(capture.setup.lights[1].name, "b.jpg");
  EXPECT_EQ(capture.setup.lights[1].light.intensity.r, 1) << "scenes are lit by lights of 1";
  EXPECT_EQ(capture.setup.views.size(), 2u);
}

TEST(SceneFile, MaterialsOfAMeshFileAreReplacedByName) {
  const ScratchFolder folder;
  folder.write("t.gltf", triangleGltf(R"("materials": [{"name": "clay"}])", R"(, "material": 0)"));
  const std::string materials = R"("materials": {"gold": {"metallic": 1}}, )";
  RememberedRemarks remarks;
  const SceneCapture capture =
      readScene(folder.write("s.json", sceneWith(materials + R"("meshes": [{"file": "t.gltf",
                                                     "materials": {"clay": "gold"}}])")),
                {}, remarks);
  const auto used = static_cast<std::size_t>(capture.scene.meshes.at(0).material);
  EXPECT_EQ(capture.scene.materials.at(used).metallic, 1);
  EXPECT_THAT(errorOf(folder.write("w.json", sceneWith(materials + R"("meshes": [
                {"file": "t.gltf", "materials": {"clai": "gold"}}])"))),
              HasSubstr("expected a material 'clai' to replace, found 'clay'"));
}

TEST(SceneFile, MissingFilesAreNamed) {
  const ScratchFolder folder;
  EXPECT_THAT(errorOf(folder.path("no.json")), HasSubstr("no.json"));
  EXPECT_THAT(errorOf(folder.write("a.json", sceneWith(R"("meshes": [{"file": "no.obj"}])"))),
              HasSubstr("no.obj"));
  EXPECT_THAT(errorOf(folder.write("b.json", sceneWith(R"("meshes": [{"shape": "box"}],
                           "materials": {"a": {"normalTexture": "no.png"}})"))),
              HasSubstr("no.png"));
  EXPECT_THAT(errorOf(folder.write("c.json", sceneWith(R"("hair": [{"file": "no.txt"}])"))),
              HasSubstr("no.txt"));
  EXPECT_THAT(errorOf(folder.write("d.json", sceneWith(R"("meshes": [{"shape": "box"}],
                                           "lights": {"file": "no.lp"})"))),
              HasSubstr("no.lp"));
}

TEST(SceneFile, AbsurdGridsAreRefusedWithTheirCost) {
  const ScratchFolder folder;
  const auto file = folder.write("s.json", sceneWith(R"("meshes": [{"shape": "box"}],
    "views": [{"slab": {"viewPoints": [200, 200], "size": [8192, 8192]}}],
    "lights": {"polar": [30, 60]}, "samples": 64)"));
  const std::string sentence = errorOf(file);
  EXPECT_THAT(sentence, HasSubstr("40000 views of 6.71089e+07 pixels x 1800 lights x 64 samples x "
                                  "2 path vertices = 6.18e+17 shadow rays"));
  EXPECT_THAT(sentence, HasSubstr("years on two cores"));
  EXPECT_THAT(sentence, HasSubstr("PiB of photographs"));
  SceneFileOptions small;
  small.overrides.uCount = 1, small.overrides.vCount = 1, small.overrides.longerSide = 8;
  EXPECT_EQ(errorOf(file, small), "no error") << "the command line has the last word";
  EXPECT_THAT(errorOf(folder.write("l.json", sceneWith(R"("meshes": [{"shape": "box"}],
                                            "lights": {"polar": [1000, 1000]})"))),
              HasSubstr("expected at most 100000 lights"));
}

TEST(SceneFile, ASlabInsideTheSceneIsRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(errorOf(folder.write("s.json", sceneWith(R"("meshes": [{"shape": "box"}],
                                            "views": [{"slab": {"distance": 0.5}}])"))),
              HasSubstr("s.json: slab 'slab': expected view points in front of the whole scene"));
}

TEST(SceneFile, OtherJsonIsNoScene) {
  const ScratchFolder folder;
  EXPECT_FALSE(isSceneFile(folder.write("capture.json", R"({"illumCapture": 1})")));
  EXPECT_TRUE(isSceneFile(folder.write("scene.json", sceneWith(""))));
  EXPECT_FALSE(isSceneFile(folder.path("none.json")));
}

TEST(HairFile, BadLinesAreNamed) {
  for (const auto& [text, expected] : {std::pair{"", "at least one hair"},
                                       {"0 0 0\n", "at least two points"},
                                       {"0 0 0\n0 1\n", "h:2: expected three numbers"},
                                       {"0 0 0\n0 1 nan\n", "three numbers"},
                                       {"0 0 0\n0 1 0 5\n", "three numbers"},
                                       {"0 0 0\n0 1e30 0\n", "three numbers"}}) {
    try {
      hairsFromText(text, "h");
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(expected)) << text;
    }
  }
}

TEST(HairFile, CurvesBeginAndEndInTheirPoints) {
  CurveSet set;
  addHair(set, std::vector<Vector3>{{1, 2, 3}, {1, 3, 4}, {0, 5, 5}}, {0.3, 0.1});
  ASSERT_EQ(set.points.size(), 5u);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto at = [&](std::size_t i) { return set.points[i][c]; };
    EXPECT_NEAR((at(0) + 4 * at(1) + at(2)) / 6, at(1), 1e-6);
    EXPECT_NEAR((at(2) + 4 * at(3) + at(4)) / 6, at(3), 1e-6);
  }
  EXPECT_FLOAT_EQ(set.points[2][3], 0.2F);
}

TEST(CaptureCost, OfTheDefaultPlan) {
  const CaptureCost cost = costOf(CapturePlan{});
  EXPECT_EQ(cost.shadowRays(), 25.0 * 65536 * 64 * 4 * 2);
  EXPECT_EQ(cost.photographBytes(), 25.0 * 65536 * 64 * 12);
  EXPECT_THAT(textOf(cost), HasSubstr("2.8 minutes"));
}

}  // namespace
}  // namespace illum
