#include "object/view_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "illum/error.h"
#include "json/visitors.h"
#include "object/view_fields.h"

namespace illum {
namespace {

using testing::HasSubstr;
using namespace fields;

std::vector<ViewGeometry> everyKind() {
  LightSlab slab;
  slab.name = "front";
  slab.objectFromSlab = rotationAbout(Direction::fromVector({1, 2, 3}), 0.7);
  slab.uCount = 3;
  slab.vCount = 2;
  slab.size = {64, 48};
  LightSlab other = slab;
  other.name = "back";
  PinholeCamera camera;
  camera.objectFromCamera = lookAt({1, 2, 3}, {0, 0, 0}, {0, 1, 0});
  camera.focalX = 0.1;
  camera.centre = {31.5, 24.25};
  camera.size = {64, 48};
  Panorama panorama;
  panorama.projection = Panorama::Projection::Cylindrical;
  panorama.size = {100, 20};
  return {OrthographicView{{7, 9}},
          SlabView{slab, 2, 1},
          SlabView{other, 0, 0},
          SlabView{slab, 0, 1},
          camera,
          panorama};
}

TEST(ViewRecord, EveryKindOfViewGoesThroughJson) {
  std::vector<LightSlab> slabs;
  for (const ViewGeometry& view : everyKind()) {
    ViewRecord record = recordOf(view, slabs);
    Writer writer{FieldPath()};
    describe(writer, record);
    const Json json = Json::parse(writer.node().dump());
    ViewRecord back;
    Reader reader(json, FieldPath());
    describe(reader, back);
    EXPECT_EQ(geometryOf(back, slabs), view) << json;
    EXPECT_NO_THROW(checkGeometry(view)) << json;
  }
  EXPECT_EQ(slabs.size(), 2u) << "equal slabs are one";
}

TEST(ViewRecord, SlabsGoThroughJson) {
  std::vector<LightSlab> slabs;
  recordOf(everyKind()[1], slabs);
  Writer writer{FieldPath()};
  describe(writer, slabs[0]);
  const Json json = Json::parse(writer.node().dump());
  LightSlab back;
  Reader reader(json, FieldPath());
  describe(reader, back);
  EXPECT_EQ(back, slabs[0]) << json;
}

TEST(ViewRecord, OnlyViewPointsThatExistAreTaken) {
  std::vector<LightSlab> slabs;
  const ViewRecord good = recordOf(everyKind()[1], slabs);
  for (const auto& [slab, u, v] :
       {std::array{1, 0, 0}, {-1, 0, 0}, {0, 3, 0}, {0, 0, 2}, {0, -1, 0}}) {
    ViewRecord record = good;
    record.slab = slab;
    record.u = u;
    record.v = v;
    EXPECT_THROW(geometryOf(record, slabs), Error) << slab << ' ' << u << ' ' << v;
  }
}

std::string refusalOf(const ViewGeometry& view) {
  try {
    checkGeometry(view);
    return "taken";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ViewRecord, WhatCannotBeSeenThroughIsRefused) {
  const auto withSlab = [](const std::function<void(LightSlab&)>& change) {
    auto view = std::get<SlabView>(everyKind()[1]);
    change(view.slab);
    return refusalOf(view);
  };
  EXPECT_THAT(withSlab([](LightSlab& s) { s.distance = 0; }), HasSubstr("distance > 0"));
  EXPECT_THAT(withSlab([](LightSlab& s) { s.distance = NAN; }), HasSubstr("distance > 0"));
  EXPECT_THAT(withSlab([](LightSlab& s) { s.st.left = s.st.right; }), HasSubstr("left < right"));
  EXPECT_THAT(withSlab([](LightSlab& s) { s.uv.bottom = 2; }), HasSubstr("bottom < top"));
  EXPECT_THAT(withSlab([](LightSlab& s) { s.objectFromSlab.rotation[0] += 0.01; }),
              HasSubstr("a rotation"));
  EXPECT_THAT(withSlab([](LightSlab& s) { s.objectFromSlab.rotation[4] = NAN; }),
              HasSubstr("a rotation"));
  EXPECT_THAT(withSlab([](LightSlab& s) {
                for (double& r : s.objectFromSlab.rotation) r = -r;
              }),
              HasSubstr("a mirroring"));
  EXPECT_EQ(withSlab([](LightSlab& s) { s.uCount = s.vCount = 1, s.uv = {0, 0, 0, 0}; }), "taken");

  auto panorama = std::get<Panorama>(everyKind()[5]);
  panorama.extent = {-4, -1, 4, 1};
  EXPECT_THAT(refusalOf(panorama), HasSubstr("a whole turn"));
  panorama.extent = {-1, -2, 1, 1};
  EXPECT_EQ(refusalOf(panorama), "taken") << "heights on a cylinder may be anything";
  panorama.projection = Panorama::Projection::Equirectangular;
  EXPECT_THAT(refusalOf(panorama), HasSubstr("a quarter turn"));
  auto camera = std::get<PinholeCamera>(everyKind()[4]);
  camera.focalY = -1;
  EXPECT_THAT(refusalOf(camera), HasSubstr("focal lengths"));
}

}  // namespace
}  // namespace illum
