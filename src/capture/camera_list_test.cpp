#include "capture/camera_list.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "capture/proxy_mesh.h"
#include "capture/test_photographs.h"
#include "illum/capture_folder.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

Size askedNothing(const std::string& name) {
  ADD_FAILURE() << name;
  return {1, 1};
}
CaptureFile transforms(const std::string& json) {
  return captureFromTransforms(json, "transforms.json", askedNothing);
}
std::string refusalOf(const std::string& json) {
  try {
    captureFromTransforms(json, "transforms.json", [](const std::string&) { return Size{8, 6}; });
    return "taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
}

// At (1, 2, 3), looking along -x, z up: its x is world y, its y world z, its z world x.
constexpr const char* kPose = "[[0,0,1,1],[1,0,0,2],[0,1,0,3],[0,0,0,1]]";
std::string frame(const std::string& file, const std::string& more = {}) {
  return fmt::format(R"({{"file_path": "{}", "transform_matrix": {}{}}})", file, kPose, more);
}
std::string file(const std::string& frames, const std::string& more = {}) {
  return fmt::format(
      R"({{"fl_x": 100, "fl_y": 110, "cx": 41, "cy": 29, "w": 80, "h": 60{}, "frames": [{}]}})",
      more, frames);
}

TEST(Transforms, CamerasAreTheirsAndOurs) {
  const CaptureFile capture = transforms(file(frame("./images/a.jpg") + "," + frame("b.png")));
  ASSERT_EQ(capture.views.size(), 2U);
  EXPECT_EQ(capture.views[0].files, std::vector<std::string>{"images/a.jpg"});
  ASSERT_EQ(capture.lights.size(), 1U);
  const ViewGeometry view = capture.views[0].view.geometry;
  EXPECT_EQ(sizeOf(view), (Size{80, 60}));
  // Two ahead, one to the camera's right, half up.
  const auto seen = pixelOf(view, {-1, 3, 3.5});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 41 + 100 * 0.5, 1e-9);
  EXPECT_NEAR(seen->y, 29 - 110 * 0.25, 1e-9);
  EXPECT_NEAR(depthOf(view, {-1, 3, 3.5}), 2, 1e-9);
}

TEST(Transforms, FramesHaveIntrinsicsOfTheirOwn) {
  const CaptureFile capture =
      transforms(file(frame("a.jpg") + "," + frame("b.jpg", R"(, "fl_x": 50, "w": 40, "cx": 20)")));
  EXPECT_EQ(std::get<PinholeCamera>(capture.views[0].view.geometry).focalX, 100);
  const auto& second = std::get<PinholeCamera>(capture.views[1].view.geometry);
  EXPECT_EQ(second.focalX, 50);
  EXPECT_EQ(second.focalY, 110);
  EXPECT_EQ(second.size, (Size{40, 60}));
  EXPECT_EQ(second.centre, (PixelPosition{20, 29}));
}

TEST(Transforms, AnAngleMayStandForTheRest) {
  const std::string json =
      fmt::format(R"({{"camera_angle_x": 1.2, "frames": [{}]}})", frame("r_0"));
  std::string asked;
  const CaptureFile capture = captureFromTransforms(json, "t", [&](const std::string& name) {
    asked = name;
    return Size{200, 100};
  });
  EXPECT_EQ(asked, "r_0.png");
  const auto& camera = std::get<PinholeCamera>(capture.views[0].view.geometry);
  EXPECT_NEAR(camera.focalX, 100 / std::tan(0.6), 1e-9);
  EXPECT_EQ(camera.focalX, camera.focalY);
  EXPECT_EQ(camera.centre, (PixelPosition{100, 50}));
}

TEST(Transforms, LightsAreThoseOfFramesAtOnePlace) {
  const CaptureFile capture = transforms(file(frame("a.png", R"(, "pl_pos": [0, 0, 2])") + "," +
                                              frame("b.png", R"(, "pl_pos": [4, 0, 0])")));
  ASSERT_EQ(capture.views.size(), 1U);
  ASSERT_EQ(capture.lights.size(), 2U);
  EXPECT_EQ(capture.lights[0].light.toLight, Direction());
  EXPECT_NEAR(capture.lights[1].light.toLight.x(), 1, 1e-12);
  // 10 is the mean of 2^2 and 4^2.
  EXPECT_NEAR(capture.lights[0].light.intensity.r, 10.0 / 4, 1e-6);
  EXPECT_NEAR(capture.lights[1].light.intensity.r, 10.0 / 16, 1e-6);
  EXPECT_EQ(capture.views[0].files, (std::vector<std::string>{"a.png", "b.png"}));
  EXPECT_EQ(pictureOf(capture.views[0], capture.lights[1], 1), "b.png");
}

TEST(Transforms, WhatIsWrongIsNamed) {
  EXPECT_THAT(refusalOf("{"), HasSubstr("transforms.json: expected JSON"));
  EXPECT_THAT(refusalOf("[]"), HasSubstr("'frames': expected a list"));
  EXPECT_THAT(refusalOf(file("")), HasSubstr("1 to 65536 elements"));
  EXPECT_THAT(refusalOf(file("7")), HasSubstr("'frames[0]': expected an object"));
  EXPECT_THAT(
      refusalOf(file(frame("a.png"), R"(, "k1": 0.01)")),
      HasSubstr("'frames[0].k1': expected photographs without lens distortion, found 0.01"));
  EXPECT_THAT(refusalOf(file(frame("a.png"), R"(, "camera_model": "OPENCV_FISHEYE")")),
              HasSubstr("OPENCV_FISHEYE"));
  EXPECT_THAT(refusalOf(file(frame("../a.png"))), HasSubstr("the name of a file in the folder"));
  EXPECT_THAT(refusalOf(file(frame("/a.png"))), HasSubstr("the name of a file in the folder"));
  EXPECT_THAT(refusalOf(file(frame("a.png") + "," + frame("a.png"))), HasSubstr("each name once"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "w": 1e30)"))), HasSubstr("w': expected"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "w": 0)"))), HasSubstr("w': expected"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "fl_x": -3)"))), HasSubstr("focal lengths"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "fl_x": "3")"))),
              HasSubstr("fl_x': expected a number"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "pl_pos": [0,0,0])"))), HasSubstr("pl_pos"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "pl_pos": [1,0,0])") + "," + frame("b.png"))),
              HasSubstr("positions of lights in all frames"));
  EXPECT_THAT(refusalOf(file(frame("a.png", R"(, "pl_pos": [1,0,0])") + "," +
                             frame("b.png", R"(, "pl_pos": [0,1,0], "fl_x": 90)"))),
              HasSubstr("every camera under each of 2 lights"));
  EXPECT_THAT(refusalOf(R"({"w":8,"h":6,"fl_x":9,"frames":[{"file_path":"a.png"}]})"),
              HasSubstr("transform_matrix"));
  for (const char* matrix : {"[[2,0,0,0],[0,2,0,0],[0,0,2,0]]", "[[1,0,0,0],[0,1,0,0],[0,0,-1,0]]",
                             "[[0,0,0,0],[0,0,0,0],[0,0,0,0]]", "[[1,0,0,0],[0,1,0,0]]", "[1,2,3]",
                             "[[1,0,0],[0,1,0],[0,0,1]]", "[[1,0,0,1e99],[0,1,0,0],[0,0,1,0]]"}) {
    EXPECT_THAT(refusalOf(fmt::format(R"({{"w":8,"h":6,"fl_x":9,"frames":[)"
                                      R"({{"file_path":"a.png","transform_matrix":{}}}]}})",
                                      matrix)),
                HasSubstr("transform_matrix"));
  }
}

TEST(Transforms, EveryTruncationIsRefused) {
  const std::string json = file(frame("a.png"));
  for (std::size_t length = 0; length < json.size(); ++length) {
    EXPECT_NE(refusalOf(json.substr(0, length)), "taken") << length;
  }
}

ColmapText colmap() {
  ColmapText text;
  text.cameras = "# cameras\n1 PINHOLE 80 60 100 110 41 29\n2 SIMPLE_PINHOLE 40 30 50 20 15\n";
  // Turned by a quarter about z: R p = (-y, x, z).
  text.images =
      "# images\n1 0.70710678118654752 0 0 0.70710678118654752 0.5 0 2 1 my photo.jpg\n"
      "1 2 3 4 5 6\n2 1 0 0 0 0 0 0 2 b.jpg\r\n\r\n3 2 0 0 0 1 0 0 2 c.jpg";
  text.camerasName = "cameras.txt";
  text.imagesName = "images.txt";
  text.picturesFolder = "images";
  return text;
}
std::string refusalOf(const ColmapText& text) {
  try {
    captureFromColmap(text);
    return "taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
}

TEST(Colmap, CamerasSeeWhatTheyShould) {
  const CaptureFile capture = captureFromColmap(colmap());
  ASSERT_EQ(capture.views.size(), 3U);
  EXPECT_EQ(capture.views[0].view.name, "my photo.jpg");
  EXPECT_EQ(capture.views[0].files[0], "images/my photo.jpg");
  // x, y, depth of COLMAP's own camera frame, y down.
  const Vector3 p{0.3, -0.7, 1.5};
  const Vector3 theirs{0.7 + 0.5, 0.3, 1.5 + 2};
  const ViewGeometry view = capture.views[0].view.geometry;
  const auto seen = pixelOf(view, p);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 41 + 100 * theirs.x / theirs.z, 1e-6);
  EXPECT_NEAR(seen->y, 29 + 110 * theirs.y / theirs.z, 1e-6);
  EXPECT_NEAR(depthOf(view, p), theirs.z, 1e-9);
}

TEST(Colmap, WhatIsWrongIsNamed) {
  ColmapText text = colmap();
  text.cameras = "1 SIMPLE_RADIAL 80 60 100 41 29 -0.01\n";
  EXPECT_THAT(refusalOf(text), HasSubstr("cameras.txt:1: expected a camera without distortion, "
                                         "PINHOLE or SIMPLE_PINHOLE, found 'SIMPLE_RADIAL'"));
  for (const char* cameras :
       {"", "1", "1 PINHOLE 80", "1 PINHOLE 80 60 x 1 1 1", "1 PINHOLE 80 60 nan 1 1 1",
        "1 PINHOLE 1e9 60 1 1 1 1", "1 PINHOLE 8.5 60 1 1 1 1", "1 PINHOLE 80 60 0 1 1 1",
        "1 PINHOLE 80 60 1 1 1 1\n1 PINHOLE 80 60 1 1 1 1"}) {
    text.cameras = cameras;
    EXPECT_NE(refusalOf(text), "taken") << cameras;
  }
  text = colmap();
  for (const char* images :
       {"", "# nothing", "1 0 0 0 0 0 0 0 1 a.jpg\n", "1 1 0 0 0 0 0 0 1\n",
        "1 1 0 0 0 0 0 0 9 a.jpg", "1 1 0 0 0 0 0 inf 1 a.jpg",
        "1 1 0 0 0 0 0 0 1 a.jpg\n\n2 1 0 0 0 0 0 0 1 a.jpg", "1 1 0 0 0 0 0 0 1 ../a.jpg"}) {
    text.images = images;
    EXPECT_NE(refusalOf(text), "taken") << images;
  }
  text.images = std::string("1 1 0 0 0 0 0 0 1 a\0b.jpg", 25);
  EXPECT_NE(refusalOf(text), "taken");
}

TEST(Proxy, IsReadAndSeen) {
  const ProxyMesh mesh = proxyFromObj(
      "# a square\r\nv -1 -1 -2\r\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nvn 0 0 1\nf 1//1 2//1 3//1 -1\n",
      "p.obj");
  ASSERT_EQ(mesh.triangles.size(), 2U);
  PinholeCamera camera;
  camera.size = {8, 8};
  camera.focalX = camera.focalY = 8;
  camera.centre = {4, 4};
  const Picture depth = depthOfProxy(mesh, camera);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_FLOAT_EQ(depth.at(x, y, 0), 2) << x << "," << y;
  }
  camera.objectFromCamera.translation = {1, 0, 0};
  EXPECT_TRUE(std::isinf(depthOfProxy(mesh, camera).at(7, 4, 0)));
}

TEST(Proxy, WhatIsWrongIsNamed) {
  for (const char* text :
       {"", "v 0 0 0\n", "v 0 0\nf 1 1 1", "v 0 0 0\nf 1 1", "v 0 0 0\nf 1 1 2", "v 0 0 0\nf 1 1 0",
        "v 0 0 0\nf 1 1 -2", "v 0 0 nan\nf 1 1 1", "v 0 0 0\nf 1 1 99999999999999999999"}) {
    EXPECT_THROW(proxyFromObj(text, "p.obj"), Error) << text;
  }
}

// The whole way: a folder as COLMAP and nerfstudio leave it.
TEST(CameraLists, MakeCaptures) {
  Progress silent;
  for (const bool colmapStyle : {true, false}) {
    const test::Folder folder;
    std::filesystem::create_directories(folder / "images");
    test::write(folder / "images/a.png", test::sketch(1));
    test::write(folder / "images/b.png", test::sketch(2));
    if (colmapStyle) {
      std::filesystem::create_directories(folder / "sparse/0");
      folder.writeText("sparse/0/cameras.txt", "1 SIMPLE_PINHOLE 23 17 20 11.5 8.5\n");
      folder.writeText("sparse/0/images.txt",
                       "1 1 0 0 0 0 0 0 1 a.png\n\n2 1 0 0 0 -0.1 0 0 1 b.png\n\n");
    } else {
      folder.writeText("transforms.json", R"({"camera_angle_x": 1, "frames": [)" +
                                              frame("images/a") + "," + frame("images/b.png") +
                                              "]}");
    }
    folder.writeText("proxy.obj", "v -9 -9 2\nv 9 -9 2\nv 0 9 2\nf 1 2 3\n");
    ASSERT_TRUE(isCaptureFolder(folder.path()));
    const auto capture = openCaptureFolder(folder.path(), {}, silent);
    ASSERT_EQ(capture->groups(), 2);
    ASSERT_EQ(capture->lights().size(), 1U);
    EXPECT_TRUE(capture->hasDepth());
    std::vector<float> samples(3 * 23 * 17);
    const int light = 0;
    capture->read(1, {0, 0, 23, 17}, {&light, 1}, samples);
    EXPECT_NEAR(samples[5], test::pattern(2, 5, 0, 0), 0.01);
    EXPECT_FALSE(capture->fingerprint().empty());
    if (!colmapStyle) continue;
    std::vector<float> depth(23 * 17);
    capture->readDepth(0, {0, 0, 23, 17}, depth);
    EXPECT_FLOAT_EQ(depth[8 * 23 + 11], 2);
  }
}

TEST(CameraLists, AreNotEveryFolder) {
  const test::Folder folder;
  EXPECT_FALSE(isCaptureFolder(folder.path()));
  EXPECT_FALSE(isCaptureFolder(folder / "missing"));
  Progress silent;
  EXPECT_THROW(openCaptureFolder(folder.path(), {}, silent), Error);
}

}  // namespace
}  // namespace illum
