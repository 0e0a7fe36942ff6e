// A capture as people describe it, before the size of the scene is known: what scene files and
// built-in scenes say, what the command line changes of it, and how it becomes a CaptureSetup.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "illum/camera.h"
#include "scene/light_grid.h"
#include "scene/scene.h"

namespace illum {

/// A light slab. What is not given follows from the scene, seen from `toward`: the window stands
/// upright through the middle of the scene's bounds (so the near half of the object reaches through
/// it) and holds what any of its view points can see of the scene.
struct SlabPlan {
  std::string name = "slab";
  int uCount = 5, vCount = 5;
  std::optional<RigidTransform> objectFromSlab;  ///< else by `toward` and `up`
  Vector3 toward{0, 0, 1};                       ///< from the object to the view points
  Vector3 up{0, 1, 0};
  std::optional<double> distance;    ///< of the view points; else 4 radii of the bounds' sphere
  std::optional<PlaneRectangle> uv;  ///< else by the two angles
  double uRadians = 0.5, vRadians = 0.5;  ///< between the outermost view points, in (0, pi)
  std::optional<PlaneRectangle> st;
  std::optional<Size> size;  ///< pixels; else by `longerSide` and the shape of the window
  int longerSide = 256;
};

/// Several slabs around the object, the first in front, the next ones to its right (+x): each
/// looks at the middle of the bounds, all windows are alike.
struct TurnPlan {
  int slabs = 8;
  double elevationRadians = 0;  ///< of the view points above the object's equator, within +-pi/2
  SlabPlan slab;                ///< `toward` and objectFromSlab are not looked at
  bool joined = true;           ///< uRadians so that neighbouring slabs' view points meet
};

/// One photograph-like view along -z; the object has to be about the origin, within +-1.
struct PhotographPlan {
  std::string name = "photograph";
  Size size{256, 256};
};

/// A view that is as it is: pinhole cameras and panoramas.
struct FixedPlan {
  View view;
};

/// A camera looking at a target, placed by the scene where nothing else is said.
struct CameraPlan {
  std::string name = "camera";
  std::optional<Vector3> eye, target;  ///< else in front of the middle of the bounds; that middle
  Vector3 up{0, 1, 0};
  double fieldOfViewRadians = 0.6;  ///< across the picture's longer side, in (0, pi)
  Size size{256, 256};
};

using ViewPlan = std::variant<SlabPlan, TurnPlan, PhotographPlan, CameraPlan, FixedPlan>;

struct PolarGrid {
  int thetaCount = 20, phiCount = 20;
};
struct FibonacciGrid {
  int count = 64;
};

struct LightPlan {
  std::variant<FibonacciGrid, PolarGrid, std::vector<LightFileEntry>> lights;
  LightRegion region = LightRegion::Hemisphere;
  std::optional<double> radiusRadians;  ///< else half the lights' spacing
};

struct CapturePlan {
  std::vector<ViewPlan> views{SlabPlan{}};
  LightPlan lights;
  int samplesPerPixel = 4, bounces = 1;
  double filterRadius = 0.75;
  std::uint64_t seed = 0;
};

/// What the command line asks for in place of what a plan says. Counts of view points concern
/// slabs, `longerSide` every view; a number of lights makes a Fibonacci grid.
struct CaptureOverrides {
  std::optional<int> uCount, vCount, longerSide, lights, samplesPerPixel, bounces;
  std::optional<double> lightRadiusRadians;
  std::optional<std::uint64_t> seed;
};
void apply(const CaptureOverrides& overrides, CapturePlan& plan);

/// Throws Error for what makes no capture: no views, no lights, counts and sizes out of range, an
/// empty scene.
CaptureSetup captureSetup(const CapturePlan& plan, const Scene& scene);

}  // namespace illum
