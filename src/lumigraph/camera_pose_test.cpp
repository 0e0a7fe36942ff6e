#include "lumigraph/camera_pose.h"

#include <gmock/gmock.h>

#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

std::string complaintAbout(const std::string& json) {
  try {
    cameraFromText(json, "c.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "none";
}

TEST(CameraPose, LooksAtItsTargetWithItsFieldOfView) {
  const auto pose = cameraFromText(
      R"({"kind": "look", "eye": [1, 2, 5], "target": [1, 2, 1], "fieldOfViewDegrees": 90})", "");
  const ViewGeometry camera = geometryOf(pose, {60, 40});
  EXPECT_EQ(sizeOf(camera), (Size{60, 40}));
  const auto middle = pixelOf(camera, {1, 2, 1});
  EXPECT_NEAR(middle->x, 30, 1e-9);
  EXPECT_NEAR(middle->y, 20, 1e-9);
  // At 45 degrees from the axis upward: the upper edge.
  EXPECT_NEAR(pixelOf(camera, {1, 6, 1})->y, 0, 1e-9);
}

TEST(CameraPose, FullCamerasAndPanoramas) {
  const auto camera = cameraFromText(R"({"kind": "camera", "camera": {
      "size": {"width": 8, "height": 6}, "focalX": 7, "focalY": 5, "centre": {"x": 3, "y": 2},
      "objectFromCamera": {"rotation": [1,0,0, 0,1,0, 0,0,1], "translation": [0, 1, 2]}}})",
                                     "");
  EXPECT_EQ(sizeOf(geometryOf(camera, {100, 100})), (Size{8, 6}));
  EXPECT_EQ(std::get<PinholeCamera>(camera).focalY, 5);
  const auto panorama = cameraFromText(R"({"kind": "panorama", "panorama": {
      "projection": "equirectangular", "size": {"width": 8, "height": 4},
      "extent": {"left": -1, "right": 1, "bottom": -0.5, "top": 0.5},
      "objectFromCamera": {"rotation": [1,0,0, 0,1,0, 0,0,1], "translation": [0, 0, 0]}}})",
                                       "");
  EXPECT_EQ(std::get<Panorama>(panorama).extent.top, 0.5);
}

TEST(CameraPose, WhatIsNoCameraIsRefusedByName) {
  EXPECT_THAT(complaintAbout("{"), HasSubstr("c.json: expected JSON"));
  EXPECT_THAT(complaintAbout("[]"), HasSubstr("a record"));
  EXPECT_THAT(complaintAbout(R"({"eye": [0,0,1]})"), HasSubstr("'kind'"));
  EXPECT_THAT(complaintAbout(R"({"kind": "photograph"})"), HasSubstr("'look'"));
  EXPECT_THAT(complaintAbout(R"({"kind": "look", "eye": [0,0], "target": [0,0,0]})"),
              HasSubstr("'eye'"));
  EXPECT_THAT(complaintAbout(R"({"kind": "look", "eye": [0,0,1], "target": [0,0,0], "fov": 4})"),
              HasSubstr("'fov'"));
  EXPECT_THAT(complaintAbout(R"({"kind": "look", "eye": [0,0,1], "target": [0,0,1]})"),
              HasSubstr("away from its target"));
  EXPECT_THAT(complaintAbout(R"({"kind": "look", "eye": [0,1,0], "target": [0,0,0]})"),
              HasSubstr("up"));
  EXPECT_THAT(complaintAbout(R"({"kind": "look", "eye": [0,0,1], "target": [0,0,0],
                                 "fieldOfViewDegrees": 180})"),
              HasSubstr("'fieldOfViewDegrees'"));
  EXPECT_THAT(complaintAbout(R"({"kind": "camera", "camera": {
      "size": {"width": 8, "height": 6}, "focalX": 7, "focalY": 5, "centre": {"x": 3, "y": 2},
      "objectFromCamera": {"rotation": [1,0,0, 0,1,0, 0,0,0.5], "translation": [0, 1, 2]}}})"),
              HasSubstr("a rotation"));
}

}  // namespace
}  // namespace illum
