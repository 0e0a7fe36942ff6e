#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "illum/error.h"
#include "json/json_text.h"
#include "scene/json_guard.h"
#include "scene/scene_fields.h"
#include "scene/schema_writer.h"
#include "scene/slab_framing.h"
#include "scene/strict_reader.h"

namespace illum {
namespace {

using fields::FieldPath;

/// A place in the file: names[index], and a field of that.
Error wrong(std::string_view list, std::size_t index, std::string_view field,
            std::string_view expected, std::string_view found) {
  const FieldPath top, all(&top, list), one(&all, index);
  return field.empty() ? one.wrong(expected, found) : FieldPath(&one, field).wrong(expected, found);
}

void checkMaterial(const SceneDescription& scene, std::string_view list, std::size_t index,
                   const std::string& name) {
  if (scene.materials.contains(name)) return;
  std::vector<std::string_view> known;
  for (const auto& material : scene.materials) known.push_back(material.first);
  const std::string nearest = nearestName(name, known);
  throw wrong(list, index, "material",
              "one of 'materials'" + (nearest.empty() ? "" : ", such as '" + nearest + "'"),
              fmt::format("'{}'", name.substr(0, 60)));
}

void checkMesh(const SceneDescription& scene, std::size_t index) {
  const MeshRecord& mesh = scene.meshes[index];
  if (mesh.file.has_value() == mesh.shape.has_value())
    throw wrong("meshes", index, "", "either 'file' or 'shape'", mesh.file ? "both" : "neither");
  if (mesh.material) checkMaterial(scene, "meshes", index, *mesh.material);
  for (const auto& replaced : mesh.materials)
    checkMaterial(scene, "meshes", index, replaced.second);
  const Vector3& s = mesh.placement.scale;
  if (s.x == 0 || s.y == 0 || s.z == 0)
    throw wrong("meshes", index, "scale", "factors other than 0", "0");
}

void checkHair(const SceneDescription& scene, std::size_t index) {
  const HairRecord& hair = scene.hair[index];
  if (hair.file.has_value() != hair.curves.empty())
    throw wrong("hair", index, "", "either 'file' or 'curves'", hair.file ? "both" : "neither");
  if (hair.material) checkMaterial(scene, "hair", index, *hair.material);
  const Vector3& s = hair.placement.scale;
  if (!(s.x > 0) || s.x != s.y || s.y != s.z)
    throw wrong("hair", index, "scale", "one positive factor, for hair stays round",
                fmt::format("{}, {}, {}", s.x, s.y, s.z));
}

RigidTransform frameOf(const FrameRecord& record, std::size_t index) {
  const RigidTransform frame{record.rotation, record.translation};
  const std::array<double, 9>& m = frame.rotation;
  const auto row = [&](std::size_t r) { return Vector3{m[3 * r], m[3 * r + 1], m[3 * r + 2]}; };
  constexpr double kRounding = 1e-6;
  bool rigid = length(cross(row(0), row(1)) - row(2)) < kRounding;
  for (std::size_t r = 0; r < 3; ++r) rigid = rigid && std::abs(length(row(r)) - 1) < kRounding;
  if (!rigid)
    throw wrong("views", index, "frame", "three perpendicular rows of length 1, right-handed",
                "others");
  return frame;
}

PlaneRectangle rectangleOf(const RectangleRecord& r, std::size_t index, std::string_view field) {
  if (!(r[0] <= r[2] && r[1] <= r[3]) || (field == "window" && !(r[0] < r[2] && r[1] < r[3])))
    throw wrong("views", index, field, "left, bottom, right, top in growing order",
                fmt::format("{}, {}, {}, {}", r[0], r[1], r[2], r[3]));
  return {r[0], r[1], r[2], r[3]};
}

double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

/// An upright direction of view, or an Error that names the view.
void checkLooking(Vector3 toward, Vector3 up, std::size_t index) {
  try {
    lookAt(toward, {}, up);
  } catch (const Error&) {
    throw wrong("views", index, "", "a direction of view and an 'up' across it",
                "none that determine a frame");
  }
}

// --- views ---

ViewPlan planOf(const SlabRecord& record, std::size_t index) {
  SlabPlan plan;
  plan.name = record.name;
  plan.uCount = record.viewPoints[0];
  plan.vCount = record.viewPoints[1];
  if (record.frame) plan.objectFromSlab = frameOf(*record.frame, index);
  checkLooking(record.toward, record.up, index);
  plan.toward = record.toward;
  plan.up = record.up;
  plan.distance = record.distance;
  if (record.uv) plan.uv = rectangleOf(*record.uv, index, "uv");
  plan.uRadians = radians(record.spreadDegrees[0]);
  plan.vRadians = radians(record.spreadDegrees[1]);
  if (record.window) plan.st = rectangleOf(*record.window, index, "window");
  if (record.size) plan.size = Size{(*record.size)[0], (*record.size)[1]};
  plan.longerSide = record.longerSide;
  return plan;
}

ViewPlan planOf(const TurnRecord& record, std::size_t index) {
  TurnPlan plan;
  plan.slabs = record.slabs;
  plan.elevationRadians = radians(record.elevationDegrees);
  plan.joined = !record.spreadDegrees.has_value();
  SlabRecord slab;
  slab.name = record.name;
  slab.viewPoints = record.viewPoints;
  slab.up = record.up;
  slab.distance = record.distance;
  if (record.spreadDegrees) slab.spreadDegrees = *record.spreadDegrees;
  slab.window = record.window;
  slab.size = record.size;
  slab.longerSide = record.longerSide;
  for (int i = 0; i < record.slabs; ++i) checkLooking(towardOf(plan, i), slab.up, index);
  plan.slab = std::get<SlabPlan>(planOf(slab, index));
  return plan;
}

ViewPlan planOf(const PhotographRecord& record, std::size_t) {
  return PhotographPlan{record.name, {record.size[0], record.size[1]}};
}

ViewPlan planOf(const CameraRecord& record, std::size_t index) {
  const bool looking = record.eye || record.target || record.up || record.fieldOfViewDegrees;
  const bool given = record.frame || record.focal || record.centre;
  if (looking && given)
    throw wrong("views", index, "camera",
                "'eye', 'target', 'up' and 'fieldOfViewDegrees', or 'frame', 'focal' and 'centre'",
                "some of both");
  const Size size{record.size[0], record.size[1]};
  if (!given) {
    CameraPlan plan;
    plan.name = record.name;
    plan.eye = record.eye;
    plan.target = record.target;
    if (record.up) plan.up = *record.up;
    if (record.fieldOfViewDegrees) plan.fieldOfViewRadians = radians(*record.fieldOfViewDegrees);
    if (record.eye && record.target) checkLooking(*record.eye - *record.target, plan.up, index);
    plan.size = size;
    return plan;
  }
  if (!record.frame || !record.focal)
    throw wrong("views", index, "camera", "'frame' and 'focal' together", "one of them");
  PinholeCamera camera;
  camera.objectFromCamera = frameOf(*record.frame, index);
  camera.focalX = (*record.focal)[0], camera.focalY = (*record.focal)[1];
  camera.centre = {0.5 * size.width, 0.5 * size.height};
  if (record.centre) camera.centre = {(*record.centre)[0], (*record.centre)[1]};
  camera.size = size;
  return FixedPlan{{record.name, camera}};
}

void checkGrowing(const std::array<double, 2>& edges, std::size_t index, std::string_view field) {
  if (!(edges[0] < edges[1]))
    throw wrong("views", index, field, "two growing numbers",
                fmt::format("{}, {}", edges[0], edges[1]));
}

ViewPlan planOf(const PanoramaRecord& record, std::size_t index) {
  const bool cylindrical = record.projection == Panorama::Projection::Cylindrical;
  if (cylindrical ? record.elevationDegrees.has_value() : record.heights.has_value())
    throw wrong("views", index, "panorama",
                cylindrical ? "'heights' with a cylinder" : "'elevationDegrees' without a cylinder",
                cylindrical ? "'elevationDegrees'" : "'heights'");
  const auto elevation = record.elevationDegrees.value_or(std::array<double, 2>{-90, 90});
  const auto heights = record.heights.value_or(std::array<double, 2>{-1, 1});
  checkGrowing(record.azimuthDegrees, index, "azimuthDegrees");
  checkGrowing(elevation, index, "elevationDegrees");
  checkGrowing(heights, index, "heights");
  const auto& azimuth = record.azimuthDegrees;
  if (azimuth[1] - azimuth[0] > 360)
    throw wrong("views", index, "azimuthDegrees", "at most a whole turn",
                fmt::format("{}", azimuth[1] - azimuth[0]));
  checkLooking(record.toward, record.up, index);
  Panorama panorama;
  panorama.projection = record.projection;
  panorama.objectFromCamera = lookAt(record.eye, record.eye + record.toward, record.up);
  // Rounding of degrees must not make more than a turn of a whole one.
  const double turn = std::min(radians(azimuth[1] - azimuth[0]), 2 * std::numbers::pi);
  panorama.extent.left = radians(azimuth[0]);
  panorama.extent.right = panorama.extent.left + turn;
  panorama.extent.bottom = cylindrical ? heights[0] : radians(elevation[0]);
  panorama.extent.top = cylindrical ? heights[1] : radians(elevation[1]);
  panorama.size = {record.size[0], record.size[1]};
  return FixedPlan{{record.name, panorama}};
}

ViewPlan planOf(const ViewEntryRecord& entry, std::size_t index) {
  const int given = entry.slab.has_value() + entry.turn.has_value() + entry.photograph.has_value() +
                    entry.camera.has_value() + entry.panorama.has_value();
  if (given != 1)
    throw wrong("views", index, "", "one of 'slab', 'turn', 'photograph', 'camera' and 'panorama'",
                given == 0 ? "none" : "several");
  if (entry.slab) return planOf(*entry.slab, index);
  if (entry.turn) return planOf(*entry.turn, index);
  if (entry.photograph) return planOf(*entry.photograph, index);
  if (entry.camera) return planOf(*entry.camera, index);
  return planOf(*entry.panorama, index);
}

// --- lights ---

bool looksAllAround(const SceneDescription& scene) {
  return std::ranges::any_of(scene.views, [](const ViewEntryRecord& view) {
    return view.turn.has_value() || view.panorama.has_value();
  });
}

LightPlan lightPlanOf(const SceneDescription& scene) {
  const LightsRecord& record = scene.lights;
  const int given = record.fibonacci.has_value() + record.polar.has_value() +
                    !record.directions.empty() + record.file.has_value();
  if (given > 1)
    throw Error(Fault::Input,
                "field 'lights': expected one of 'fibonacci', 'polar', 'directions' "
                "and 'file', found several");
  LightPlan plan;
  plan.region =
      record.region.value_or(looksAllAround(scene) ? LightRegion::Sphere : LightRegion::Hemisphere);
  if (record.fibonacci) plan.lights = FibonacciGrid{*record.fibonacci};
  if (record.polar) plan.lights = PolarGrid{(*record.polar)[0], (*record.polar)[1]};
  if (!record.directions.empty()) {
    std::vector<Direction> directions;
    for (const Vector3& v : record.directions) {
      if (!(length(v) > 0))
        throw Error(Fault::Input,
                    fmt::format("field 'lights.directions[{}]': expected a direction, found the "
                                "zero vector",
                                directions.size()));
      directions.push_back(Direction::fromVector(v));
    }
    plan.lights = namedLights(directions);
  }
  if (record.radiusDegrees) plan.radiusRadians = radians(*record.radiusDegrees);
  return plan;
}

void check(const SceneDescription& scene) {
  if (scene.meshes.empty() && scene.hair.empty())
    throw Error(Fault::Input, "expected 'meshes' or 'hair' to see, found neither");
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) checkMesh(scene, i);
  for (std::size_t i = 0; i < scene.hair.size(); ++i) checkHair(scene, i);
  planOf(scene);
}

}  // namespace

CapturePlan planOf(const SceneDescription& scene) {
  CapturePlan plan;
  if (!scene.views.empty()) plan.views.clear();
  for (std::size_t i = 0; i < scene.views.size(); ++i)
    plan.views.push_back(planOf(scene.views[i], i));
  plan.lights = lightPlanOf(scene);
  plan.samplesPerPixel = scene.samples;
  plan.bounces = scene.bounces;
  plan.filterRadius = scene.filterRadius;
  plan.seed = scene.seed;
  return plan;
}

SceneDescription sceneFromText(std::string_view json, const std::string& source) {
  if (json.size() > kMaxSceneTextBytes)
    throw Error(Fault::Input, fmt::format("{}: expected at most {} bytes of scene text, found {}",
                                          source, kMaxSceneTextBytes, json.size()));
  const fields::Json root = guardedJson(json, source);
  try {
    SceneDescription scene;
    scenefile::StrictReader::read(root, FieldPath(), scene);
    check(scene);
    return scene;
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

std::string sceneSchema() {
  fields::OrderedJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                             {"title", "A scene of Illumigraph"}};
  schema.update(scenefile::SchemaWriter::schemaOf<SceneDescription>());
  return fields::jsonText(schema) + "\n";
}

}  // namespace illum
