#include "object/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "illum/error.h"

namespace illum {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// Everything set to something else than its default.
Manifest fullManifest() {
  Manifest m;
  m.size = {1000, 700};
  m.tile = 256;
  m.levels = 3;
  m.domain = LightDomain::Sphere;
  m.response = Response::Cone;
  m.coding = {Coding::Png, 12, Curve::SignedSqrt, 0.1, {-1, 0.5, 1e-9, 0.25}, {0, 1, 2, 0}, 33};
  BasisEntry separable;
  separable.name = "hsh";
  separable.coefficients = 1;
  separable.colour.colourMatrix = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  separable.tableOffset = 12;
  separable.tableBytes = 345;
  separable.mixing = {0.3333333333333333};
  BasisEntry full;
  full.name = "learned";
  full.coefficients = 3;
  full.colour.kind = BasisColour::Kind::Full;
  full.tableBytes = 12;
  m.bases = {separable, full};
  m.groups = {{"front", 1, 1, {}}, {"back", 0, 1, {}}};
  m.mask = true;
  m.lights = {{"a \"b\" \xc3\xa9.jpg", {Direction::fromVector({1, 2, 3}), {0.1f, 2, 3}}, 0},
              {"", {Direction::fromVector({-1, 0, 1e-9}), {1, 1, 1}}, 0}};
  m.heldOut = {0, 1};
  m.generator = "test";
  m.provenance = {{"b", "1"}, {"a", "2"}, {"b", "3"}};
  return m;
}

constexpr std::string_view kGolden = R"({
  "format": "illum",
  "version": [1,0],
  "generator": "test",
  "geometry": "photograph",
  "size": {"width":1000,"height":700},
  "tile": 256,
  "levels": 3,
  "domain": "sphere",
  "response": "cone",
  "coding": {
    "name": "png",
    "bits": 12,
    "curve": "signedSqrt",
    "step": 0.1,
    "offsets": [-1.0,0.5,1e-09,0.25],
    "functions": [0,1,2,0],
    "quality": 33
  },
  "bases": [
    {
      "name": "hsh",
      "coefficients": 1,
      "kind": "separable",
      "colourMatrix": [0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9],
      "tableOffset": 12,
      "tableBytes": 345,
      "mixing": [0.3333333333333333]
    },
    {
      "name": "learned",
      "coefficients": 3,
      "kind": "full",
      "colourMatrix": [1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],
      "tableOffset": 0,
      "tableBytes": 12,
      "mixing": []
    }
  ],
  "groups": [
    {
      "name": "front",
      "basis": 1,
      "views": 1,
      "objectFromGroup": {"rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],"translation":[0.0,0.0,0.0]}
    },
    {
      "name": "back",
      "basis": 0,
      "views": 1,
      "objectFromGroup": {"rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],"translation":[0.0,0.0,0.0]}
    }
  ],
  "mask": true,
  "lights": [
    {
      "name": "a \"b\" é.jpg",
      "direction": [0.2672612419124244,0.5345224838248488,0.8017837257372732],
      "intensity": [0.10000000149011612,2.0,3.0]
    },
    {"name":"","direction":[-1.0,0.0,1e-09],"intensity":[1.0,1.0,1.0]}
  ],
  "heldOut": [0,1],
  "provenance": [{"name":"b","value":"1"},{"name":"a","value":"2"},{"name":"b","value":"3"}]
}
)";

std::string errorOf(const std::string& text) {
  try {
    manifestFromText(text, "FILE");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return {};
}

/// The golden text with the value at `pointer` (RFC 6901) replaced.
std::string changed(const std::string& pointer, const json& value) {
  json root = json::parse(kGolden);
  root[json::json_pointer(pointer)] = value;
  return root.dump();
}

std::string without(const std::string& pointer) {
  json root = json::parse(kGolden);
  const json::json_pointer at(pointer);
  root[at.parent_pointer()].erase(at.back());
  return root.dump();
}

TEST(Manifest, TextIsFrozen) {
  EXPECT_EQ(textOf(fullManifest()), kGolden);
}

TEST(Manifest, ReadingIsTheInverseOfWriting) {
  const Manifest m = manifestFromText(kGolden, "FILE");
  EXPECT_EQ(textOf(m), kGolden);
  EXPECT_EQ(m.size, (Size{1000, 700}));
  EXPECT_EQ(m.domain, LightDomain::Sphere);
  EXPECT_EQ(m.response, Response::Cone);
  EXPECT_EQ(m.coding.coding, Coding::Png);
  EXPECT_EQ(m.coding.curve, Curve::SignedSqrt);
  EXPECT_EQ(m.coding.functions, fullManifest().coding.functions);
  EXPECT_EQ(m.bases[1].colour.kind, BasisColour::Kind::Full);
  EXPECT_EQ(m.bases[0].tableOffset, 12u);
  EXPECT_EQ(m.lights[0].name, fullManifest().lights[0].name);
  EXPECT_EQ(m.lights[0].light.toLight, fullManifest().lights[0].light.toLight);
  EXPECT_EQ(m.lights[0].light.intensity, fullManifest().lights[0].light.intensity);
  EXPECT_EQ(m.provenance, fullManifest().provenance);
}

TEST(Manifest, DoublesSurviveToTheLastBit) {
  std::mt19937_64 random(1);
  std::vector<double> values{0.0, -0.0, 0.1, 1.0 / 3, 5e-324, 2.2250738585072014e-308, 1e30, -1e30};
  while (values.size() < 700) {
    const auto bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::abs(value) <= 1e30) values.push_back(value);
  }
  Manifest m = fullManifest();
  m.tile = 64;
  m.size = {64, 64};
  m.levels = 1;
  m.coding = {Coding::Avif, 8, Curve::Linear, 1, values, std::vector<int>(values.size(), 0), 50};
  const Manifest back = manifestFromText(textOf(m), "FILE");
  ASSERT_EQ(back.coding.offsets.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(std::memcmp(&back.coding.offsets[i], &values[i], sizeof(double)), 0)
        << values[i] << " became " << back.coding.offsets[i];
}

TEST(Manifest, NamesThatAreNotUtf8AreMarked) {
  Manifest m = fullManifest();
  m.lights[0].name =
      "Stra\xdf"
      "e.jpg";
  EXPECT_EQ(manifestFromText(textOf(m), "FILE").lights[0].name,
            "Stra\xef\xbf\xbd"
            "e.jpg");
}

TEST(Manifest, RefusesToWriteNumbersThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    const auto expectRefusal = [&](const std::string& field, const auto& set) {
      Manifest m = fullManifest();
      set(m);
      try {
        textOf(m);
        ADD_FAILURE() << "expected an Error about " << field;
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("field '" + field + "': expected a number"));
      }
    };
    expectRefusal("coding.step", [&](Manifest& m) { m.coding.step = bad; });
    expectRefusal("coding.offsets[2]", [&](Manifest& m) { m.coding.offsets[2] = bad; });
    expectRefusal("bases[0].colourMatrix[8]",
                  [&](Manifest& m) { m.bases[0].colour.colourMatrix[8] = bad; });
    expectRefusal("bases[0].mixing[0]", [&](Manifest& m) { m.bases[0].mixing[0] = bad; });
    expectRefusal("groups[1].objectFromGroup.rotation[4]",
                  [&](Manifest& m) { m.groups[1].objectFromGroup.rotation[4] = bad; });
    expectRefusal("groups[0].objectFromGroup.translation[1]",
                  [&](Manifest& m) { m.groups[0].objectFromGroup.translation.y = bad; });
    expectRefusal("lights[0].intensity[1]",
                  [&](Manifest& m) { m.lights[0].light.intensity.g = static_cast<float>(bad); });
  }
}

TEST(Manifest, RefusesToWriteWhatItWouldNotRead) {
  const auto errorOfWriting = [](const auto& set) {
    Manifest m = fullManifest();
    set(m);
    try {
      textOf(m);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.size.width = 0; }),
              HasSubstr("object.json: field 'size.width'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.tile = 63; }), HasSubstr("'tile'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.coding.functions.pop_back(); }),
              HasSubstr("'coding.functions': expected 4 values"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.coding.functions[0] = 3; }),
              HasSubstr("'coding.functions': expected less than 3"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.geometry = "slab"; }), HasSubstr("'geometry'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.heldOut = {1, 0}; }), HasSubstr("'heldOut'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.generator.assign(5000, 'x'); }),
              HasSubstr("'generator'"));
}

TEST(Manifest, EveryRequiredFieldIsMissedByName) {
  for (const std::string& pointer :
       std::vector<std::string>{"/generator",
                                "/geometry",
                                "/size",
                                "/size/width",
                                "/size/height",
                                "/tile",
                                "/levels",
                                "/domain",
                                "/response",
                                "/coding",
                                "/coding/name",
                                "/coding/bits",
                                "/coding/curve",
                                "/coding/step",
                                "/coding/offsets",
                                "/coding/functions",
                                "/bases",
                                "/bases/0/name",
                                "/bases/0/coefficients",
                                "/bases/0/kind",
                                "/bases/0/colourMatrix",
                                "/bases/0/tableOffset",
                                "/bases/0/tableBytes",
                                "/groups",
                                "/groups/1/name",
                                "/groups/1/basis",
                                "/groups/1/views",
                                "/groups/1/objectFromGroup",
                                "/groups/1/objectFromGroup/rotation",
                                "/groups/1/objectFromGroup/translation",
                                "/lights/0/name",
                                "/lights/0/direction",
                                "/provenance/0/name",
                                "/provenance/0/value",
                                "/format",
                                "/version"}) {
    const std::string field = pointer.substr(pointer.rfind('/') + 1);
    const std::string error = errorOf(without(pointer));
    EXPECT_THAT(error, StartsWith("FILE: field '")) << pointer;
    EXPECT_THAT(error, HasSubstr(field + "': expected")) << pointer;
    EXPECT_THAT(error, HasSubstr("found none")) << pointer;
  }
}

TEST(Manifest, OptionalFieldsHaveDefaults) {
  for (const std::string& pointer :
       std::vector<std::string>{"/mask", "/lights", "/heldOut", "/provenance", "/coding/quality",
                                "/bases/0/mixing", "/lights/0/intensity"}) {
    json root = json::parse(kGolden);
    root.erase("heldOut");
    const json::json_pointer at(pointer);
    root[at.parent_pointer()].erase(at.back());
    EXPECT_EQ(errorOf(root.dump()), "") << pointer;
  }
}

struct BadValue {
  std::string pointer;
  json value;
  std::string complaint;
};

TEST(Manifest, RefusesValuesByFieldAndReason) {
  const json big = std::uint64_t{1} << 40;
  for (const BadValue& bad : std::vector<BadValue>{
           {"/format", "zip", "'format': expected 'illum'"},
           {"/version", 1, "'version': expected two whole numbers"},
           {"/version", {0, 9}, "'version': expected 1.x, found 0.9"},
           {"/version", {1, -1}, "'version': expected two"},
           {"/version", {1, 1.5}, "'version': expected two"},
           {"/version", {1, big}, "'version': expected 1.x"},
           {"/generator", 5, "'generator': expected text, found 5"},
           {"/generator", std::string(5000, 'x'), "at most 4096 bytes"},
           {"/geometry", "hologram", "'geometry': expected 'photograph', found 'hologram'"},
           {"/size", {1000, 700}, "'size': expected a record, found a list"},
           {"/size/width", 0, "'size.width': expected a number from 1 to 1048576, found 0"},
           {"/size/width", -1, "'size.width': expected a whole number from 1 to 1048576"},
           {"/size/width", 1.5, "found 1.5"},
           {"/size/width", "9", "found \"9\""},
           {"/size/width", nullptr, "found null"},
           {"/size/height", big, "'size.height': expected a number from 1 to 1048576"},
           {"/size/height", 18446744073709551615ull, "found 18446744073709551615"},
           {"/tile", 60, "'tile': expected a number from 64 to 1360"},
           {"/tile", 65, "'tile': expected a multiple of 8"},
           {"/tile", 1368, "'tile': expected a number from 64 to 1360"},
           {"/levels", 0, "'levels'"},
           {"/levels", 4, "'levels': expected no level beyond the first that fits one tile"},
           {"/levels", 64, "'levels'"},
           {"/domain", "disc", "'domain': expected one of 'hemisphere', 'sphere', found \"disc\""},
           {"/response", "gamma", "'response': expected one of 'linear', 'display', 'cone'"},
           {"/coding/name", "gif", "'coding.name': expected one of"},
           {"/coding/bits", 9, "'coding.bits': expected a depth that png can hold, found 9"},
           {"/coding/bits", 32, "'coding.bits': expected a number from 8 to 16"},
           {"/coding/step", 0, "'coding.step'"},
           {"/coding/step", -1, "'coding.step'"},
           {"/coding/step", 1e31, "'coding.step'"},
           {"/coding/step", "1", "'coding.step': expected a number"},
           {"/coding/offsets", json::array(),
            "'coding.offsets': expected 1 to 768 elements, found 0"},
           {"/coding/offsets", json(769, 0.0), "'coding.offsets': expected 1 to 768 elements"},
           {"/coding/offsets/1", nullptr, "'coding.offsets[1]': expected a number, found null"},
           {"/coding/functions", {0, 1}, "'coding.functions': expected 4 values, found 2"},
           {"/coding/functions/3", 3, "'coding.functions': expected less than 3"},
           {"/coding/functions/3", 768, "'coding.functions[3]'"},
           {"/coding/quality", 101, "'coding.quality'"},
           {"/bases", json::array(), "'bases': expected 1 to 1024 elements, found 0"},
           {"/bases", 7, "'bases': expected a list, found 7"},
           {"/bases/0", 7, "'bases[0]': expected a record, found 7"},
           {"/bases/0/coefficients", 0, "'bases[0].coefficients'"},
           {"/bases/0/coefficients", 769, "'bases[0].coefficients'"},
           {"/bases/0/kind", "mixed", "'bases[0].kind'"},
           {"/bases/0/colourMatrix", {1, 0, 0}, "'bases[0].colourMatrix': expected 9 elements"},
           {"/bases/0/tableBytes", big, "'bases[0].tableBytes'"},
           {"/bases/0/tableOffset", big, "'bases[0].tableOffset'"},
           {"/bases/0/mixing", {1, 2}, "'bases[0].mixing': expected 0 or 1 values, found 2"},
           {"/groups", json::array(), "'groups': expected 1 to 1024"},
           {"/groups/0/basis", 2, "'groups[0].basis': expected less than 2, found 2"},
           {"/groups/0/views", 2, "'groups[0].views': expected a number from 1 to 1"},
           {"/groups/0/objectFromGroup/rotation/0", 0.5, "objectFromGroup': expected the identity"},
           {"/groups/0/objectFromGroup/rotation/0", 2, "rotation[0]': expected a number from"},
           {"/groups/0/objectFromGroup/translation", {0, 0, 1}, "expected the identity"},
           {"/mask", 1, "'mask': expected true or false, found 1"},
           {"/lights/0/name", {"a"}, "'lights[0].name': expected text, found a list"},
           {"/lights/0/direction", {0, 0, 0}, "expected a direction, found the zero vector"},
           {"/lights/0/direction", {1, 2}, "'lights[0].direction': expected 3 elements"},
           {"/lights/0/intensity", {1, 1, -1}, "'lights[0].intensity[2]'"},
           {"/heldOut", {2}, "'heldOut': expected rising indices below 2, found 2"},
           {"/heldOut", {1, 1}, "'heldOut'"},
           {"/heldOut", {-1}, "'heldOut[0]'"},
       }) {
    const std::string error = errorOf(changed(bad.pointer, bad.value));
    EXPECT_THAT(error, StartsWith("FILE: ")) << bad.pointer;
    EXPECT_THAT(error, HasSubstr(bad.complaint)) << bad.pointer << " = " << bad.value.dump();
  }
}

TEST(Manifest, RefusesHugeDeclaredSizesWithoutTryingThem) {
  json root = json::parse(kGolden);
  root["size"] = {{"width", kMaxSide}, {"height", kMaxSide}};
  root["tile"] = 64;
  root["levels"] = 1;
  EXPECT_THAT(errorOf(root.dump()), HasSubstr("'tile': expected tiles so large that there are at "
                                              "most 4194304"));
}

TEST(Manifest, ANewerMajorVersionIsRefusedWithAClearSentence) {
  EXPECT_EQ(errorOf(changed("/version", {2, 0})),
            "FILE: made by a newer Illumigraph: format 2.0, this program reads 1.x");
  EXPECT_EQ(errorOf(R"({"format":"illum","version":[3,7],"everything":"else differs"})"),
            "FILE: made by a newer Illumigraph: format 3.7, this program reads 1.x");
}

TEST(Manifest, ANewerMinorVersionIsReadAndItsFieldsSkipped) {
  json root = json::parse(kGolden);
  root["version"] = {1, 99};
  root["hologram"] = {{"waves", {1, 2, 3}}};
  root["coding"]["entropy"] = "better";
  EXPECT_EQ(manifestFromText(root.dump(), "FILE").versionMinor, 99);
}

TEST(Manifest, EveryTruncationIsAnError) {
  for (std::size_t length = 0; length + 2 < kGolden.size(); ++length)
    EXPECT_THAT(errorOf(std::string(kGolden.substr(0, length))), StartsWith("FILE: ")) << length;
}

TEST(Manifest, TextThatIsNoManifestIsAnError) {
  for (const std::string& text :
       {std::string("null"), std::string("[]"), std::string("7"), std::string("\"illum\""),
        std::string("{}"), std::string("{\"format\":\"illum\",\"version\":[1,0],\"size\":NaN}"),
        std::string("{\"format\":\"illum\",\"version\":[1,0],\"size\":1e999}"),
        std::string(100000, '['), std::string("\0\0\0", 3), std::string("\xff\xfe{}")})
    EXPECT_THAT(errorOf(text), StartsWith("FILE: ")) << text.substr(0, 60);
}

TEST(Manifest, TilesCoverEveryLevelOnce) {
  for (const Size size : {Size{1, 1}, Size{64, 64}, Size{65, 64}, Size{1000, 700}, Size{3, 999}}) {
    Manifest m = fullManifest();
    m.size = size;
    m.tile = 64;
    for (int level = 0; level < 5; ++level) {
      const Size whole = m.sizeAt(level);
      EXPECT_EQ(whole.width, static_cast<int>(std::ceil(size.width / std::exp2(level))));
      EXPECT_EQ(whole.height, static_cast<int>(std::ceil(size.height / std::exp2(level))));
      std::size_t texels = 0;
      for (int y = 0; y < m.tilesDown(level); ++y)
        for (int x = 0; x < m.tilesAcross(level); ++x) {
          const Rectangle tile = m.tileRectangle(level, x, y);
          EXPECT_EQ(tile.x, 64 * x);
          EXPECT_EQ(tile.y, 64 * y);
          EXPECT_TRUE(tile.width >= 1 && tile.width <= 64 && tile.height >= 1 && tile.height <= 64);
          texels += tile.pixels();
        }
      EXPECT_EQ(texels, whole.pixels()) << size.width << "x" << size.height << " level " << level;
    }
  }
}

TEST(Manifest, RequiredEntriesAreAllTilesInCanonicalOrder) {
  Manifest m = fullManifest();
  m.size = {300, 200};
  m.levels = 2;
  m.groups.pop_back();
  std::vector<std::string> names;
  forEachRequiredEntry(m, [&](const std::string& name) { names.push_back(name); });
  EXPECT_THAT(names,
              testing::ElementsAre("object.json", "basis.bin", "planes/0/0/0_0.png",
                                   "planes/0/0/1_0.png", "planes/0/1/0_0.png", "mask/0/0/0_0.png",
                                   "mask/0/0/1_0.png", "mask/0/1/0_0.png"));
}

}  // namespace
}  // namespace illum
