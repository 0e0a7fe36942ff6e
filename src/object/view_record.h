// Views (illum/camera.h) as object.json and capture.json have them: slabs are written once, their
// views name them.
#pragma once

#include <vector>

#include "illum/camera.h"

namespace illum {

enum class ViewKind { Photograph, Slab, Camera, Panorama };

/// A view's geometry with slabs by index. Only the members of its kind count.
struct ViewRecord {
  ViewKind kind = ViewKind::Photograph;
  int slab = 0, u = 0, v = 0;
  OrthographicView photograph;
  PinholeCamera camera;
  Panorama panorama;
};

/// Adds the view's slab to `slabs` unless an equal one is there.
ViewRecord recordOf(const ViewGeometry& view, std::vector<LightSlab>& slabs);

/// Throws Error (Fault::Input), naming no file, for a slab that is not among `slabs` or has no such
/// view point.
ViewGeometry geometryOf(const ViewRecord& record, const std::vector<LightSlab>& slabs);

/// Throws Error (Fault::Input), naming no file, unless the numbers describe something that can be
/// seen through: rotations are rotations, rectangles have insides, the eye is before the window.
void checkSlab(const LightSlab& slab);
void checkGeometry(const ViewGeometry& view);

}  // namespace illum
