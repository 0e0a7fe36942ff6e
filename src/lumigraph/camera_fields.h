// The fields of cameras that people write, for json/visitors.h. Full cameras and panoramas are
// described as those of views are (object/view_fields.h).
#pragma once

#include "lumigraph/camera_pose.h"
#include "object/view_fields.h"

namespace illum::fields {

inline constexpr std::uint64_t kMaxCameraBytes = 16 << 20;  // of a file

/// In the order of CameraPose's alternatives.
enum class PoseKind { Look, Camera, Panorama };

template <typename Visitor>
void describe(Visitor& v, LookAt& pose) {
  v.triple("eye", coordinatesOf(pose.eye), -kHuge, kHuge);
  v.triple("target", coordinatesOf(pose.target), -kHuge, kHuge);
  v.triple(optional("up"), coordinatesOf(pose.up), -kHuge, kHuge);
  v.number(optional("fieldOfViewDegrees"), pose.fieldOfViewDegrees, 0.001, 179);
}

template <typename Visitor>
void describe(Visitor& v, CameraPose& pose) {
  auto kind = static_cast<PoseKind>(pose.index());
  v.choice("kind", kind,
           Choices<PoseKind>{{PoseKind::Look, "look"},
                             {PoseKind::Camera, "camera"},
                             {PoseKind::Panorama, "panorama"}});
  switch (kind) {
    case PoseKind::Look:
      if (!std::holds_alternative<LookAt>(pose)) pose = LookAt();
      describe(v, std::get<LookAt>(pose));
      break;
    case PoseKind::Camera:
      if (!std::holds_alternative<PinholeCamera>(pose)) pose = PinholeCamera();
      v.record("camera", std::get<PinholeCamera>(pose));
      break;
    case PoseKind::Panorama:
      if (!std::holds_alternative<Panorama>(pose)) pose = Panorama();
      v.record("panorama", std::get<Panorama>(pose));
      break;
  }
}

/// Reads a record as fields of a whole file: what is wrong is said with the file's name.
template <typename Record>
Record recordFromText(std::string_view json, const std::string& source) {
  try {
    if (json.size() > kMaxCameraBytes) {
      throw Error(Fault::Input,
                  fmt::format("expected at most {} bytes, found {}", kMaxCameraBytes, json.size()));
    }
    const Json root = jsonFromText(json);
    const FieldPath top;
    Record record;
    Reader reader(root, top, Unknown::Refuse);
    describe(reader, record);
    reader.finish();
    return record;
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace illum::fields
