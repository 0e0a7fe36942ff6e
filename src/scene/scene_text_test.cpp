#include "scene/scene_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/files.h"
#include "illum/error.h"
#include "scene/nearest_name.h"

namespace illum {
namespace {

using testing::HasSubstr;

SceneDescription parsed(const std::string& fields) {
  return sceneFromText(R"({"illumScene": 1, )" + fields + "}", "s.json");
}

std::string errorOf(const std::string& text) {
  try {
    sceneFromText(text, "s.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "no error";
}

std::string errorOfFields(const std::string& fields) {
  return errorOf(R"({"illumScene": 1, "meshes": [{"shape": "box"}])" +
                 (fields.empty() ? "" : ", " + fields) + "}");
}

TEST(SceneText, TheShortestSceneIsASlabUnder64Lights) {
  const SceneDescription scene = parsed(R"("meshes": [{"shape": "box"}])");
  const CapturePlan plan = planOf(scene);
  ASSERT_EQ(plan.views.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<SlabPlan>(plan.views[0]));
  EXPECT_EQ(std::get<FibonacciGrid>(plan.lights.lights).count, 64);
  EXPECT_EQ(plan.lights.region, LightRegion::Hemisphere);
  EXPECT_FALSE(plan.lights.radiusRadians.has_value());
}

TEST(SceneText, ReadsWhatItSays) {
  const SceneDescription scene = parsed(R"(
    "meshes": [{"file": "a.glb", "material": "gold", "scale": 2, "rotateDegrees": [0, 90, 0]}],
    "materials": {"gold": {"metallic": 1, "roughness": 0.25, "baseColour": [1, 0.7, 0.3]}},
    "hair": [{"curves": [[[0, 0, 0], [0, 1, 0]]], "radius": [0.01, 0]}],
    "lights": {"polar": [30, 60], "region": "sphere", "radiusDegrees": 1.5},
    "samples": 16, "bounces": 3, "seed": 7, "filterRadius": 1)");
  EXPECT_EQ(scene.meshes[0].file, "a.glb");
  EXPECT_EQ(scene.meshes[0].placement.scale, (Vector3{2, 2, 2}));
  EXPECT_EQ(scene.materials.at("gold").material.baseColour, (LinearRgb{1, 0.7F, 0.3F}));
  EXPECT_EQ(scene.hair[0].curves[0][1], (Vector3{0, 1, 0}));
  const CapturePlan plan = planOf(scene);
  EXPECT_EQ(std::get<PolarGrid>(plan.lights.lights).phiCount, 60);
  EXPECT_NEAR(*plan.lights.radiusRadians, 1.5 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(plan.samplesPerPixel, 16);
  EXPECT_EQ(plan.bounces, 3);
  EXPECT_EQ(plan.seed, 7u);
}

TEST(SceneText, EveryKindOfView) {
  const CapturePlan plan = planOf(parsed(R"("meshes": [{"shape": "teapot"}], "views": [
    {"slab": {"viewPoints": [9, 3], "toward": [0, 1, 1], "window": [-1, -2, 1, 2]}},
    {"turn": {"slabs": 6, "elevationDegrees": 20}},
    {"photograph": {"size": [100, 50]}},
    {"camera": {"eye": [0, 1, 5], "target": [0, 0, 0], "fieldOfViewDegrees": 90}},
    {"camera": {"frame": {"translation": [0, 0, 4]}, "focal": [300, 300], "size": [200, 100]}},
    {"panorama": {"projection": "cylindrical", "heights": [-0.5, 0.5], "azimuthDegrees": [0, 360]}}
  ])"));
  ASSERT_EQ(plan.views.size(), 6u);
  EXPECT_EQ(std::get<SlabPlan>(plan.views[0]).uCount, 9);
  EXPECT_EQ(std::get<SlabPlan>(plan.views[0]).st->top, 2);
  EXPECT_TRUE(std::get<TurnPlan>(plan.views[1]).joined);
  EXPECT_EQ(std::get<PhotographPlan>(plan.views[2]).size, (Size{100, 50}));
  EXPECT_NEAR(std::get<CameraPlan>(plan.views[3]).fieldOfViewRadians, std::numbers::pi / 2, 1e-12);
  const auto camera = std::get<PinholeCamera>(std::get<FixedPlan>(plan.views[4]).view.geometry);
  EXPECT_EQ(camera.centre, (PixelPosition{100, 50}));
  const auto panorama = std::get<Panorama>(std::get<FixedPlan>(plan.views[5]).view.geometry);
  EXPECT_EQ(panorama.extent.top, 0.5);
  EXPECT_LE(panorama.extent.right, panorama.extent.left + 2 * std::numbers::pi);
  EXPECT_EQ(plan.lights.region, LightRegion::Sphere) << "a turn sees the back too";
}

TEST(SceneText, PanoramaLooksWhereItIsTold) {
  const CapturePlan plan = planOf(parsed(R"("meshes": [{"shape": "box"}], "views": [
    {"panorama": {"eye": [1, 2, 3], "toward": [1, 0, 0], "size": [200, 100]}}])"));
  const View view = std::get<FixedPlan>(plan.views[0]).view;
  const Ray ray = rayThrough(view.geometry, {100, 50});
  EXPECT_EQ(ray.origin, (Vector3{1, 2, 3}));
  EXPECT_NEAR(ray.direction.x, 1, 1e-12);
}

TEST(SceneText, UnknownFieldsAreRefusedWithTheNearestName) {
  EXPECT_EQ(errorOfFields(R"("sample": 4)"),
            "s.json: expected a known field such as 'samples', found \"sample\"");
  EXPECT_THAT(errorOfFields(R"("views": [{"slab": {"viewpoints": [3, 3]}}])"),
              HasSubstr("'views[0].slab': expected a known field such as 'viewPoints'"));
  EXPECT_THAT(errorOfFields(R"("materials": {"a": {"basecolor": 1}})"), HasSubstr("'baseColour'"));
  EXPECT_THAT(errorOfFields(R"("zzzzzzzzzzzz": 1)"), HasSubstr("expected a known field, found"));
  EXPECT_THAT(errorOfFields(R"("\n\u0000": 1)"), HasSubstr(R"(found "\n\u0000")"));
  EXPECT_THAT(errorOfFields(R"("materials": {"a\nb": {}})"), HasSubstr("printable"));
}

TEST(SceneText, WhatIsWrongIsNamed) {
  EXPECT_THAT(errorOf("{}"), HasSubstr("'illumScene': expected 1, found none"));
  EXPECT_THAT(errorOf(R"({"illumScene": 2})"), HasSubstr("expected 1, found 2"));
  EXPECT_THAT(errorOf(R"({"illumScene": 1})"), HasSubstr("found neither"));
  EXPECT_THAT(errorOf("[]"), HasSubstr("expected a record, found a list"));
  EXPECT_THAT(errorOf(""), HasSubstr("expected JSON"));
  EXPECT_THAT(errorOf(R"({"illumScene": 1, "meshes": [{}]})"),
              HasSubstr("'meshes[0]': expected either 'file' or 'shape', found neither"));
  EXPECT_THAT(errorOfFields(R"("seed": 1, "seed": 2)"), HasSubstr("found twice"));
  EXPECT_THAT(errorOfFields(R"("samples": 0)"), HasSubstr("'samples': expected a number from 1"));
  EXPECT_THAT(errorOfFields(R"("samples": 2.5)"), HasSubstr("whole number"));
  EXPECT_THAT(errorOfFields(R"("samples": "4")"), HasSubstr("whole number"));
  EXPECT_THAT(errorOfFields(R"("samples": 1e999)"), HasSubstr("expected JSON"));
  EXPECT_THAT(errorOfFields(R"("lights": {"radiusDegrees": NaN})"), HasSubstr("expected JSON"));
  EXPECT_THAT(errorOfFields(R"("lights": {"polar": [20, 20], "fibonacci": 9})"),
              HasSubstr("found several"));
  EXPECT_THAT(errorOfFields(R"("lights": {"polar": [20]})"), HasSubstr("2 elements, found 1"));
  EXPECT_THAT(errorOfFields(R"("lights": {"directions": [[0, 0, 1], [0, 0, 0]]})"),
              HasSubstr("'lights.directions[1]': expected a direction, found the zero vector"));
  EXPECT_THAT(errorOfFields(R"("lights": {"directions": []})"), HasSubstr("found 0"));
  EXPECT_THAT(errorOfFields(R"("views": [{}])"), HasSubstr("'views[0]': expected one of 'slab'"));
  EXPECT_THAT(errorOfFields(R"("views": [{"slab": {"toward": [0, 1, 0]}}])"),
              HasSubstr("'views[0]': expected a direction of view"));
  EXPECT_THAT(errorOfFields(R"("views": [{"slab": {"window": [1, 0, 0, 1]}}])"),
              HasSubstr("growing order"));
  EXPECT_THAT(
      errorOfFields(R"("views": [{"slab": {"frame": {"rotation": [1,0,0,0,1,0,0,0,-1]}}}])"),
      HasSubstr("right-handed"));
  EXPECT_THAT(errorOfFields(R"("views": [{"camera": {"eye": [0,0,1], "focal": [1,1]}}])"),
              HasSubstr("some of both"));
  EXPECT_THAT(errorOfFields(R"("views": [{"panorama": {"heights": [0, 1]}}])"),
              HasSubstr("'elevationDegrees' without a cylinder"));
}

TEST(SceneText, MaterialsThatAreNotThereAreNamed) {
  EXPECT_THAT(errorOf(R"({"illumScene": 1, "materials": {"marble": {}},
                          "meshes": [{"shape": "box", "material": "marbel"}]})"),
              HasSubstr("'meshes[0].material': expected one of 'materials', such as 'marble', "
                        "found 'marbel'"));
}

TEST(SceneText, HostileTextIsRefusedEarly) {
  EXPECT_THAT(errorOf(std::string(1000000, '[')), HasSubstr("levels of nesting"));
  std::string records;
  for (int i = 0; i < 100000; ++i) records += R"({"views":)";
  EXPECT_THAT(errorOf(records), HasSubstr("levels of nesting"));
  EXPECT_THAT(errorOf(std::string(kMaxSceneTextBytes + 1, ' ')), HasSubstr("bytes of scene text"));
  EXPECT_THAT(errorOf("\xff\xfe{"), HasSubstr("expected JSON"));
}

TEST(SceneText, EveryTruncationIsRefused) {
  const std::string text = R"({"illumScene": 1, "meshes": [{"shape": "box"}], "samples": 4})";
  for (std::size_t bytes = 0; bytes < text.size(); ++bytes)
    EXPECT_NE(errorOf(text.substr(0, bytes)), "no error") << bytes;
}

TEST(SceneText, TheSchemaInTheManualIsTheReadersOwn) {
  const std::filesystem::path file =
      std::filesystem::path(ILLUM_SOURCE_DIR) / "docs/scene.schema.json";
  if (std::getenv("ILLUM_WRITE_SCHEMA") != nullptr) std::ofstream(file) << sceneSchema();
  EXPECT_EQ(readTextFile(file, 1 << 20), sceneSchema())
      << "run this test with ILLUM_WRITE_SCHEMA=1 in the environment to write it anew";
}

TEST(NearestName, CountsEdits) {
  const std::array<std::string_view, 3> known{"samples", "seed", "bounces"};
  EXPECT_EQ(nearestName("Samples", known), "samples");
  EXPECT_EQ(nearestName("sede", known), "seed");
  EXPECT_EQ(nearestName("bounce", known), "bounces");
  EXPECT_EQ(nearestName("radius", known), "");
  EXPECT_EQ(nearestName(std::string(100000, 's'), known), "");
}

}  // namespace
}  // namespace illum
