#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "capture/camera_list.h"
#include "illum/error.h"
#include "json/visitors.h"
#include "object/view_record.h"

namespace illum {
namespace {

using fields::FieldPath;
using fields::Json;

constexpr std::size_t kMaxFrames = 65536;
constexpr double kMaxCoordinate = 1e9;
// Of the entries of a rotation, which text rounds.
constexpr double kRotationTolerance = 1e-3;

struct Frame {
  std::string file, mask;
  PinholeCamera camera;
  std::optional<Vector3> light;
};

// One frame, whose fields stand in place of those of the whole file.
class FrameReader {
 public:
  FrameReader(const Json& root, const Json& frame, const FieldPath& path,
              const SizeOfPicture& sizeOfPicture)
      : root_(root), frame_(frame), path_(path), sizeOfPicture_(sizeOfPicture) {}

  Frame read() const {
    if (!frame_.is_object()) throw path_.wrong("an object", fields::shown(frame_));
    refuseDistortion();
    Frame frame;
    frame.file = fileName("file_path").value_or("");
    if (frame.file.empty()) throw path_.wrong("a 'file_path'", "none");
    if (std::filesystem::path(frame.file).extension().empty()) frame.file += ".png";
    frame.mask = fileName("mask_path").value_or("");
    frame.camera = intrinsics(frame.file);
    frame.camera.objectFromCamera = pose();
    for (const char* name : {"pl_pos", "light_position"}) {
      if (frame_.contains(name)) frame.light = position(name);
    }
    return frame;
  }

 private:
  const Json* find(const char* name) const {
    if (const auto own = frame_.find(name); own != frame_.end()) return &*own;
    if (const auto all = root_.find(name); all != root_.end()) return &*all;
    return nullptr;
  }
  double numberOf(const Json& value, const FieldPath& path) const {
    const double number = value.is_number() ? value.get<double>() : NAN;
    if (!(std::abs(number) <= kMaxCoordinate)) throw path.wrong("a number", fields::shown(value));
    return number;
  }
  std::optional<double> number(const char* name) const {
    const Json* value = find(name);
    if (value == nullptr) return std::nullopt;
    return numberOf(*value, FieldPath(&path_, name));
  }

  void refuseDistortion() const {
    const Json* model = find("camera_model");
    if (model != nullptr && *model != "OPENCV" && *model != "PINHOLE" &&
        *model != "SIMPLE_PINHOLE" && *model != "SIMPLE_RADIAL" && *model != "RADIAL") {
      throw FieldPath(&path_, "camera_model")
          .wrong("a camera without distortion", fields::shown(*model));
    }
    for (const char* name : {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"}) {
      if (number(name).value_or(0) == 0) continue;
      throw FieldPath(&path_, name)
          .wrong("photographs without lens distortion", fmt::format("{}", *number(name)));
    }
  }

  std::optional<std::string> fileName(const char* name) const {
    const auto value = frame_.find(name);
    if (value == frame_.end() || value->is_null()) return std::nullopt;
    if (!value->is_string())
      throw FieldPath(&path_, name).wrong("a file name", fields::shown(*value));
    const std::string text = *value;
    return text.starts_with("./") ? text.substr(2) : text;
  }

  int pixels(double number, const char* name) const {
    constexpr int kMost = 1 << 20;
    if (number >= 1 && number <= kMost && number == std::floor(number)) {
      return static_cast<int>(number);
    }
    throw FieldPath(&path_, name)
        .wrong(fmt::format("a whole number from 1 to {}", kMost), fmt::format("{}", number));
  }

  PinholeCamera intrinsics(const std::string& file) const {
    PinholeCamera camera;
    const auto width = number("w"), height = number("h");
    if (width && height) {
      camera.size = {pixels(*width, "w"), pixels(*height, "h")};
    } else {
      camera.size = sizeOfPicture_(file);
    }
    camera.centre = {number("cx").value_or(0.5 * camera.size.width),
                     number("cy").value_or(0.5 * camera.size.height)};
    const auto focal = [&](const char* name, const char* angleName, int across) {
      auto length = number(name);
      if (const auto angle = number(angleName); !length && angle) {
        length = 0.5 * across / std::tan(0.5 * *angle);
      }
      return length;
    };
    const auto x = focal("fl_x", "camera_angle_x", camera.size.width);
    const auto y = focal("fl_y", "camera_angle_y", camera.size.height);
    if (!x && !y) throw path_.wrong("'fl_x' or 'camera_angle_x'", "none");
    camera.focalX = x.value_or(*(x ? x : y));
    camera.focalY = y.value_or(camera.focalX);
    const auto isLength = [](double value) { return value > 0 && value <= kMaxCoordinate; };
    if (!isLength(camera.focalX) || !isLength(camera.focalY)) {
      throw path_.wrong(fmt::format("focal lengths above 0 and at most {}", kMaxCoordinate),
                        fmt::format("{} and {}", camera.focalX, camera.focalY));
    }
    return camera;
  }

  // Camera to world, x right, y up, looking along -z: as ours.
  RigidTransform pose() const {
    const FieldPath path(&path_, "transform_matrix");
    const auto matrix = frame_.find("transform_matrix");
    if (matrix == frame_.end() || !matrix->is_array() || matrix->size() < 3 || matrix->size() > 4) {
      throw path.wrong("4 rows of 4 numbers",
                       matrix == frame_.end() ? "none" : fields::shown(*matrix));
    }
    RigidTransform transform;
    std::array<double, 3> translation{};
    for (std::size_t r = 0; r < 3; ++r) {
      const Json& row = (*matrix)[r];
      const FieldPath rowPath(&path, r);
      if (!row.is_array() || row.size() != 4) throw rowPath.wrong("4 numbers", fields::shown(row));
      for (std::size_t c = 0; c < 3; ++c) transform.rotation[3 * r + c] = numberOf(row[c], rowPath);
      translation[r] = numberOf(row[3], rowPath);
    }
    transform.translation = {translation[0], translation[1], translation[2]};
    orthonormalise(transform, path);
    return transform;
  }

  static void orthonormalise(RigidTransform& transform, const FieldPath& path) {
    auto& r = transform.rotation;
    const auto column = [&](std::size_t c) { return Vector3{r[c], r[3 + c], r[6 + c]}; };
    const auto unit = [](Vector3 v) { return (1 / length(v)) * v; };
    const Vector3 x = unit(column(0));
    const Vector3 y = unit(column(1) - dot(x, column(1)) * x);
    const Vector3 z = cross(x, y);
    const double off = length(x - column(0)) + length(y - column(1)) + length(z - column(2));
    if (!(off < kRotationTolerance)) {
      throw path.wrong("a rotation and a translation", "a matrix that scales, skews or mirrors");
    }
    r = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  }

  Vector3 position(const char* name) const {
    const FieldPath path(&path_, name);
    const Json& value = frame_[name];
    if (!value.is_array() || value.size() != 3) throw path.wrong("3 numbers", fields::shown(value));
    const Vector3 p{numberOf(value[0], path), numberOf(value[1], path), numberOf(value[2], path)};
    if (!(length(p) > 0)) throw path.wrong("a light away from the origin", "one in it");
    return p;
  }

  const Json& root_;
  const Json& frame_;
  const FieldPath& path_;
  const SizeOfPicture& sizeOfPicture_;
};

std::vector<Frame> framesOf(const Json& root, const SizeOfPicture& sizeOfPicture) {
  const FieldPath top;
  const FieldPath path(&top, "frames");
  const auto frames = root.is_object() ? root.find("frames") : root.end();
  if (frames == root.end() || !frames->is_array()) {
    throw path.wrong("a list", frames == root.end() ? "none" : fields::shown(*frames));
  }
  fields::checkCount(path, frames->size(), 1, kMaxFrames);
  std::vector<Frame> result;
  for (std::size_t i = 0; i < frames->size(); ++i) {
    const FieldPath framePath(&path, i);
    result.push_back(FrameReader(root, (*frames)[i], framePath, sizeOfPicture).read());
    if (result.back().light.has_value() != result.front().light.has_value()) {
      throw framePath.wrong("positions of lights in all frames or in none", "some");
    }
  }
  return result;
}

// A position or a camera as a key.
using Numbers = std::vector<double>;
Numbers numbersOf(Vector3 p) {
  return {p.x, p.y, p.z};
}
Numbers numbersOf(const PinholeCamera& camera) {
  Numbers numbers(camera.objectFromCamera.rotation.begin(), camera.objectFromCamera.rotation.end());
  const Vector3 at = camera.objectFromCamera.translation;
  numbers.insert(numbers.end(),
                 {at.x, at.y, at.z, camera.focalX, camera.focalY, camera.centre.x, camera.centre.y,
                  static_cast<double>(camera.size.width), static_cast<double>(camera.size.height)});
  return numbers;
}

// Lights near an object are brighter: what was photographed is divided by that.
std::vector<LightFileEntry> entriesOf(const std::vector<Vector3>& lights) {
  double meanSquare = 0;
  for (const Vector3& p : lights) meanSquare += dot(p, p) / static_cast<double>(lights.size());
  std::vector<LightFileEntry> entries;
  for (const Vector3& p : lights) {
    const auto intensity = static_cast<float>(meanSquare / dot(p, p));
    entries.push_back({fmt::format("light_{:04}", entries.size()),
                       {Direction::fromVector(p), {intensity, intensity, intensity}},
                       0});
  }
  return entries;
}

// One light, and a view for each frame.
CaptureFile captureUnderOneLight(const std::vector<Frame>& frames) {
  CaptureFile capture;
  const RigidTransform& first = frames.front().camera.objectFromCamera;
  capture.lights = {{"light", {first.direction(Direction()), {1, 1, 1}}, 0}};
  for (const Frame& frame : frames) {
    capture.views.push_back({{frame.file, frame.camera}, {}, frame.mask, {}, {frame.file}});
  }
  return capture;
}

// Sorts frames into views, each under every light.
CaptureFile captureUnderLights(const std::vector<Frame>& frames) {
  std::map<Numbers, std::size_t> lightOf, viewOf;
  std::vector<Vector3> lights;
  for (const Frame& frame : frames) {
    if (lightOf.emplace(numbersOf(*frame.light), lights.size()).second) {
      lights.push_back(*frame.light);
    }
  }
  CaptureFile capture;
  capture.lights = entriesOf(lights);
  for (const Frame& frame : frames) {
    const auto [view, isNew] = viewOf.emplace(numbersOf(frame.camera), capture.views.size());
    if (isNew) capture.views.push_back({{frame.file, frame.camera}, {}, frame.mask, {}, {}});
    auto& files = capture.views[view->second].files;
    const std::size_t light = lightOf.at(numbersOf(*frame.light));
    files.resize(std::max(files.size(), light + 1));
    if (!files[light].empty()) {
      throw Error(
          Fault::Input,
          fmt::format("field 'frames': expected one picture of a camera under a light, found "
                      "'{}' and '{}'",
                      files[light], frame.file));
    }
    files[light] = frame.file;
  }
  for (const CaptureFileView& view : capture.views) {
    if (view.files.size() == lights.size() && !std::ranges::count(view.files, std::string())) {
      continue;
    }
    throw Error(Fault::Input,
                fmt::format("field 'frames': expected every camera under each of {} lights, found "
                            "'{}' under some of them",
                            lights.size(), view.view.name));
  }
  return capture;
}

}  // namespace

CaptureFile captureFromTransforms(std::string_view json, const std::string& source,
                                  const SizeOfPicture& sizeOfPicture) {
  try {
    const std::vector<Frame> frames = framesOf(fields::jsonFromText(json), sizeOfPicture);
    CaptureFile capture =
        frames.front().light ? captureUnderLights(frames) : captureUnderOneLight(frames);
    checkCaptureFile(capture);
    return capture;
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace illum
