#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "illum/error.h"
#include "illum/lighting.h"

namespace illum {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Lighting everyKind() {
  SkyLight sky;
  sky.model = SkyModel::Preetham;
  sky.turbidity = 4.5;
  EnvironmentLight environment;
  environment.picture = "maps/street.exr";
  environment.rotationDegrees = 30;
  environment.up = Direction::fromVector({0.1, 0.2, 0.9});
  return {{DirectionalLight{Direction::fromVector({1, 2, 3}), {0.1f, 0.7f, 3e-9f}},
           PointLight{{0.1, -0.2, 0.3}, {1e20f, 0, 5}, Falloff::Inverse},
           SpotLight{{0, 0, 1}, {0.3, 0, 0}, 17.5, 3.25, {1, 0.5f, 0.25f}, Falloff::None},
           RectangleLight{{0, 0, 1}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0}, 3, 5},
           SphereLight{{0, 0, 1}, 0.05, {1, 1, 1}, 12}, environment, sky}};
}

std::string sentence(std::string_view text) {
  try {
    lightingFromText(text, "setup.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "no error";
}

std::string oneLight(const std::string& fields) {
  return R"({"lighting": 1, "lights": [{)" + fields + "}]}";
}

TEST(LightingText, ReadsWhatItWrites) {
  const Lighting lighting = everyKind();
  const std::string text = textOf(lighting);
  const Lighting again = lightingFromText(text, "setup.json");
  EXPECT_EQ(again, lighting) << text;
  EXPECT_EQ(textOf(again), text);
}

TEST(LightingText, FillsInDefaults) {
  const auto lighting =
      lightingFromText(oneLight(R"("kind": "point", "position": [1, 2, 3])"), "setup.json");
  EXPECT_EQ(lighting, (Lighting{{PointLight{{1, 2, 3}, {1, 1, 1}, Falloff::InverseSquare}}}));
}

TEST(LightingText, IntensityTimesColour) {
  const auto lighting = lightingFromText(
      oneLight(R"("kind": "point", "position": [1, 2, 3], "intensity": 4, "colour": [1, 0.5, 0])"),
      "setup.json");
  EXPECT_EQ(std::get<PointLight>(lighting.lights[0]).intensity, (LinearRgb{4, 2, 0}));
}

TEST(LightingText, NamesTheFieldThatIsWrong) {
  EXPECT_EQ(sentence(oneLight(R"("kind": "point", "position": [1, 2])")),
            "setup.json: field 'lights[0].position': expected 3 elements, found 2");
  EXPECT_THAT(sentence(oneLight(R"("kind": "torch")")),
              StartsWith("setup.json: field 'lights[0].kind': expected one of 'directional', "));
  EXPECT_THAT(sentence(oneLight(R"("kind": "sphere", "centre": [0, 0, 1], "radius": -1)")),
              HasSubstr("lights[0].radius"));
  EXPECT_THAT(sentence(oneLight(R"("kind": "directional", "direction": [0, 0, 0])")),
              HasSubstr("expected a direction, found the zero vector"));
  EXPECT_THAT(sentence(R"({"lighting": 2, "lights": []})"), HasSubstr("field 'lighting'"));
  EXPECT_THAT(sentence(R"({"lighting": 1, "lights": []})"), HasSubstr("field 'lights'"));
}

TEST(LightingText, RefusesUnknownFieldsByName) {
  EXPECT_EQ(sentence(oneLight(R"("kind": "point", "position": [1, 2, 3], "color": [1, 0, 0])")),
            "setup.json: field 'lights[0].color': expected one of 'kind', 'position', 'intensity', "
            "'colour', 'falloff', found another name");
  EXPECT_THAT(sentence(R"({"lighting": 1, "light": [], "lights": [{"kind": "sky", "model":
                       "overcast"}]})"),
              HasSubstr("field 'light': expected one of 'lighting', 'lights'"));
}

TEST(LightingText, RefusesContradictions) {
  EXPECT_THAT(sentence(oneLight(R"("kind": "spot", "position": [0, 0, 1], "target": [0, 0, 1])")),
              HasSubstr("lights[0].target"));
  EXPECT_THAT(sentence(oneLight(R"("kind": "spot", "position": [0, 0, 1], "target": [0, 0, 0],
                                   "coneDegrees": 5)")),
              HasSubstr("lights[0].edgeDegrees"));
  EXPECT_THAT(sentence(oneLight(R"("kind": "rectangle", "centre": [0, 0, 1], "halfWidth": [1, 0, 0],
                                   "halfHeight": [1, 1, 0])")),
              HasSubstr("perpendicular"));
  EXPECT_THAT(sentence(oneLight(R"("kind": "sky", "model": "clear", "sun": [1, -0.1, 0])")),
              HasSubstr("above the horizon"));
  EXPECT_THAT(sentence(oneLight(R"("kind": "environment", "picture": "a\u0000b.exr")")),
              HasSubstr("a zero byte"));
}

TEST(LightingText, EveryTruncationIsOneSentence) {
  const std::string text = textOf(everyKind());
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    const std::string found = sentence(std::string_view(text).substr(0, length));
    EXPECT_THAT(found, StartsWith("setup.json: ")) << length;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

TEST(LightingText, RefusesHostileFiles) {
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("7"), std::string("{"),
        std::string(100'000, '['), std::string(17 << 20, ' '), std::string("\x00\xff\xfe", 3),
        oneLight(R"("kind": "point", "position": [1e400, 0, 0])"),
        oneLight(R"("kind": "point", "position": ["1", 0, 0])"),
        oneLight(R"("kind": "rectangle", "centre": [0,0,0], "halfWidth": [1,0,0],
                    "halfHeight": [0,1,0], "across": 1000000000)")})
    EXPECT_THAT(sentence(text), StartsWith("setup.json: ")) << text.substr(0, 100);
}

TEST(LightingText, PicturesAreFoundBesideTheSetUp) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("illum_lighting_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  writeLighting(folder / "setup.json", everyKind());
  const Lighting lighting = readLighting(folder / "setup.json");
  std::filesystem::remove_all(folder);
  EXPECT_EQ(std::get<EnvironmentLight>(lighting.lights[5]).picture, folder / "maps/street.exr");
}

}  // namespace
}  // namespace illum
