#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>

#include "capture/camera_list.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::size_t kMaxImages = 65536;
constexpr double kMaxNumber = 1e9;

// Lines of a file, counted, without line ends.
class Lines {
 public:
  Lines(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  /// The next line, empty or not. False at the end.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return true;
  }
  /// The next line that is neither empty nor a comment.
  bool nextRecord(std::string_view& line) {
    while (next(line)) {
      const std::size_t first = line.find_first_not_of(" \t");
      if (first != std::string_view::npos && line[first] != '#') return true;
    }
    return false;
  }
  Error wrong(std::string_view expected, std::string_view found) const {
    return inputError(fmt::format("{}:{}", name_, number_), expected,
                      fmt::format("'{}'", found.substr(0, 80)));
  }

 private:
  std::string_view rest_;
  const std::string& name_;
  std::size_t number_ = 0;
};

// Words of one line.
class Words {
 public:
  Words(std::string_view line, const Lines& lines) : line_(line), rest_(line), lines_(lines) {}

  std::string_view word() {
    const std::size_t begin = rest_.find_first_not_of(" \t");
    if (begin == std::string_view::npos) throw lines_.wrong("more words in the line", line_);
    const std::size_t end = rest_.find_first_of(" \t", begin);
    const std::string_view found = rest_.substr(begin, end - begin);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end);
    return found;
  }
  double number() {
    const std::string_view text = word();
    double value = NAN;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size() ||
        !(std::abs(value) <= kMaxNumber)) {
      throw lines_.wrong("a number", text);
    }
    return value;
  }
  /// All that is left: names may hold blanks.
  std::string_view rest() {
    const std::size_t begin = rest_.find_first_not_of(" \t");
    if (begin == std::string_view::npos) throw lines_.wrong("a name at the end of the line", line_);
    return rest_.substr(begin, rest_.find_last_not_of(" \t") - begin + 1);
  }

 private:
  std::string_view line_, rest_;
  const Lines& lines_;
};

PinholeCamera cameraOf(std::string_view model, Words& words, const Lines& lines) {
  if (model != "PINHOLE" && model != "SIMPLE_PINHOLE") {
    throw lines.wrong("a camera without distortion, PINHOLE or SIMPLE_PINHOLE", model);
  }
  const auto pixels = [&] {
    constexpr int kMost = 1 << 20;
    const double count = words.number();
    if (!(count >= 1 && count <= kMost && count == std::floor(count))) {
      throw lines.wrong(fmt::format("a size from 1 to {} pixels", kMost), fmt::format("{}", count));
    }
    return static_cast<int>(count);
  };
  PinholeCamera camera;
  camera.size.width = pixels();
  camera.size.height = pixels();
  camera.focalX = words.number();
  camera.focalY = model == "PINHOLE" ? words.number() : camera.focalX;
  camera.centre.x = words.number();
  camera.centre.y = words.number();
  if (!(camera.focalX > 0 && camera.focalY > 0)) {
    throw lines.wrong("focal lengths above 0", fmt::format("{} {}", camera.focalX, camera.focalY));
  }
  return camera;
}

// COLMAP: a world point p is at R p + t of the camera's frame, x right, y down, z ahead.
RigidTransform poseOf(Words& words, const Lines& lines) {
  double w = words.number(), x = words.number(), y = words.number(), z = words.number();
  const double norm = std::sqrt(w * w + x * x + y * y + z * z);
  if (!(norm > 1e-6)) throw lines.wrong("a quaternion that is not zero", fmt::format("{}", norm));
  w /= norm, x /= norm, y /= norm, z /= norm;
  RigidTransform theirsFromWorld;
  theirsFromWorld.rotation = {
      1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
      2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
      2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  theirsFromWorld.translation.x = words.number();
  theirsFromWorld.translation.y = words.number();
  theirsFromWorld.translation.z = words.number();
  RigidTransform theirsFromOurs;
  theirsFromOurs.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  return inverse(theirsFromWorld) * theirsFromOurs;
}

std::map<std::string, PinholeCamera, std::less<>> camerasOf(const ColmapText& text) {
  Lines lines(text.cameras, text.camerasName);
  std::map<std::string, PinholeCamera, std::less<>> cameras;
  std::string_view line;
  while (lines.nextRecord(line)) {
    Words words(line, lines);
    const std::string id(words.word());
    const std::string_view model = words.word();
    if (!cameras.emplace(id, cameraOf(model, words, lines)).second) {
      throw lines.wrong("each camera once", id);
    }
  }
  return cameras;
}

}  // namespace

CaptureFile captureFromColmap(const ColmapText& text) {
  const auto cameras = camerasOf(text);
  Lines lines(text.images, text.imagesName);
  CaptureFile capture;
  std::string_view line;
  while (lines.nextRecord(line)) {
    Words words(line, lines);
    words.word();  // the image's number, which nothing here refers to
    const RigidTransform pose = poseOf(words, lines);
    const std::string_view id = words.word();
    const auto camera = cameras.find(id);
    if (camera == cameras.end()) throw lines.wrong("a camera of cameras.txt", id);
    if (capture.views.size() >= kMaxImages) {
      throw lines.wrong(fmt::format("at most {} images", kMaxImages), line);
    }
    PinholeCamera posed = camera->second;
    posed.objectFromCamera = pose;
    const std::string name(words.rest());
    const std::string folder = text.picturesFolder.empty() ? "" : text.picturesFolder + "/";
    capture.views.push_back({{name, posed}, {}, {}, {}, {folder + name}});
    lines.next(line);  // the points seen in it, perhaps none
  }
  if (capture.views.empty()) throw lines.wrong("at least one image", "");
  const auto& first = std::get<PinholeCamera>(capture.views.front().view.geometry);
  capture.lights = {{"light", {first.objectFromCamera.direction(Direction()), {1, 1, 1}}, 0}};
  try {
    checkCaptureFile(capture);
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", text.imagesName, error.what()));
  }
  return capture;
}

}  // namespace illum
