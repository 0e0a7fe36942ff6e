#include "render/ray_tree.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>

#include "illum/error.h"

namespace illum {
namespace {

// A stream of shadow rays is handed to Embree as it lies in memory.
static_assert(sizeof(ShadowRay) == sizeof(RTCRay));
static_assert(offsetof(ShadowRay, start) == offsetof(RTCRay, tnear));
static_assert(offsetof(ShadowRay, directionX) == offsetof(RTCRay, dir_x));
static_assert(offsetof(ShadowRay, time) == offsetof(RTCRay, time));
static_assert(offsetof(ShadowRay, end) == offsetof(RTCRay, tfar));
static_assert(offsetof(ShadowRay, mask) == offsetof(RTCRay, mask));
static_assert(offsetof(ShadowRay, id) == offsetof(RTCRay, id));
static_assert(offsetof(ShadowRay, flags) == offsetof(RTCRay, flags));

// Saturated, so that any number of surfaces fits; still the same in any order.
constexpr std::int32_t kBlack = 1 << 30;

// Embree passes it through to the filters.
struct ShadowContext {
  RTCIntersectContext embree;
  std::span<OpticalDepth> depths;
};

const SurfaceFilter& filterOf(const RTCFilterFunctionNArguments* arguments) {
  return *static_cast<const SurfaceFilter*>(arguments->geometryUserPtr);
}

// Holes let every ray through.
void skipHoles(const RTCFilterFunctionNArguments* arguments) {
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    if (filterOf(arguments).isHole(
            RTCHitN_geomID(arguments->hit, n, i), RTCHitN_primID(arguments->hit, n, i),
            RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i))) {
      arguments->valid[i] = 0;
    }
  }
}

// Of the angle between the ray and the triangle.
float incidenceCosine(const RTCFilterFunctionNArguments* arguments, unsigned i) {
  const unsigned n = arguments->N;
  const Float3 normal{RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                      RTCHitN_Ng_z(arguments->hit, n, i)};
  const Float3 along{RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                     RTCRayN_dir_z(arguments->ray, n, i)};
  return std::min(1.0f, std::abs(dot(normal, along)) / length(normal));
}

// Glass lets shadow rays through, weakened.
void weakenInGlass(const RTCFilterFunctionNArguments* arguments) {
  skipHoles(arguments);
  const unsigned n = arguments->N;
  const auto depths = reinterpret_cast<ShadowContext*>(arguments->context)->depths;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    const auto loss = filterOf(arguments).lossThrough(
        RTCHitN_geomID(arguments->hit, n, i), RTCHitN_primID(arguments->hit, n, i),
        RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i),
        incidenceCosine(arguments, i));
    if (!loss) continue;
    OpticalDepth& depth = depths[RTCRayN_id(arguments->ray, n, i)];
    for (std::size_t c = 0; c < 3; ++c) depth[c] = std::min(depth[c] + (*loss)[c], kBlack);
    arguments->valid[i] = 0;
  }
}

bool countBytes(void* counter, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
  return true;
}

void* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                std::size_t count) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
  if (buffer == nullptr) {
    throw Error(Fault::Machine, "the scene does not fit into memory");
  }
  return buffer;
}

RTCGeometry meshGeometry(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  constexpr std::size_t kVertex = sizeof(mesh.positions[0]), kTriangle = sizeof(mesh.triangles[0]);
  std::memcpy(newBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, kVertex,
                        mesh.positions.size()),
              mesh.positions.data(), kVertex * mesh.positions.size());
  std::memcpy(newBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, kTriangle,
                        mesh.triangles.size()),
              mesh.triangles.data(), kTriangle * mesh.triangles.size());
  return geometry;
}

RTCGeometry curveGeometry(RTCDevice device, const CurveSet& curves,
                          std::span<const std::uint32_t> segments) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE);
  constexpr std::size_t kPoint = sizeof(curves.points[0]);
  std::memcpy(
      newBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, kPoint, curves.points.size()),
      curves.points.data(), kPoint * curves.points.size());
  std::memcpy(newBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, sizeof(std::uint32_t),
                        segments.size()),
              segments.data(), segments.size_bytes());
  return geometry;
}

}  // namespace

std::vector<std::uint32_t> segmentsOf(const CurveSet& curves) {
  std::vector<std::uint32_t> segments;
  for (std::size_t curve = 0; curve < curves.firstPoints.size(); ++curve) {
    const auto end = curve + 1 < curves.firstPoints.size()
                         ? curves.firstPoints[curve + 1]
                         : static_cast<std::uint32_t>(curves.points.size());
    for (auto point = curves.firstPoints[curve]; point + 3 < end; ++point) {
      segments.push_back(point);
    }
  }
  return segments;
}

LinearRgb transmittance(const OpticalDepth& depth) {
  const auto left = [](std::int32_t d) { return std::exp2(-0x1p-20f * static_cast<float>(d)); };
  return {left(depth[0]), left(depth[1]), left(depth[2])};
}

struct RayTree::State {
  std::atomic<std::int64_t> bytes = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  State() {
    // Not "threads=1", which would hold the whole process to one thread while the device lives.
    device = rtcNewDevice(nullptr);
    if (device == nullptr) throw Error(Fault::Machine, "the ray tracer cannot be started");
    rtcSetDeviceMemoryMonitorFunction(device, countBytes, &bytes);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  }
  ~State() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void attach(RTCGeometry geometry, std::size_t id) const {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(id));
    rtcReleaseGeometry(geometry);
  }
};

RayTree::RayTree(const Scene& scene, const SurfaceFilter& filter, const Filtered& filtered)
    : state_(std::make_unique<State>()) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m].triangles.empty()) continue;
    RTCGeometry geometry = meshGeometry(state_->device, scene.meshes[m]);
    rtcSetGeometryUserData(geometry, const_cast<SurfaceFilter*>(&filter));
    if (filtered.holes[m]) {
      rtcSetGeometryIntersectFilterFunction(geometry, skipHoles);
      rtcSetGeometryOccludedFilterFunction(geometry, skipHoles);
    }
    if (filtered.glass[m]) {
      rtcSetGeometryOccludedFilterFunction(geometry, weakenInGlass);
      hasGlass_ = true;
    }
    state_->attach(geometry, m);
  }
  for (std::size_t c = 0; c < scene.curves.size(); ++c) {
    const auto segments = segmentsOf(scene.curves[c]);
    if (segments.empty()) continue;
    state_->attach(curveGeometry(state_->device, scene.curves[c], segments),
                   scene.meshes.size() + c);
  }
  // One thread builds the tree: the same tree on every machine of a kind.
  tbb::task_arena(1).execute([&] { rtcJoinCommitScene(state_->scene); });
  if (rtcGetDeviceError(state_->device) != RTC_ERROR_NONE) {
    throw Error(Fault::Machine, "the scene does not fit into memory");
  }
}

RayTree::~RayTree() = default;

std::optional<Hit> RayTree::nearest(Float3 origin, Float3 direction, float start) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = {origin.x,    origin.y,    origin.z,
               start,       direction.x, direction.y,
               direction.z, 0,           std::numeric_limits<float>::infinity(),
               ~0u,         0,           0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{query.hit.geomID, query.hit.primID, query.hit.u,
             query.hit.v,      query.ray.tfar,   {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
}

void RayTree::shadows(std::span<ShadowRay> rays, std::span<OpticalDepth> depths) const {
  ShadowContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  context.depths = depths;
  rtcOccluded1M(state_->scene, &context.embree, reinterpret_cast<RTCRay*>(rays.data()),
                static_cast<unsigned>(rays.size()), sizeof(RTCRay));
}

std::uint64_t RayTree::bytes() const {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, state_->bytes));
}

}  // namespace illum
