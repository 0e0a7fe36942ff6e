// Ways of a camera, frame by frame (docs/guide/views.md).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lumigraph/camera_pose.h"
#include "lumigraph/view_choice.h"

namespace illum {

inline constexpr int kMaxFrames = 100'000;

/// Cameras on a way, as a file has them.
struct CameraPath {
  int frames = 0;       ///< 0: the cameras themselves; else so many, spread between them
  bool closed = false;  ///< from the last camera back to the first
  std::vector<CameraPose> cameras;
};

/// Untrusted input is safe; fields that are not known are refused. Throws Error naming `source` and
/// the field.
CameraPath cameraPathFromText(std::string_view json, const std::string& source);
CameraPath readCameraPath(const std::filesystem::path& file);

/// With `frames`, cameras of the kind LookAt on a uniform Catmull-Rom spline through the path's
/// own, as many frames from each to the next. Throws Error (Fault::Input) where cameras of other
/// kinds are to be interpolated, and where the spline leads through what is no camera.
std::vector<CameraPose> framesOf(const CameraPath& path);

struct OrbitOptions {
  int frames = 36;
  double arcDegrees = 360;                 ///< a whole turn, or to both sides of the start
  std::optional<double> elevationDegrees;  ///< above the horizon; empty: that of the start
};

/// Round the target of `start` about its `up`, counterclockwise seen from above; a whole turn
/// begins at `start`. Throws Error (Fault::Usage) for options out of range and a start straight
/// above or below its target.
std::vector<CameraPose> orbit(const LookAt& start, const OrbitOptions& options);
/// The same, but the eye stays and the target goes round.
std::vector<CameraPose> turnRound(const LookAt& start, const OrbitOptions& options);

/// The camera that sees about what `choice` sees, looking at what stands in the middle before all
/// views.
LookAt lookOf(const ViewChoice& choice, std::span<const View> views, Vector3 up);

}  // namespace illum
