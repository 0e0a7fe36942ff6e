#include "illum/relight.h"

#include <fmt/format.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "illum/error.h"
#include "object/manifest.h"
#include "relight/environment_reduction.h"
#include "relight/prepared_lights.h"
#include "relight/tile_cache.h"

namespace illum {
namespace {

// Of the picture, to judge by how few directions an environment may be stood for.
constexpr std::size_t kProbeTexels = 1000;

void checkRequest(const Object& object, int group, int level) {
  if (group < 0 || group >= object.groups()) {
    throw Error(Fault::Usage, fmt::format("{}: there is no group of views {}, only 0 to {}",
                                          object.path().string(), group, object.groups() - 1));
  }
  if (level < 0 || level >= object.levels(group)) {
    throw Error(Fault::Usage, fmt::format("{}: there is no level {}, only 0 to {}",
                                          object.path().string(), level, object.levels(group) - 1));
  }
}

void checkRegion(const Object& object, const Rectangle& region, Size size) {
  if (region.x >= 0 && region.y >= 0 && region.width > 0 && region.height > 0 &&
      region.width <= size.width - region.x && region.height <= size.height - region.y) {
    return;
  }
  throw Error(Fault::Usage,
              fmt::format("{}: there is no region {}x{} at ({}, {}), only {}x{} pixels",
                          object.path().string(), region.width, region.height, region.x, region.y,
                          size.width, size.height));
}

// `mask`: the texels' coverage; empty for a picture without alpha.
void storeRow(std::span<const float> rgb, std::span<const std::uint8_t> mask, float* out) {
  if (mask.empty()) {
    std::copy(rgb.begin(), rgb.end(), out);
    return;
  }
  for (std::size_t x = 0; x < mask.size(); ++x, out += 4) {
    const float coverage = static_cast<float>(mask[x]) / 255.0f;
    for (std::size_t c = 0; c < 3; ++c) out[c] = coverage * rgb[3 * x + c];
    out[3] = coverage;
  }
}

Rectangle intersection(const Rectangle& a, const Rectangle& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::min(a.right(), b.right()) - x, std::min(a.bottom(), b.bottom()) - y};
}

// Lights are given in the object frame, the basis is a function of the group's own.
Illumination inGroup(const View& view, const Illumination& lights) {
  const RigidTransform objectFromView = objectFromGroup(view.geometry);
  if (objectFromView == RigidTransform()) return lights;
  const RigidTransform groupFromObject = inverse(objectFromView);
  Illumination turned = lights;
  for (DirectionalLight& light : turned.directional)
    light.toLight = groupFromObject.direction(light.toLight);
  for (NearLight& light : turned.nearby) {
    light.position = groupFromObject.point(light.position);
    light.axis = groupFromObject.vector(light.axis);
  }
  for (Environment& environment : turned.environments)
    environment = environment.turned(groupFromObject);
  return turned;
}

// Directional lights instead of environments, where each direction has to be decoded by itself.
// Returns the greatest error.
double reduceEnvironments(const Object& object, int group, const PrepareOptions& options,
                          Illumination& lights) {
  if (lights.environments.empty()) return 0;
  // The coarsest level is one tile: all of the picture.
  const PlaneCodes probe =
      probeOf(object.planeTile(group, object.levels(group) - 1, 0, 0), kProbeTexels);
  const Manifest& manifest = object.manifest();
  double error = 0;
  for (const Environment& environment : lights.environments) {
    const ReducedEnvironment reduced =
        reduceEnvironment(environment, object.basis(group), manifest.coding(group),
                          manifest.response, probe, options.environmentError);
    lights.directional.insert(lights.directional.end(), reduced.lights.begin(),
                              reduced.lights.end());
    error = std::max(error, reduced.error);
  }
  lights.environments.clear();
  return error;
}

// Whether lights come down to the same numbers for both groups. A basis belongs to groups that are
// turned alike, but lights nearby and environments also depend on where the frame is.
bool areAlike(const Object& object, int one, int other) {
  const auto& groups = object.manifest().groups;
  const auto entry = [&](int g) -> const GroupEntry& {
    return groups[static_cast<std::size_t>(g)];
  };
  return entry(one).basis == entry(other).basis &&
         objectFromGroup(entry(one).view.geometry) == objectFromGroup(entry(other).view.geometry);
}

}  // namespace

struct Relighter::State {
  State(Object opened, std::uint64_t memoryBytes)
      : object(std::move(opened)),
        cache(
            [this](const TileKey& key) {
              return TilePlanes(object.planeTile(key.group, key.level, key.x, key.y),
                                object.manifest().coding(key.group).bits);
            },
            memoryBytes) {}
  const Object object;
  mutable TileCache cache;
};

Relighter::Relighter(Object object, std::uint64_t memoryBytes)
    : state_(std::make_unique<State>(std::move(object), memoryBytes)) {}
Relighter::~Relighter() = default;

int PreparedLights::group() const {
  return state_->group;
}

int PreparedLights::passes() const {
  return state_->distant.count();
}

double PreparedLights::environmentError() const {
  return state_->environmentError;
}

PreparedLights Relighter::prepare(const Illumination& lights, int group,
                                  const PrepareOptions& options) const {
  const Object& object = state_->object;
  checkRequest(object, group, 0);
  Illumination turned = inGroup(object.view(group), lights);
  const CodingEntry& coding = object.manifest().coding(group);
  const Response response = object.manifest().response;
  auto state = std::make_shared<PreparedLights::State>();
  if (response != Response::Linear)
    state->environmentError = reduceEnvironments(object, group, options, turned);
  state->object = object;
  state->group = group;
  state->lights = std::make_shared<const Illumination>(lights);
  state->distant =
      Passes(object.basis(group), coding, response, turned.directional, turned.environments);
  if (!turned.nearby.empty()) {
    state->nearby = NearLights(object.basis(group), coding, response, turned.nearby);
    state->surface = Surface(object, group, options.heights);
  }
  return PreparedLights(std::move(state));
}

PreparedLights Relighter::prepareAlso(const PreparedLights& lights, int group) const {
  const Object& object = state_->object;
  checkRequest(object, group, 0);
  if (!areAlike(object, lights.group(), group)) return prepare(*lights.state_->lights, group);
  auto state = std::make_shared<PreparedLights::State>(*lights.state_);
  state->group = group;
  // What the lights come down to is the same, but not where they shine on.
  if (!state->lights->nearby.empty()) state->surface = Surface(object, group, nullptr);
  return PreparedLights(std::move(state));
}

Picture Relighter::relight(std::span<const DirectionalLight> lights, int group, int level) const {
  return relight(prepare({{lights.begin(), lights.end()}, {}, {}}, group), level);
}

Picture Relighter::relight(const PreparedLights& lights, int level) const {
  const Object& object = state_->object;
  checkRequest(object, lights.group(), level);
  const Size size = object.manifest().grid(lights.group()).sizeAt(level);
  return relightRegion(lights, {0, 0, size.width, size.height}, level);
}

Picture Relighter::relightRegion(std::span<const DirectionalLight> lights, const Rectangle& region,
                                 int group, int level) const {
  return relightRegion(prepare({{lights.begin(), lights.end()}, {}, {}}, group), region, level);
}

Picture Relighter::relightRegion(const PreparedLights& lights, const Rectangle& region,
                                 int level) const {
  const Object& object = state_->object;
  const PreparedLights::State& prepared = *lights.state_;
  const int group = prepared.group;
  checkRequest(object, group, level);
  const Manifest& manifest = object.manifest();
  const TileGrid grid = manifest.grid(group);
  checkRegion(object, region, grid.sizeAt(level));
  Picture picture(region.size(), manifest.mask ? 4 : 3);

  const auto relightTile = [&](int x, int y) {
    const Rectangle tile = grid.tileRectangle(level, x, y);
    const Rectangle part = intersection(tile, region);
    const auto codes = state_->cache.planes({group, level, x, y});
    const BytePicture mask = manifest.mask ? object.maskTile(group, level, x, y) : BytePicture();
    const bool near = !prepared.nearby.empty();
    const SurfaceTile surface = near ? prepared.surface.tile(level, x, y) : SurfaceTile();
    const auto width = static_cast<std::size_t>(part.width);
    const auto left = static_cast<std::size_t>(part.x - tile.x);
    tbb::parallel_for(tbb::blocked_range<int>(part.y, part.bottom(), 16), [&](const auto& rows) {
      std::vector<float> rgb(3 * width), scratch;
      std::vector<Vector3> points(near ? width : 0);
      for (int row = rows.begin(); row < rows.end(); ++row) {
        const auto first = Size{tile.width, row - tile.y}.pixels() + left;
        prepared.distant.relight(*codes, first, rgb, scratch);
        if (near) {
          surface.points(part.x - tile.x, row - tile.y, points);
          prepared.nearby.addTo(rgb, *codes, first, points, scratch);
        }
        storeRow(rgb, mask.empty() ? mask.samples() : mask.row(row - tile.y).subspan(left, width),
                 &picture.at(part.x - region.x, row - region.y, 0));
      }
    });
  };
  const auto endTile = [&](int end) { return (end - 1) / manifest.tile + 1; };
  tbb::parallel_for(
      tbb::blocked_range2d<int>(region.y / manifest.tile, endTile(region.bottom()), 1,
                                region.x / manifest.tile, endTile(region.right()), 1),
      [&](const auto& range) {
        for (int y = range.rows().begin(); y < range.rows().end(); ++y) {
          for (int x = range.cols().begin(); x < range.cols().end(); ++x) relightTile(x, y);
        }
      },
      tbb::simple_partitioner());
  return picture;
}

}  // namespace illum
