#include "lumigraph/camera_path.h"

#include <gmock/gmock.h>

#include <cmath>

#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

std::string pathText(const std::string& head, const std::vector<Vector3>& eyes) {
  std::string cameras;
  for (const Vector3 eye : eyes) {
    cameras += cameras.empty() ? "" : ",";
    cameras += R"({"kind": "look", "target": [0, 0, 0], "eye": [)" + std::to_string(eye.x) + "," +
               std::to_string(eye.y) + "," + std::to_string(eye.z) + "]}";
  }
  return R"({"path": 1, )" + head + R"("cameras": [)" + cameras + "]}";
}

std::vector<LookAt> looks(const std::vector<CameraPose>& poses) {
  std::vector<LookAt> all;
  for (const CameraPose& pose : poses) all.push_back(std::get<LookAt>(pose));
  return all;
}

std::vector<LookAt> framesOfText(const std::string& json) {
  return looks(framesOf(cameraPathFromText(json, "path.json")));
}

std::string complaintAbout(const std::string& json) {
  try {
    framesOf(cameraPathFromText(json, "path.json"));
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "none";
}

TEST(CameraPath, WithoutFramesTheCamerasThemselves) {
  const auto frames = framesOfText(pathText("", {{0, 0, 3}, {1, 0, 3}}));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].eye, (Vector3{1, 0, 3}));
}

TEST(CameraPath, GoesThroughItsCamerasAndEvenlyAlongALine) {
  const auto frames = framesOfText(pathText(R"("frames": 9, )", {{0, 0, 3}, {1, 0, 3}, {2, 0, 3}}));
  ASSERT_EQ(frames.size(), 9U);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_NEAR(frames[k].eye.x, 0.25 * static_cast<double>(k), 1e-12) << k;
    EXPECT_NEAR(frames[k].eye.z, 3, 1e-12);
  }
}

TEST(CameraPath, ItsSpeedHasNoJumps) {
  const auto frames =
      framesOfText(pathText(R"("frames": 301, )", {{0, 0, 3}, {1, 2, 3}, {2, -1, 4}, {5, 0, 3}}));
  double largest = 0, total = 0;
  for (std::size_t k = 2; k < frames.size(); ++k) {
    const Vector3 one = frames[k - 1].eye - frames[k - 2].eye,
                  two = frames[k].eye - frames[k - 1].eye;
    largest = std::max(largest, length(two - one));
    total += length(two);
  }
  EXPECT_LT(largest, 0.1 * total / 300) << "a straight way would turn on the spot";
}

TEST(CameraPath, AClosedPathBeginsAgainWhereItEnds) {
  const std::vector<Vector3> square{{1, 0, 3}, {0, 1, 3}, {-1, 0, 3}, {0, -1, 3}};
  const auto frames = framesOfText(pathText(R"("frames": 40, "closed": true, )", square));
  ASSERT_EQ(frames.size(), 40U);
  for (std::size_t k = 0; k < 40; ++k) {
    EXPECT_NEAR(std::hypot(frames[k].eye.x, frames[k].eye.y), 1, 0.15);
    const Vector3 opposite = frames[(k + 20) % 40].eye;
    EXPECT_NEAR(frames[k].eye.x, -opposite.x, 1e-12);
  }
  EXPECT_NEAR(length(frames[39].eye - frames[0].eye), length(frames[1].eye - frames[0].eye), 1e-12);
}

TEST(CameraPath, OneCameraStandsStill) {
  const auto frames = framesOfText(pathText(R"("frames": 3, )", {{0, 0, 3}}));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[2].eye, (Vector3{0, 0, 3}));
}

TEST(CameraPath, WhatIsNoPathIsRefusedByName) {
  EXPECT_THAT(complaintAbout("[]"), HasSubstr("path.json"));
  EXPECT_THAT(complaintAbout("{}"), HasSubstr("'path'"));
  EXPECT_THAT(complaintAbout(R"({"path": 2, "cameras": []})"), HasSubstr("'path'"));
  EXPECT_THAT(complaintAbout(pathText("", {})), HasSubstr("'cameras'"));
  EXPECT_THAT(complaintAbout(pathText(R"("frames": 100001, )", {{0, 0, 3}})),
              HasSubstr("'frames'"));
  EXPECT_THAT(complaintAbout(pathText(R"("frames": -1, )", {{0, 0, 3}})), HasSubstr("'frames'"));
  EXPECT_THAT(complaintAbout(pathText(R"("closed": true, )", {{0, 0, 3}})), HasSubstr("'closed'"));
  EXPECT_THAT(complaintAbout(pathText("", {{0, 0, 3}, {0, 0, 0}})), HasSubstr("'cameras[1]'"));
  EXPECT_THAT(complaintAbout(pathText(R"("frames": 3, )", {{0, 0, 3}, {0, 0, -3}})),
              HasSubstr("frame 1"));
  EXPECT_THAT(complaintAbout(R"({"path": 1, "frames": 3, "cameras": [{"kind": "panorama",
      "panorama": {"projection": "equirectangular", "size": {"width": 8, "height": 4},
      "extent": {"left": -1, "right": 1, "bottom": -0.5, "top": 0.5},
      "objectFromCamera": {"rotation": [1,0,0, 0,1,0, 0,0,1], "translation": [0, 0, 0]}}}]})"),
              HasSubstr("'cameras[0].kind'"));
}

constexpr LookAt kStart{{0, 3, 4}, {0, 1, 0}, {0, 1, 0}, 30};

TEST(Orbit, AWholeTurnFromTheStart) {
  const auto frames = looks(orbit(kStart, {8, 360, {}}));
  ASSERT_EQ(frames.size(), 8U);
  EXPECT_NEAR(length(frames[0].eye - kStart.eye), 0, 1e-12);
  EXPECT_NEAR(length(frames[2].eye - Vector3{4, 3, 0}), 0, 1e-12) << "counterclockwise from above";
  EXPECT_NEAR(length(frames[4].eye - Vector3{0, 3, -4}), 0, 1e-12);
  for (const LookAt& look : frames) EXPECT_EQ(look.target, kStart.target);
}

TEST(Orbit, AnArcGoesToBothSides) {
  const auto frames = looks(orbit(kStart, {3, 180, {}}));
  EXPECT_NEAR(length(frames[0].eye - Vector3{-4, 3, 0}), 0, 1e-12);
  EXPECT_NEAR(length(frames[1].eye - kStart.eye), 0, 1e-12);
  EXPECT_NEAR(length(frames[2].eye - Vector3{4, 3, 0}), 0, 1e-12);
}

TEST(Orbit, AtAnotherElevationAsFarAway) {
  const auto frames = looks(orbit(kStart, {1, 360, 30.0}));
  const Vector3 arm = frames[0].eye - kStart.target;
  EXPECT_NEAR(length(arm), length(kStart.eye - kStart.target), 1e-12);
  EXPECT_NEAR(arm.y, 0.5 * length(arm), 1e-12);
  EXPECT_NEAR(arm.x, 0, 1e-12);
  EXPECT_GT(arm.z, 0);
}

TEST(Orbit, TurningRoundStaysAtTheEye) {
  const LookAt start{{1, 2, 3}, {1, 2, 2}, {0, 1, 0}, 60};
  const auto frames = looks(turnRound(start, {4, 360, {}}));
  EXPECT_EQ(frames[1].eye, start.eye);
  EXPECT_NEAR(length(frames[1].target - Vector3{0, 2, 3}), 0, 1e-12) << "to the left";
}

TEST(Orbit, WhatGoesNowhereIsRefused) {
  EXPECT_THROW(orbit(kStart, {0, 360, {}}), Error);
  EXPECT_THROW(orbit(kStart, {kMaxFrames + 1, 360, {}}), Error);
  EXPECT_THROW(orbit(kStart, {4, 0, {}}), Error);
  EXPECT_THROW(orbit(kStart, {4, 361, {}}), Error);
  EXPECT_THROW(orbit(kStart, {4, NAN, {}}), Error);
  EXPECT_THROW(orbit(kStart, {4, 360, 90.0}), Error);
  EXPECT_THROW(orbit({{0, 3, 0}, {}, {0, 1, 0}, 30}, {4, 360, {}}), Error);
}

TEST(LookOf, SeesWhatTheMiddleViewSees) {
  LightSlab slab;
  slab.name = "front";
  slab.distance = 4;
  slab.uv = {-1, -1, 1, 1};
  slab.st = {-1, -0.5, 1, 0.5};
  slab.uCount = slab.vCount = 3;
  slab.size = {80, 40};
  std::vector<View> views;
  for (int i = 0; i < 9; ++i) views.push_back({std::to_string(i), SlabView{slab, i % 3, i / 3}});
  const ViewChoice middle = middleView(views);
  const ViewGeometry camera = geometryOf(lookOf(middle, views, {0, 1, 0}), slab.size);
  for (const Vector3 point : {Vector3{0.3, 0.2, 0}, {-0.9, -0.4, 0.5}, {0, 0.1, -2}}) {
    EXPECT_NEAR(pixelOf(camera, point)->x, pixelOf(middle.geometry, point)->x, 1e-9);
    EXPECT_NEAR(pixelOf(camera, point)->y, pixelOf(middle.geometry, point)->y, 1e-9);
  }
}

}  // namespace
}  // namespace illum
