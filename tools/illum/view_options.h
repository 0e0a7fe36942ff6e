// The options that say from where an object is seen.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "illum/lumigraph.h"
#include "lumigraph/camera_pose.h"
#include "lumigraph/view_choice.h"

namespace illum::cli {

/// --view, --camera or --path, and how views are made that are none of the object's.
struct ViewOptions {
  std::string view, camera, size, path;
  std::optional<double> focus, elevationDegrees;
  std::optional<int> frames;
  double arcDegrees = 360;
  double aperture = 0;
  int blend = 0;  ///< 0: the default
  bool noDepth = false;

  void addTo(CLI::App& command);
  /// Default: the object's middle view. `up`: of a camera given by numbers. Throws Error
  /// (Fault::Usage) for texts that mean nothing, as readCamera for a file.
  ViewChoice choice(const Object& object, Direction up) const;
  /// What --path leads along, picture by picture. Throws as choice() and readCameraPath.
  std::vector<ViewGeometry> pathGeometries(const Object& object, Direction up) const;
  /// For `choice`. Throws Error (Fault::Usage) for options that have no meaning there.
  SynthesisOptions synthesis(const Object& object, const ViewChoice& choice) const;

 private:
  void addPathOptions(CLI::App& command);
  CameraPose pose(Direction up) const;
  Size pictureSize(const Object& object) const;
  ViewGeometry geometry(const CameraPose& pose, const Object& object) const;
  LookAt orbitStart(const Object& object, Direction up) const;
  std::vector<CameraPose> pathPoses(const Object& object, Direction up) const;
  Plane focalPlane(const Object& object, const ViewChoice& choice) const;
};

}  // namespace illum::cli
