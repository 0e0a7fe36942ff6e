// Where the pixels of a view look: rays of pixels, pixels of points, depths
// (docs/conventions.md, "Views").
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "illum/picture.h"
#include "illum/transform.h"
#include "illum/vector.h"

namespace illum {

/// A position in a picture, in pixels from its top left corner; centres are at half integers.
struct PixelPosition {
  double x = 0, y = 0;  ///< y downward
  friend bool operator==(const PixelPosition&, const PixelPosition&) = default;
};

/// origin + t * direction, t >= 0, in the object frame; `direction` is of unit length.
struct Ray {
  Vector3 origin, direction;
};

/// An axis-parallel rectangle of a plane z = constant.
struct PlaneRectangle {
  double left = -1, bottom = -1, right = 1, top = 1;
  friend bool operator==(const PlaneRectangle&, const PlaneRectangle&) = default;
};

/// One photograph: seen along -z, orthographic, centred, half its longer side is 1.
struct OrthographicView {
  Size size;
  friend bool operator==(const OrthographicView&, const OrthographicView&) = default;
};

/// Two parallel planes (Levoy and Hanrahan 1996): view points on a grid of the uv plane z =
/// distance > 0, all looking through one window, the st rectangle of z = 0. Everything in the
/// slab's own frame.
struct LightSlab {
  std::string name;
  RigidTransform objectFromSlab;
  double distance = 1;
  PlaneRectangle uv;
  int uCount = 1, vCount = 1;
  PlaneRectangle st;
  Size size;  ///< pixels of the window

  /// u, v in [0, 1] over the grid, u right, v up; outside that is outside the grid. A single column
  /// (row) of view points stands in the middle of the rectangle, whatever u (v) is.
  Vector3 viewPoint(double u, double v) const;
  friend bool operator==(const LightSlab&, const LightSlab&) = default;
};

/// One view point of a slab. Column `u` of uCount, row `v` of vCount, counted from the left and
/// from the bottom.
struct SlabView {
  LightSlab slab;
  int u = 0, v = 0;
  friend bool operator==(const SlabView&, const SlabView&) = default;
};

/// A camera anywhere, looking along its own -z with y up. Focal lengths and centre in pixels.
struct PinholeCamera {
  RigidTransform objectFromCamera;
  double focalX = 1, focalY = 1;
  PixelPosition centre;
  Size size;
  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;
};

/// A picture of all that is around a point. u grows toward +x, the picture's centre looks along the
/// frame's -z, y is up.
struct Panorama {
  enum class Projection {
    Equirectangular,  ///< rows are even in elevation
    Cylindrical       ///< rows are even in height on a cylinder of radius 1 about y
  } projection = Projection::Equirectangular;
  RigidTransform objectFromCamera;
  /// Edges of the picture: azimuths in radians from -z toward +x, left < right <= left + 2 pi;
  /// elevations in radians (equirectangular, within +-pi/2) or heights (cylindrical), bottom < top.
  PlaneRectangle extent{-3.14159265358979323846, -1.57079632679489661923, 3.14159265358979323846,
                        1.57079632679489661923};
  Size size;
  friend bool operator==(const Panorama&, const Panorama&) = default;
};

using ViewGeometry = std::variant<OrthographicView, SlabView, PinholeCamera, Panorama>;

/// What one group of an object or a capture shows.
struct View {
  std::string name;
  ViewGeometry geometry;
  friend bool operator==(const View&, const View&) = default;
};

Size sizeOf(const ViewGeometry& view);

/// The frame in which the view's reflectance is stored: a slab's own, else the object's.
RigidTransform objectFromGroup(const ViewGeometry& view);

/// The ray of light that a position of the picture sees, leaving the view point (orthographic: a
/// plane far in front of the object).
Ray rayThrough(const ViewGeometry& view, PixelPosition position);

/// Where a point of the object frame is seen; empty for what no position shows (behind a camera).
/// Positions outside the picture are returned.
std::optional<PixelPosition> pixelOf(const ViewGeometry& view, Vector3 point);

/// The depth of a point: z in the group's frame for photographs and slabs (falling away from the
/// eye), distance along the optical axis for pinhole cameras, distance from the view point for
/// panoramas (both growing away from it).
double depthOf(const ViewGeometry& view, Vector3 point);

/// The point of that depth seen at `position`: the inverse of pixelOf and depthOf together.
Vector3 pointAt(const ViewGeometry& view, PixelPosition position, double depth);

/// The off-axis pinhole camera that sees exactly what a slab's view sees, seen from (u, v) in [0,
/// 1].
PinholeCamera pinholeOf(const LightSlab& slab, double u, double v);

/// The slab of one view point that sees what `camera` sees, its window at `distance` from the eye.
/// Its frame is the camera's, moved to the window.
LightSlab slabOf(const PinholeCamera& camera, double distance);

/// A row-major 3x4 matrix that takes (x, y, z, 1) of the object frame to (column * w, row * w, w),
/// w being the depth: K [R | t] of computer vision.
using ProjectionMatrix = std::array<double, 12>;
ProjectionMatrix projectionMatrix(const PinholeCamera& camera);
/// The inverse, whatever the matrix's scale. Throws Error (Fault::Input) for matrices that are
/// singular, not finite or skewed (columns and rows not
/// perpendicular within 1e-6).
PinholeCamera pinholeFromProjection(const ProjectionMatrix& pixelsFromObject, Size size);

/// A row-major 4x4 matrix for OpenGL: clip coordinates, z in [-w, w] for depths from `nearDepth` >
/// 0 to `farDepth`.
std::array<double, 16> clipFromObject(const PinholeCamera& camera, double nearDepth,
                                      double farDepth);

}  // namespace illum
