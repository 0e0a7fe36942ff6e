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

/// Everything set to something else than its default; every kind of view but a photograph.
Manifest fullManifest() {
  Manifest m;
  m.tile = 256;
  m.response = Response::Cone;
  BasisEntry separable;
  separable.name = "hsh";
  separable.coefficients = 1;
  separable.colour.colourMatrix = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  separable.domain = LightDomain::Sphere;
  separable.tableOffset = 12;
  separable.tableBytes = 345;
  separable.coding = {Coding::Png,  12, Curve::SignedSqrt, 0.1, {-1, 0.5, 1e-9, 0.25},
                      {0, 1, 2, 0}, 33};
  separable.mixing = {0.3333333333333333};
  BasisEntry full;
  full.name = "learned";
  full.coefficients = 3;
  full.colour.kind = BasisColour::Kind::Full;
  full.tableBytes = 12;
  full.coding = separable.coding;
  full.coding.offsets = {2};
  full.coding.functions = {2};
  m.bases = {separable, full};
  LightSlab slab;
  slab.name = "front";
  slab.objectFromSlab = {{0, -1, 0, 1, 0, 0, 0, 0, 1}, {1, 2, 3}};
  slab.distance = 4;
  slab.uv = {-1, -0.5, 1, 0.5};
  slab.uCount = 9;
  slab.vCount = 5;
  slab.st = {-2, -1, 2, 1};
  slab.size = {1000, 700};
  const RigidTransform pose{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.5, 0, 0}};
  m.groups = {
      {{"a", SlabView{slab, 8, 0}}, 1, DepthRange{-1, 0.5, 300}},
      {{"b", SlabView{slab, 0, 4}}, 0, {}},
      {{"c", PinholeCamera{pose, 10, 11, {3, 2.5}, {6, 5}}}, 0, {}},
      {{"d", Panorama{Panorama::Projection::Cylindrical, pose, {-1, -0.5, 1, 0.5}, {8, 4}}}, 0, {}},
      {{"e", Panorama{Panorama::Projection::Equirectangular, {}, {-3, -1, 3, 1.5}, {9, 5}}},
       0,
       DepthRange{1, 1, 1}}};
  m.mask = true;
  m.lights = {{"a \"b\" \xc3\xa9.jpg", {Direction::fromVector({1, 2, 3}), {0.1f, 2, 3}}, 0},
              {"", {Direction::fromVector({-1, 0, 1e-9}), {1, 1, 1}}, 0}};
  m.heldOut = {0, 1};
  m.generator = "test";
  m.provenance = {{"b", "1"}, {"a", "2"}, {"b", "3"}};
  return m;
}

/// The same of one photograph.
Manifest photographManifest(Size size = {1000, 700}) {
  Manifest m = fullManifest();
  m.groups = {{{"photograph", OrthographicView{size}}, 1, {}}};
  return m;
}

constexpr std::string_view kGolden = R"({
  "format": "illum",
  "version": [1,0],
  "generator": "test",
  "tile": 256,
  "response": "cone",
  "coding": {"name":"png","bits":12,"curve":"signedSqrt","step":0.1,"quality":33},
  "bases": [
    {
      "name": "hsh",
      "coefficients": 1,
      "kind": "separable",
      "colourMatrix": [0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9],
      "domain": "sphere",
      "tableOffset": 12,
      "tableBytes": 345,
      "offsets": [-1.0,0.5,1e-09,0.25],
      "functions": [0,1,2,0],
      "mixing": [0.3333333333333333]
    },
    {
      "name": "learned",
      "coefficients": 3,
      "kind": "full",
      "colourMatrix": [1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],
      "domain": "hemisphere",
      "tableOffset": 0,
      "tableBytes": 12,
      "offsets": [2.0],
      "functions": [2],
      "mixing": []
    }
  ],
  "slabs": [
    {
      "name": "front",
      "size": {"width":1000,"height":700},
      "objectFromSlab": {"rotation":[0.0,-1.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0],"translation":[1.0,2.0,3.0]},
      "distance": 4.0,
      "uCount": 9,
      "vCount": 5,
      "uv": {"left":-1.0,"bottom":-0.5,"right":1.0,"top":0.5},
      "st": {"left":-2.0,"bottom":-1.0,"right":2.0,"top":1.0}
    }
  ],
  "groups": [
    {
      "name": "a",
      "basis": 1,
      "geometry": {"kind":"slab","slab":0,"u":8,"v":0},
      "depth": {"from":-1.0,"to":0.5,"steps":300}
    },
    {"name":"b","basis":0,"geometry":{"kind":"slab","slab":0,"u":0,"v":4}},
    {
      "name": "c",
      "basis": 0,
      "geometry": {
        "kind": "camera",
        "camera": {
          "size": {"width":6,"height":5},
          "objectFromCamera": {"rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],"translation":[0.5,0.0,0.0]},
          "focalX": 10.0,
          "focalY": 11.0,
          "centre": {"x":3.0,"y":2.5}
        }
      }
    },
    {
      "name": "d",
      "basis": 0,
      "geometry": {
        "kind": "panorama",
        "panorama": {
          "projection": "cylindrical",
          "size": {"width":8,"height":4},
          "objectFromCamera": {"rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],"translation":[0.5,0.0,0.0]},
          "extent": {"left":-1.0,"bottom":-0.5,"right":1.0,"top":0.5}
        }
      }
    },
    {
      "name": "e",
      "basis": 0,
      "geometry": {
        "kind": "panorama",
        "panorama": {
          "projection": "equirectangular",
          "size": {"width":9,"height":5},
          "objectFromCamera": {"rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0],"translation":[0.0,0.0,0.0]},
          "extent": {"left":-3.0,"bottom":-1.0,"right":3.0,"top":1.5}
        }
      },
      "depth": {"from":1.0,"to":1.0,"steps":1}
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
  ASSERT_EQ(m.groups.size(), fullManifest().groups.size());
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    EXPECT_EQ(m.groups[g].view, fullManifest().groups[g].view) << g;
    EXPECT_EQ(m.groups[g].depth, fullManifest().groups[g].depth) << g;
    EXPECT_EQ(m.groups[g].basis, fullManifest().groups[g].basis) << g;
  }
  EXPECT_EQ(m.grid(1).size, (Size{1000, 700}));
  EXPECT_EQ(m.bases[0].domain, LightDomain::Sphere);
  EXPECT_EQ(m.response, Response::Cone);
  EXPECT_EQ(m.coding(0).coding, Coding::Png);
  EXPECT_EQ(m.coding(0).curve, Curve::SignedSqrt);
  EXPECT_EQ(m.coding(0).functions, std::vector<int>{2});
  EXPECT_EQ(m.coding(1).functions, (std::vector<int>{0, 1, 2, 0}));
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
  m.bases.pop_back();
  for (GroupEntry& group : m.groups) group.basis = 0;
  m.bases[0].coding = {
      Coding::Avif, 8, Curve::Linear, 1, values, std::vector<int>(values.size(), 0), 50};
  const Manifest back = manifestFromText(textOf(m), "FILE");
  ASSERT_EQ(back.coding().offsets.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(std::memcmp(&back.coding().offsets[i], &values[i], sizeof(double)), 0)
        << values[i] << " became " << back.coding().offsets[i];
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
    expectRefusal("coding.step", [&](Manifest& m) { m.bases[0].coding.step = bad; });
    expectRefusal("bases[0].offsets[2]", [&](Manifest& m) { m.bases[0].coding.offsets[2] = bad; });
    expectRefusal("bases[0].colourMatrix[8]",
                  [&](Manifest& m) { m.bases[0].colour.colourMatrix[8] = bad; });
    expectRefusal("bases[0].mixing[0]", [&](Manifest& m) { m.bases[0].mixing[0] = bad; });
    const auto slab = [](Manifest& m) -> LightSlab& {
      return std::get<SlabView>(m.groups[0].view.geometry).slab;
    };
    const auto camera = [](Manifest& m) -> PinholeCamera& {
      return std::get<PinholeCamera>(m.groups[2].view.geometry);
    };
    expectRefusal("slabs[0].objectFromSlab.rotation[4]",
                  [&](Manifest& m) { slab(m).objectFromSlab.rotation[4] = bad; });
    expectRefusal("slabs[0].objectFromSlab.translation[1]",
                  [&](Manifest& m) { slab(m).objectFromSlab.translation.y = bad; });
    expectRefusal("slabs[0].distance", [&](Manifest& m) { slab(m).distance = bad; });
    expectRefusal("slabs[0].uv.right", [&](Manifest& m) { slab(m).uv.right = bad; });
    expectRefusal("slabs[0].st.top", [&](Manifest& m) { slab(m).st.top = bad; });
    expectRefusal("groups[2].geometry.camera.focalY", [&](Manifest& m) { camera(m).focalY = bad; });
    expectRefusal("groups[2].geometry.camera.centre.x",
                  [&](Manifest& m) { camera(m).centre.x = bad; });
    expectRefusal("groups[0].depth.to", [&](Manifest& m) { m.groups[0].depth->to = bad; });
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
  EXPECT_THAT(errorOfWriting([](Manifest& m) {
                std::get<PinholeCamera>(m.groups[2].view.geometry).size.width = 0;
              }),
              HasSubstr("object.json: field 'groups[2].geometry.camera.size.width'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.tile = 63; }), HasSubstr("'tile'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.bases[0].coding.functions.pop_back(); }),
              HasSubstr("'bases[0].functions': expected 4 values"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.bases[0].coding.functions[0] = 3; }),
              HasSubstr("'bases[0].functions': expected less than 3"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.bases[1].coding.step = 0.2; }),
              HasSubstr("'coding': expected the same for all bases"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) {
                std::get<SlabView>(m.groups[1].view.geometry).slab.distance = 5;
              }),
              HasSubstr("'groups[1].geometry, its slab': expected one slab of each name"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.heldOut = {1, 0}; }), HasSubstr("'heldOut'"));
  EXPECT_THAT(errorOfWriting([](Manifest& m) { m.generator.assign(5000, 'x'); }),
              HasSubstr("'generator'"));
}

TEST(Manifest, EveryRequiredFieldIsMissedByName) {
  for (const std::string& pointer :
       std::vector<std::string>{"/generator",
                                "/tile",
                                "/response",
                                "/coding",
                                "/coding/name",
                                "/coding/bits",
                                "/coding/curve",
                                "/coding/step",
                                "/bases",
                                "/bases/0/name",
                                "/bases/0/coefficients",
                                "/bases/0/kind",
                                "/bases/0/colourMatrix",
                                "/bases/0/domain",
                                "/bases/0/tableOffset",
                                "/bases/0/tableBytes",
                                "/bases/0/offsets",
                                "/bases/0/functions",
                                "/slabs/0/name",
                                "/slabs/0/objectFromSlab",
                                "/slabs/0/distance",
                                "/slabs/0/uv",
                                "/slabs/0/uCount",
                                "/slabs/0/vCount",
                                "/slabs/0/st",
                                "/slabs/0/size",
                                "/groups",
                                "/groups/1/name",
                                "/groups/1/basis",
                                "/groups/1/geometry",
                                "/groups/1/geometry/kind",
                                "/groups/1/geometry/slab",
                                "/groups/1/geometry/u",
                                "/groups/1/geometry/v",
                                "/groups/0/depth/from",
                                "/groups/0/depth/to",
                                "/groups/0/depth/steps",
                                "/groups/2/geometry/camera",
                                "/groups/2/geometry/camera/size",
                                "/groups/2/geometry/camera/size/width",
                                "/groups/2/geometry/camera/size/height",
                                "/groups/2/geometry/camera/objectFromCamera",
                                "/groups/2/geometry/camera/objectFromCamera/rotation",
                                "/groups/2/geometry/camera/objectFromCamera/translation",
                                "/groups/2/geometry/camera/focalX",
                                "/groups/2/geometry/camera/centre",
                                "/groups/3/geometry/panorama/extent",
                                "/groups/3/geometry/panorama/extent/left",
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
                                "/groups/0/depth", "/bases/0/mixing", "/lights/0/intensity"}) {
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
           {"/groups/2/geometry/camera/size",
            {1000, 700},
            "size': expected a record, found a list"},
           {"/groups/2/geometry/camera/size/width", 0,
            "'groups[2].geometry.camera.size.width': expected a number from 1 to 1048576, found 0"},
           {"/groups/2/geometry/camera/size/width", -1,
            "'groups[2].geometry.camera.size.width': expected a whole number from 1 to 1048576"},
           {"/groups/2/geometry/camera/size/width", 1.5, "found 1.5"},
           {"/groups/2/geometry/camera/size/width", "9", "found \"9\""},
           {"/groups/2/geometry/camera/size/width", nullptr, "found null"},
           {"/slabs/0/size/height", big, "'slabs[0].size.height': expected a number from 1 to"},
           {"/groups/3/geometry/panorama/size/height", 18446744073709551615ull,
            "found 18446744073709551615"},
           {"/tile", 60, "'tile': expected a number from 64 to 1360"},
           {"/tile", 65, "'tile': expected a multiple of 8"},
           {"/tile", 1368, "'tile': expected a number from 64 to 1360"},
           {"/response", "gamma", "'response': expected one of 'linear', 'display', 'cone'"},
           {"/coding/name", "gif", "'coding.name': expected one of"},
           {"/coding/bits", 9, "'coding.bits': expected a depth that png can hold, found 9"},
           {"/coding/bits", 32, "'coding.bits': expected a number from 8 to 16"},
           {"/coding/step", 0, "'coding.step'"},
           {"/coding/step", -1, "'coding.step'"},
           {"/coding/step", 1e31, "'coding.step'"},
           {"/coding/step", "1", "'coding.step': expected a number"},
           {"/bases/0/domain", "disc",
            "'bases[0].domain': expected one of 'hemisphere', 'sphere', found \"disc\""},
           {"/bases/0/offsets", json::array(),
            "'bases[0].offsets': expected 1 to 768 elements, found 0"},
           {"/bases/0/offsets", json(769, 0.0), "'bases[0].offsets': expected 1 to 768 elements"},
           {"/bases/0/offsets/1", nullptr, "'bases[0].offsets[1]': expected a number, found null"},
           {"/bases/0/functions", {0, 1}, "'bases[0].functions': expected 4 values, found 2"},
           {"/bases/0/functions/3", 3, "'bases[0].functions': expected less than 3"},
           {"/bases/0/functions/3", 768, "'bases[0].functions[3]'"},
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
           {"/groups", json::array(), "'groups': expected 1 to 65536"},
           {"/groups/0/basis", 2, "'groups[0].basis': expected less than 2, found 2"},
           {"/groups/1/name", "a", "'groups[1].name': expected a name of its own, found 'a'"},
           {"/groups/2/geometry/kind", "hologram",
            "'groups[2].geometry.kind': expected one of 'photograph'"},
           {"/groups/2/geometry",
            {{"kind", "photograph"}, {"size", {{"width", 1}, {"height", 1}}}},
            "to be an object's only view, found 5 groups"},
           {"/groups/0/geometry/slab", 1, "'groups[0].geometry': view: expected a slab below 1"},
           {"/groups/0/geometry/u", 9, "'groups[0].geometry': view: expected a view point of 9x5"},
           {"/groups/0/geometry/v", 5, "found (8, 5)"},
           {"/groups/0/geometry/u", -1, "'groups[0].geometry.u': expected a whole number"},
           {"/groups/1", json::parse(kGolden)["groups"][0], "a name of its own"},
           {"/groups/1/geometry", json::parse(kGolden)["groups"][0]["geometry"],
            "'groups[1].geometry': expected one view at each u, v, found a second one at (8, 0)"},
           {"/groups/0/depth/from", 0.6, "'groups[0].depth': expected from not above to"},
           {"/groups/0/depth/steps", 65535, "'groups[0].depth.steps'"},
           {"/groups/0/depth/steps", 0, "'groups[0].depth.steps'"},
           {"/groups/0/depth", nullptr, "'groups[0].depth': expected a record, found null"},
           {"/groups/2/geometry/camera/focalX", 0, "'groups[2].geometry.camera.focalX'"},
           {"/groups/2/geometry/camera/focalY", -1, "'groups[2].geometry.camera.focalY'"},
           {"/groups/2/geometry/camera/objectFromCamera/rotation/0", -1,
            "'groups[2].geometry': camera: expected a rotation, found a mirroring"},
           {"/groups/2/geometry/camera/objectFromCamera/rotation/0", 0.999, "expected a rotation"},
           {"/groups/2/geometry/camera/objectFromCamera/rotation/0", 2,
            "rotation[0]': expected a number from"},
           {"/groups/3/geometry/panorama/extent/left", 1,
            "'groups[3].geometry': panorama: expected"},
           {"/groups/3/geometry/panorama/extent/left", -6, "expected at most a whole turn"},
           {"/groups/3/geometry/panorama/extent/bottom", 0.5, "bottom < top"},
           {"/groups/4/geometry/panorama/extent/top", 1.6, "expected elevations within"},
           {"/groups/4/geometry/panorama/extent/top", "NaN", "extent.top': expected a number"},
           {"/slabs/0/objectFromSlab/rotation",
            {1, 0, 0, 0, 1, 0, 0, 0, -1},
            "slab 'front': expected a rotation, found a mirroring"},
           {"/slabs/0/objectFromSlab/rotation", json(9, 0), "expected a rotation"},
           {"/slabs/0/distance", 0, "'slabs[0].distance'"},
           {"/slabs/0/distance", -1, "'slabs[0].distance'"},
           {"/slabs/0/uCount", 0, "'slabs[0].uCount'"},
           {"/slabs/0/uCount", big, "'slabs[0].uCount'"},
           {"/slabs/0/uv/left", 1, "slab 'front', view points uv: expected left < right"},
           {"/slabs/0/st/top", -1, "slab 'front', window st: expected left < right"},
           {"/slabs/0/st/top", nullptr, "'slabs[0].st.top': expected a number, found null"},
           {"/slabs/0/name", "", "its slab's name': expected 1 to 255 bytes"},
           {"/slabs", 3, "'slabs': expected a list"},
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
  root["slabs"][0]["size"] = {{"width", kMaxSide}, {"height", kMaxSide}};
  root["tile"] = 64;
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
    Manifest m = photographManifest(size);
    m.tile = 64;
    const TileGrid grid = m.grid(0);
    std::size_t tiles = 0;
    for (int level = 0; level < grid.levels(); ++level) {
      const Size whole = grid.sizeAt(level);
      EXPECT_EQ(whole.width, static_cast<int>(std::ceil(size.width / std::exp2(level))));
      EXPECT_EQ(whole.height, static_cast<int>(std::ceil(size.height / std::exp2(level))));
      EXPECT_EQ(std::max(whole.width, whole.height) <= 64, level == grid.levels() - 1);
      std::size_t texels = 0;
      for (int y = 0; y < grid.tilesDown(level); ++y)
        for (int x = 0; x < grid.tilesAcross(level); ++x) {
          const Rectangle tile = grid.tileRectangle(level, x, y);
          EXPECT_EQ(tile.x, 64 * x);
          EXPECT_EQ(tile.y, 64 * y);
          EXPECT_TRUE(tile.width >= 1 && tile.width <= 64 && tile.height >= 1 && tile.height <= 64);
          texels += tile.pixels();
          ++tiles;
        }
      EXPECT_EQ(texels, whole.pixels()) << size.width << "x" << size.height << " level " << level;
    }
    EXPECT_EQ(tiles, grid.tiles());
  }
}

TEST(Manifest, RequiredEntriesAreAllTilesInCanonicalOrder) {
  Manifest m = photographManifest({300, 200});
  std::vector<std::string> names;
  const auto visit = [&](const std::string& name) { names.push_back(name); };
  forEachRequiredEntry(m, visit);
  EXPECT_THAT(names,
              testing::ElementsAre("object.json", "basis.bin", "planes/0/0/0_0.png",
                                   "planes/0/0/1_0.png", "planes/0/1/0_0.png", "mask/0/0/0_0.png",
                                   "mask/0/0/1_0.png", "mask/0/1/0_0.png"));
  m = fullManifest();
  m.groups.erase(m.groups.begin(), m.groups.begin() + 3);
  names.clear();
  forEachRequiredEntry(m, visit);
  EXPECT_THAT(names, testing::ElementsAre("object.json", "basis.bin", "planes/0/0/0_0.png",
                                          "planes/1/0/0_0.png", "depth/1/0/0_0.png",
                                          "mask/0/0/0_0.png", "mask/1/0/0_0.png"));
}

TEST(Manifest, HoldsAsManyViewsAsTheFormatAllows) {
  Manifest m = fullManifest();
  m.mask = false;
  auto slab = std::get<SlabView>(m.groups[0].view.geometry).slab;
  slab.uCount = slab.vCount = 256;
  slab.size = {8, 8};
  m.groups.clear();
  for (int v = 0; v < 256; ++v)
    for (int u = 0; u < 256; ++u)
      m.groups.push_back(
          {{"front:" + std::to_string(u) + "," + std::to_string(v), SlabView{slab, u, v}},
           0,
           DepthRange{-0.12345678901234567, 0.98765432109876543, 65534}});
  const Manifest back = manifestFromText(textOf(m), "FILE");
  ASSERT_EQ(back.groups.size(), m.groups.size());
  EXPECT_EQ(back.groups.back().view, m.groups.back().view);
  m.groups.push_back(m.groups.back());
  m.groups.back().view.name = "one more";
  EXPECT_THROW(textOf(m), Error);
}

Manifest exactManifest() {
  Manifest m = photographManifest();
  BasisEntry exact;
  exact.name = "exact";
  exact.coefficients = 2;
  exact.colour.kind = BasisColour::Kind::Exact;
  exact.domain = LightDomain::Sphere;
  exact.tableBytes = 12;
  exact.coding = {Coding::Png, 16, Curve::Half, 1, {0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5}, 0};
  m.bases = {exact};
  m.groups[0].basis = 0;
  return m;
}

// What older readers understand stays theirs; what they would misread says that it is newer.
TEST(Manifest, StatesTheOldestVersionThatKnowsIt) {
  EXPECT_THAT(textOf(photographManifest()), HasSubstr("\"version\": [1,0]"));
  const std::string text = textOf(exactManifest());
  EXPECT_THAT(text, HasSubstr("\"version\": [1,1]"));
  const Manifest back = manifestFromText(text, "FILE");
  EXPECT_EQ(back.bases[0].colour.kind, BasisColour::Kind::Exact);
  EXPECT_EQ(back.coding().curve, Curve::Half);
  EXPECT_EQ(back.coding().planes(), 6);
}

TEST(Manifest, RefusesHalvesAndExactBasesThatContradictThemselves) {
  const json golden = json::parse(textOf(exactManifest()));
  for (const BadValue& bad : std::vector<BadValue>{
           {"/coding/bits", 12, "'coding.bits': expected 16 with the curve half, found 12"},
           {"/coding/step", 2, "'coding.step': expected 1 with the curve half"},
           {"/bases/0/offsets/3", 0.5, "'bases[0].offsets': expected 0 with the curve half"},
           {"/bases/0/domain", "hemisphere", "'bases[0].domain': expected sphere"},
           {"/bases/0/colourMatrix/1", 1, "'bases[0].colourMatrix': expected the identity"},
           {"/bases/0/functions/5", 6, "'bases[0].functions': expected less than 6"},
           {"/bases/0/kind", "exakt", "'separable', 'full', 'exact'"},
           {"/coding/curve", "quarter", "'linear', 'signedSqrt', 'half'"}}) {
    json root = golden;
    root[json::json_pointer(bad.pointer)] = bad.value;
    EXPECT_THAT(errorOf(root.dump()), HasSubstr(bad.complaint)) << bad.pointer;
  }
}

TEST(Manifest, CodesMeanWhatTheirCurveSays) {
  CodingEntry coding = exactManifest().coding();
  EXPECT_EQ(valueOfCode(coding, 0, 0x3c00), 1);
  EXPECT_EQ(valueOfCode(coding, 0, 0xc000), -2);
  EXPECT_EQ(valueOfCode(coding, 0, 0x7bff), 65504);
  EXPECT_EQ(valueOfCode(coding, 0, 0x0001), std::ldexp(1.0, -24));
  EXPECT_TRUE(std::signbit(valueOfCode(coding, 0, 0x8000)));
  EXPECT_TRUE(std::isinf(valueOfCode(coding, 0, 0xfc00)));
  EXPECT_TRUE(std::isnan(valueOfCode(coding, 0, 0x7c01)));
  coding = fullManifest().bases[0].coding;  // -1 + 0.1 q, squared with its sign
  EXPECT_NEAR(valueOfCode(coding, 0, 5), -0.25, 1e-15);
  coding.curve = Curve::Linear;
  EXPECT_NEAR(valueOfCode(coding, 0, 5), -0.5, 1e-15);
}

}  // namespace
}  // namespace illum
