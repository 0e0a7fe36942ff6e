#include "lumigraph/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/files.h"
#include "illum/error.h"
#include "json/visitors.h"
#include "lumigraph/camera_fields.h"
#include "lumigraph/default_focus.h"
#include "lumigraph/view_projector.h"

namespace illum {
namespace fields {

constexpr int kPathVersion = 1;
constexpr std::size_t kMaxCameras = 65536;

struct PathRecord {
  int version = kPathVersion;
  CameraPath path;
};

template <typename Visitor>
void describe(Visitor& v, PathRecord& file) {
  v.integer("path", file.version, kPathVersion, kPathVersion);
  v.integer(optional("frames"), file.path.frames, 0, kMaxFrames);
  v.flag(optional("closed"), file.path.closed);
  v.records("cameras", file.path.cameras, 1, kMaxCameras);
}

}  // namespace fields

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastField = 0.001, kMostField = 179;  // degrees, where a spline swings beyond

// Between b and c, whose neighbours are a and d (E. Catmull, R. Rom, "A class of local
// interpolating splines", 1974, with tangents (c - a) / 2 and (d - b) / 2).
template <typename Value>
Value catmullRom(Value a, Value b, Value c, Value d, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return 0.5 * (2 * t3 - 3 * t2 + 1) * (b + b) + 0.5 * (3 * t2 - 2 * t3) * (c + c) +
         0.5 * (t3 - 2 * t2 + t) * (c - a) + 0.5 * (t3 - t2) * (d - b);
}

class Spline {
 public:
  explicit Spline(const CameraPath& path) : closed_(path.closed) {
    for (std::size_t i = 0; i < path.cameras.size(); ++i) {
      const auto* look = std::get_if<LookAt>(&path.cameras[i]);
      if (look == nullptr) {
        throw Error(Fault::Input, fmt::format("field 'cameras[{}].kind': expected 'look' where "
                                              "'frames' are to be interpolated, found another",
                                              i));
      }
      keys_.push_back(*look);
    }
  }

  // In steps from one camera to the next.
  double length() const { return static_cast<double>(keys_.size()) - (closed_ ? 0 : 1); }

  LookAt at(double position) const {
    const auto i = static_cast<std::ptrdiff_t>(std::floor(position));
    const double t = position - static_cast<double>(i);
    const auto along = [&](auto member) {
      const auto key = [&](std::ptrdiff_t k) { return valueAt(k, member); };
      return catmullRom(key(i - 1), key(i), key(i + 1), key(i + 2), t);
    };
    LookAt look{along(&LookAt::eye), along(&LookAt::target), along(&LookAt::up),
                along(&LookAt::fieldOfViewDegrees)};
    look.fieldOfViewDegrees = std::clamp(look.fieldOfViewDegrees, kLeastField, kMostField);
    return look;
  }

 private:
  // Beyond the ends of an open path it goes on straight.
  template <typename Value>
  Value valueAt(std::ptrdiff_t k, Value LookAt::*member) const {
    const auto count = static_cast<std::ptrdiff_t>(keys_.size());
    const auto key = [&](std::ptrdiff_t i) { return keys_[static_cast<std::size_t>(i)].*member; };
    if (closed_) return key(((k % count) + count) % count);
    if (count == 1) return key(0);
    if (k < 0) return 2.0 * key(0) - key(1);
    if (k >= count) return 2.0 * key(count - 1) - key(count - 2);
    return key(k);
  }

  bool closed_;
  std::vector<LookAt> keys_;
};

// Azimuth of each frame from the start, in radians.
std::vector<double> azimuths(const OrbitOptions& options) {
  if (options.frames < 1 || options.frames > kMaxFrames) {
    throw Error(Fault::Usage,
                fmt::format("expected 1 to {} frames, found {}", kMaxFrames, options.frames));
  }
  if (!(options.arcDegrees > 0 && options.arcDegrees <= 360)) {
    throw Error(Fault::Usage, fmt::format("expected an arc above 0 and up to 360 degrees, found {}",
                                          options.arcDegrees));
  }
  std::vector<double> azimuths;
  const double arc = options.arcDegrees * kDegree;
  for (int k = 0; k < options.frames; ++k) {
    const bool whole = options.arcDegrees == 360 || options.frames == 1;
    azimuths.push_back(whole ? arc * k / options.frames
                             : arc * (static_cast<double>(k) / (options.frames - 1) - 0.5));
  }
  return azimuths;
}

// `arm` at another elevation above the plane perpendicular to `up`, of the same length.
Vector3 raised(Vector3 arm, Direction up, const std::optional<double>& elevationDegrees) {
  const Vector3 level = arm - dot(arm, up.vector()) * up.vector();
  const double reach = length(arm);
  if (!(length(level) > 1e-9 * reach) || !std::isfinite(reach)) {
    throw Error(Fault::Usage,
                "expected an orbit that begins beside its axis, found its start above or below");
  }
  if (!elevationDegrees) return arm;
  if (!(std::abs(*elevationDegrees) < 90)) {
    throw Error(Fault::Usage, fmt::format("expected an elevation between -90 and 90 degrees, found "
                                          "{}",
                                          *elevationDegrees));
  }
  const double elevation = *elevationDegrees * kDegree;
  return (reach * std::cos(elevation) / length(level)) * level +
         reach * std::sin(elevation) * up.vector();
}

}  // namespace

CameraPath cameraPathFromText(std::string_view json, const std::string& source) {
  CameraPath path = fields::recordFromText<fields::PathRecord>(json, source).path;
  try {
    for (std::size_t i = 0; i < path.cameras.size(); ++i) {
      try {
        checkPose(path.cameras[i]);
      } catch (const Error& error) {
        throw Error(error.fault(), fmt::format("field 'cameras[{}]': {}", i, error.what()));
      }
    }
    if (path.closed && path.frames == 0)
      throw Error(Fault::Input, "field 'closed': expected 'frames' beside it, found none");
    if (path.frames > 0) Spline{path};
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
  return path;
}

CameraPath readCameraPath(const std::filesystem::path& file) {
  return cameraPathFromText(readTextFile(file, fields::kMaxCameraBytes), file.string());
}

std::vector<CameraPose> framesOf(const CameraPath& path) {
  if (path.frames == 0) return path.cameras;
  const Spline spline(path);
  // A closed path does not come back to its first frame at the end: films repeat.
  const int steps = std::max(1, path.closed ? path.frames : path.frames - 1);
  std::vector<CameraPose> frames;
  for (int k = 0; k < path.frames; ++k) {
    frames.emplace_back(spline.at(spline.length() * k / steps));
    try {
      checkPose(frames.back());
    } catch (const Error& error) {
      throw Error(error.fault(), fmt::format("frame {} of the path: {}", k, error.what()));
    }
  }
  return frames;
}

std::vector<CameraPose> orbit(const LookAt& start, const OrbitOptions& options) {
  checkPose(start);
  const Direction up = Direction::fromVector(start.up);
  const Vector3 arm = raised(start.eye - start.target, up, options.elevationDegrees);
  std::vector<CameraPose> frames;
  for (const double azimuth : azimuths(options)) {
    LookAt look = start;
    look.eye = start.target + rotationAbout(up, azimuth).vector(arm);
    frames.emplace_back(look);
  }
  return frames;
}

std::vector<CameraPose> turnRound(const LookAt& start, const OrbitOptions& options) {
  LookAt outward = start;
  std::swap(outward.eye, outward.target);
  std::vector<CameraPose> frames = orbit(outward, options);
  for (CameraPose& pose : frames) {
    auto& look = std::get<LookAt>(pose);
    std::swap(look.eye, look.target);
  }
  return frames;
}

LookAt lookOf(const ViewChoice& choice, std::span<const View> views, Vector3 up) {
  LookAt look;
  look.up = up;
  look.target = middleOf(views);
  const ViewProjector view(choice.geometry);
  look.eye = view.eye();
  const Size size = view.size();
  if (std::holds_alternative<OrthographicView>(choice.geometry)) {
    constexpr double kAway = 4;  // from a photograph, whose longer side is 2
    look.eye = {0, 0, kAway};
    const double halfHeight = static_cast<double>(size.height) / std::max(size.width, size.height);
    look.fieldOfViewDegrees = 2 * std::atan(halfHeight / kAway) / kDegree;
    return look;
  }
  if (std::holds_alternative<Panorama>(choice.geometry)) {
    look.target = look.eye + view.axis();
    look.fieldOfViewDegrees = 60;
    return look;
  }
  const auto* camera = std::get_if<PinholeCamera>(&choice.geometry);
  const double focal =
      camera != nullptr ? camera->focalY : pinholeOf(choice.slab.value(), 0.5, 0.5).focalY;
  look.fieldOfViewDegrees = 2 * std::atan(0.5 * size.height / focal) / kDegree;
  return look;
}

}  // namespace illum
