#include "lumigraph/camera_pose.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/files.h"
#include "illum/error.h"
#include "illum/lumigraph.h"
#include "json/visitors.h"
#include "lumigraph/camera_fields.h"

namespace illum {
namespace {

PinholeCamera pinholeOfLook(const LookAt& look, Size size) {
  return cameraLookingAt(look.eye, look.target, look.fieldOfViewDegrees, size, look.up);
}

}  // namespace

PinholeCamera cameraLookingAt(Vector3 eye, Vector3 target, double fieldOfViewDegrees, Size size,
                              Vector3 up) {
  PinholeCamera camera;
  camera.objectFromCamera = lookAt(eye, target, up);
  const double halfAngle = fieldOfViewDegrees / 2 * std::numbers::pi / 180;
  camera.focalX = camera.focalY = 0.5 * size.height / std::tan(halfAngle);
  camera.centre = {0.5 * size.width, 0.5 * size.height};
  camera.size = size;
  return camera;
}

void checkPose(const CameraPose& pose) {
  if (const auto* look = std::get_if<LookAt>(&pose)) {
    if (!(look->fieldOfViewDegrees > 0 && look->fieldOfViewDegrees < 180)) {
      throw Error(Fault::Input, fmt::format("expected a field of view above 0 and below 180 "
                                            "degrees, found {}",
                                            look->fieldOfViewDegrees));
    }
    checkGeometry(pinholeOfLook(*look, {1, 1}));
    return;
  }
  checkGeometry(geometryOf(pose, {1, 1}));
}

ViewGeometry geometryOf(const CameraPose& pose, Size size) {
  if (const auto* look = std::get_if<LookAt>(&pose)) return pinholeOfLook(*look, size);
  if (const auto* camera = std::get_if<PinholeCamera>(&pose)) return *camera;
  return std::get<Panorama>(pose);
}

CameraPose cameraFromText(std::string_view json, const std::string& source) {
  const auto pose = fields::recordFromText<CameraPose>(json, source);
  try {
    checkPose(pose);
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
  return pose;
}

CameraPose readCamera(const std::filesystem::path& file) {
  return cameraFromText(readTextFile(file, fields::kMaxCameraBytes), file.string());
}

}  // namespace illum
