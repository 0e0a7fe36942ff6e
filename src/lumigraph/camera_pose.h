// Cameras as people write them: on the command line and in small files of JSON
// (docs/guide/views.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "illum/camera.h"

namespace illum {

/// From where to where; the picture's size is chosen elsewhere.
struct LookAt {
  Vector3 eye, target, up{0, 1, 0};
  double fieldOfViewDegrees = 40;  ///< from the bottom of the picture to its top
  friend bool operator==(const LookAt&, const LookAt&) = default;
};

using CameraPose = std::variant<LookAt, PinholeCamera, Panorama>;

/// Throws Error (Fault::Input), naming the field, for numbers that are no camera.
void checkPose(const CameraPose& pose);

/// With pictures of `size` where the pose does not say how large they are. The pose must be one
/// that checkPose accepts.
ViewGeometry geometryOf(const CameraPose& pose, Size size);

/// One camera. Fields that are not known are refused. Untrusted input is safe. Throws Error naming
/// `source` and the field.
CameraPose cameraFromText(std::string_view json, const std::string& source);
CameraPose readCamera(const std::filesystem::path& file);

}  // namespace illum
