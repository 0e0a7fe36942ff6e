#include "capture/capture_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

CaptureFile someCapture() {
  LightSlab slab;
  slab.name = "front";
  slab.uCount = 2;
  slab.size = {8, 6};
  CaptureFile file;
  file.generator = "a test";
  file.rendered = true;
  file.lights = {{"lamp 0", {Direction::fromVector({0.3, -0.2, 0.9}), {1, 1, 1}}, 0},
                 {"lamp 1", {Direction::fromVector({0.1, 0.5, 0.7}), {2, 1, 0.5F}}, 0}};
  file.views = {{{"left", SlabView{slab, 0, 0}}, "l/{index}.exr", "l/mask.exr", "l/depth.exr"},
                {{"right", SlabView{slab, 1, 0}}, "r/{light}.exr", "r/mask.exr", "r/depth.exr"}};
  return file;
}

CaptureFileView named(const std::string& photographs) {
  return {{}, photographs, "", ""};
}

std::string refusalOf(const std::string& text) {
  try {
    captureFileFromText(text, "capture.json");
    return "taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(CaptureFile, GoesThroughTextToTheLastBit) {
  const CaptureFile file = someCapture();
  const CaptureFile back = captureFileFromText(textOf(file), "capture.json");
  EXPECT_EQ(back.generator, file.generator);
  EXPECT_EQ(back.rendered, file.rendered);
  ASSERT_EQ(back.lights.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.lights[i].name, file.lights[i].name);
    EXPECT_EQ(back.lights[i].light.toLight, file.lights[i].light.toLight);
    EXPECT_EQ(back.lights[i].light.intensity, file.lights[i].light.intensity);
  }
  ASSERT_EQ(back.views.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.views[i].view, file.views[i].view);
    EXPECT_EQ(back.views[i].photographs, file.views[i].photographs);
    EXPECT_EQ(back.views[i].mask, file.views[i].mask);
    EXPECT_EQ(back.views[i].depth, file.views[i].depth);
  }
}

TEST(CaptureFile, PicturesAreNamedByLightOrPlace) {
  const LightFileEntry light{"lamp.jpg", {}, 0};
  EXPECT_EQ(pictureOf(named("a/{index}.exr"), light, 7), "a/0007.exr");
  EXPECT_EQ(pictureOf(named("a/{light}"), light, 7), "a/lamp.jpg");
  EXPECT_EQ(pictureOf(named("{index}/{light}-{index}"), light, 12345), "12345/lamp.jpg-12345");
  EXPECT_EQ(pictureOf(named("a/{light}"), {"{light}", {}, 0}, 0), "a/{light}")
      << "names are not patterns";
  for (const char* name : {"../secret", "/etc/passwd", "a/../../b"}) {
    EXPECT_THROW(pictureOf(named("{light}"), {name, {}, 0}, 0), Error) << name;
  }
}

TEST(CaptureFile, WhatIsWrongIsNamed) {
  const std::string good = textOf(someCapture());
  EXPECT_THAT(refusalOf(""), HasSubstr("expected JSON"));
  EXPECT_THAT(refusalOf("[]"), HasSubstr("illum-capture"));
  EXPECT_THAT(refusalOf("{}"), HasSubstr("illum-capture"));
  EXPECT_THAT(refusalOf(replaced(good, "[1,0]", "[2,0]")), HasSubstr("expected 1.x"));
  EXPECT_THAT(refusalOf(replaced(good, "\"name\": \"left\"", "\"name\": \"right\"")),
              HasSubstr("'right' twice"));
  EXPECT_THAT(refusalOf(replaced(good, "l/{index}", "../{index}")),
              HasSubstr("views[0].photographs"));
  EXPECT_THAT(refusalOf(replaced(good, "r/mask.exr", "/dev/zero")), HasSubstr("views[1].mask"));
  EXPECT_THAT(refusalOf(replaced(good, "r/mask.exr", "")), HasSubstr("of all views or of none"));
  EXPECT_THAT(refusalOf(replaced(good, "\"kind\":\"slab\"", "\"kind\":\"cube\"")),
              HasSubstr("\"cube\""));
  EXPECT_THAT(refusalOf(replaced(good, "\"u\":1", "\"u\":2")), HasSubstr("view point"));
  EXPECT_THAT(refusalOf(replaced(good, "\"width\":8", "\"width\":0")), HasSubstr("width"));
  EXPECT_THAT(refusalOf(replaced(good, "\"distance\": 1.0", "\"distance\": -1")),
              HasSubstr("distance"));
  EXPECT_EQ(refusalOf(good), "taken");
}

TEST(CaptureFile, EveryTruncationIsRefused) {
  std::string text = textOf(someCapture());
  while (text.ends_with('\n')) text.pop_back();
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_THAT(refusalOf(text.substr(0, length)), HasSubstr("expected")) << length;
  }
}

}  // namespace
}  // namespace illum
