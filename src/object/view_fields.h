// The fields of views in JSON, for json/visitors.h.
#pragma once

#include "object/manifest_fields.h"
#include "object/view_record.h"

namespace illum::fields {

inline constexpr int kMaxSlabSide = 1024;  // view points in a row of a slab

template <typename Visitor>
void describe(Visitor& v, PlaneRectangle& rectangle) {
  v.number("left", rectangle.left, -kHuge, kHuge);
  v.number("bottom", rectangle.bottom, -kHuge, kHuge);
  v.number("right", rectangle.right, -kHuge, kHuge);
  v.number("top", rectangle.top, -kHuge, kHuge);
}

template <typename Visitor>
void describe(Visitor& v, PixelPosition& position) {
  v.number("x", position.x, -kHuge, kHuge);
  v.number("y", position.y, -kHuge, kHuge);
}

template <typename Visitor>
void describe(Visitor& v, LightSlab& slab) {
  v.text("name", slab.name);
  v.record("size", slab.size);
  v.record("objectFromSlab", slab.objectFromSlab);
  v.number("distance", slab.distance, 1e-30, kHuge);
  v.integer("uCount", slab.uCount, 1, kMaxSlabSide);
  v.integer("vCount", slab.vCount, 1, kMaxSlabSide);
  v.record("uv", slab.uv);
  v.record("st", slab.st);
}

template <typename Visitor>
void describe(Visitor& v, PinholeCamera& camera) {
  v.record("size", camera.size);
  v.record("objectFromCamera", camera.objectFromCamera);
  v.number("focalX", camera.focalX, 1e-30, kHuge);
  v.number("focalY", camera.focalY, 1e-30, kHuge);
  v.record("centre", camera.centre);
}

template <typename Visitor>
void describe(Visitor& v, Panorama& panorama) {
  using Projection = Panorama::Projection;
  v.choice("projection", panorama.projection,
           Choices<Projection>{{Projection::Equirectangular, "equirectangular"},
                               {Projection::Cylindrical, "cylindrical"}});
  v.record("size", panorama.size);
  v.record("objectFromCamera", panorama.objectFromCamera);
  v.record("extent", panorama.extent);
}

template <typename Visitor>
void describe(Visitor& v, ViewRecord& view) {
  v.choice("kind", view.kind,
           Choices<ViewKind>{{ViewKind::Photograph, "photograph"},
                             {ViewKind::Slab, "slab"},
                             {ViewKind::Camera, "camera"},
                             {ViewKind::Panorama, "panorama"}});
  switch (view.kind) {
    case ViewKind::Photograph:
      v.record("size", view.photograph.size);
      break;
    case ViewKind::Slab:
      v.integer("slab", view.slab, 0, kMaxGroups - 1);
      v.integer("u", view.u, 0, kMaxSlabSide - 1);
      v.integer("v", view.v, 0, kMaxSlabSide - 1);
      break;
    case ViewKind::Camera:
      v.record("camera", view.camera);
      break;
    case ViewKind::Panorama:
      v.record("panorama", view.panorama);
      break;
  }
}

}  // namespace illum::fields
