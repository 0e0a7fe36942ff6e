#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "illum/error.h"
#include "illum/normals.h"
#include "illum/relight.h"
#include "normals/photometric_stereo.h"
#include "object/manifest.h"

namespace illum {
namespace {

// More lights than this say nothing new about a normal.
constexpr std::size_t kMostLights = 160;
constexpr std::size_t kFewestLights = 4;

// Light from below the horizon of the view shows little but what the basis made up there.
constexpr double kLowest = 0.05;

/// Where x is right, y up and z toward the viewer.
RigidTransform viewFromObject(const Object& object, int group) {
  const ViewGeometry& view = object.view(group).geometry;
  if (const auto* slab = std::get_if<SlabView>(&view)) return inverse(slab->slab.objectFromSlab);
  if (const auto* camera = std::get_if<PinholeCamera>(&view))
    return inverse(camera->objectFromCamera);
  if (std::holds_alternative<Panorama>(view))
    throw inputError(object.path(), "a photograph, a slab or a camera", "a panorama");
  return {};
}

struct LightSet {
  std::vector<Direction> inObject, inView;
};

/// Of the object's own lights those in front of the view, spread as evenly as they come: there the
/// reflectance is known best.
LightSet lightsInFront(const Object& object, int group) {
  const RigidTransform toView = viewFromObject(object, group);
  std::vector<Direction> front;
  for (const LightFileEntry& entry : object.manifest().lights) {
    if (toView.direction(entry.light.toLight).z() >= kLowest) front.push_back(entry.light.toLight);
  }
  if (front.size() < kFewestLights) {
    throw inputError(object.path(),
                     fmt::format("at least {} lights in front of the view", kFewestLights),
                     fmt::format("{}", front.size()));
  }
  LightSet set;
  const std::size_t count = std::min(front.size(), kMostLights);
  for (std::size_t i = 0; i < count; ++i) {
    set.inObject.push_back(front[i * front.size() / count]);
    set.inView.push_back(toView.direction(set.inObject.back()));
  }
  return set;
}

/// The view under each light, strip by strip of whole rows.
class Strips {
 public:
  Strips(const Object& object, int group, const LightSet& lights, std::uint64_t memoryBytes)
      : relighter_(object, memoryBytes / 2), size_(object.size(group)), lights_(lights.inObject) {
    for (const Direction& light : lights_)
      prepared_.push_back(relighter_.prepare({{{light, {1, 1, 1}}}, {}, {}}, group));
    const std::uint64_t rowBytes =
        sizeof(float) * static_cast<std::uint64_t>(size_.width) * (lights_.size() + 8);
    rows_ = static_cast<int>(std::clamp<std::uint64_t>(memoryBytes / 2 / rowBytes, 1, 128));
  }

  int rows() const { return rows_; }

  /// brightness[pixel * lights + light], 0 outside the mask.
  void read(int top, int rows, std::vector<float>& brightness) const {
    const Rectangle strip{0, top, size_.width, rows};
    brightness.assign(strip.pixels() * lights_.size(), 0);
    for (std::size_t j = 0; j < prepared_.size(); ++j) {
      const Picture lit = relighter_.relightRegion(prepared_[j], strip);
      for (std::size_t i = 0; i < strip.pixels(); ++i)
        brightness[i * lights_.size() + j] = brightnessOf(lit, i);
    }
  }

 private:
  static float brightnessOf(const Picture& lit, std::size_t pixel) {
    const float* s = lit.samples().data() + pixel * static_cast<std::size_t>(lit.channels());
    const float sum = (s[0] + s[1] + s[2]) / 3;
    if (lit.channels() == 3) return sum;
    return s[3] >= 0.5F ? sum / s[3] : 0;
  }

  Relighter relighter_;
  Size size_;
  std::vector<Direction> lights_;
  std::vector<PreparedLights> prepared_;
  int rows_ = 1;
};

/// What is seen does not face away. (In perspective it may a little, from the picture's middle.)
Vector3 facingViewer(Vector3 n) {
  if (n.z >= 0) return n;
  const double across = std::hypot(n.x, n.y);
  if (across == 0) return {0, 0, 1};
  return {n.x / across, n.y / across, 0};
}

}  // namespace

Picture surfaceNormals(const Object& object, int group, const NormalOptions& options) {
  if (group < 0 || group >= object.groups()) {
    throw Error(Fault::Usage, fmt::format("{}: there is no group of views {}, only 0 to {}",
                                          object.path().string(), group, object.groups() - 1));
  }
  const LightSet lights = lightsInFront(object, group);
  const PhotometricStereo stereo(lights.inView, options.method);
  const Strips strips(object, group, lights, options.memoryBytes);
  const Size size = object.size(group);
  Picture normals(size, 3);
  std::vector<float> brightness;
  for (int top = 0; top < size.height; top += strips.rows()) {
    const int rows = std::min(strips.rows(), size.height - top);
    strips.read(top, rows, brightness);
    tbb::parallel_for(0, rows, [&](int row) {
      std::vector<float> scratch;
      for (int x = 0; x < size.width; ++x) {
        const std::size_t pixel = Size{size.width, row}.pixels() + static_cast<std::size_t>(x);
        const std::span<const float> samples =
            std::span(brightness).subspan(pixel * stereo.lights(), stereo.lights());
        const auto n = stereo.normal(samples, scratch);
        if (!n) continue;
        const Vector3 facing = facingViewer(*n);
        normals.at(x, top + row, 0) = static_cast<float>(facing.x);
        normals.at(x, top + row, 1) = static_cast<float>(facing.y);
        normals.at(x, top + row, 2) = static_cast<float>(facing.z);
      }
    });
  }
  return normals;
}

}  // namespace illum
