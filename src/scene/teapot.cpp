#include "scene/teapot.h"

#include <utility>

#include "scene/placement.h"
#include "scene/shapes.h"

namespace illum {
namespace {

/// A control point of a curve that is turned about the axis.
struct ProfilePoint {
  double radius, height;
  double handle = 0.56;  // of the quarter circle's control points, over the radius
};
using Profile = std::array<ProfilePoint, 4>;

// From the outside of the rim down to the bottom's centre, and the lid from its rim up.
constexpr Profile kRim{{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}};
constexpr Profile kUpperBody{{{1.5, 2.4}, {1.75, 1.875}, {2, 1.35}, {2, 0.9}}};
constexpr Profile kLowerBody{{{2, 0.9}, {2, 0.45}, {1.5, 0.225}, {1.5, 0.15}}};
constexpr Profile kBottom{{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0}, {0, 0}}};
constexpr Profile kKnob{{{0, 3.15}, {0.8, 3.15, 0.5625}, {0, 2.85}, {0.2, 2.7}}};
constexpr Profile kLid{{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}};

/// Rows along handle or spout; each is the half of a section that lies at z >= 0.
using HalfTube = std::array<std::array<Vector3, 4>, 4>;

constexpr HalfTube kUpperHandle{
    {{{{-1.6, 2.025, 0}, {-1.6, 2.025, 0.3}, {-1.5, 2.25, 0.3}, {-1.5, 2.25, 0}}},
     {{{-2.3, 2.025, 0}, {-2.3, 2.025, 0.3}, {-2.5, 2.25, 0.3}, {-2.5, 2.25, 0}}},
     {{{-2.7, 2.025, 0}, {-2.7, 2.025, 0.3}, {-3, 2.25, 0.3}, {-3, 2.25, 0}}},
     {{{-2.7, 1.8, 0}, {-2.7, 1.8, 0.3}, {-3, 1.8, 0.3}, {-3, 1.8, 0}}}}};
constexpr HalfTube kLowerHandle{
    {{{{-2.7, 1.8, 0}, {-2.7, 1.8, 0.3}, {-3, 1.8, 0.3}, {-3, 1.8, 0}}},
     {{{-2.7, 1.575, 0}, {-2.7, 1.575, 0.3}, {-3, 1.35, 0.3}, {-3, 1.35, 0}}},
     {{{-2.5, 1.125, 0}, {-2.5, 1.125, 0.3}, {-2.65, 0.9375, 0.3}, {-2.65, 0.9375, 0}}},
     {{{-2, 0.9, 0}, {-2, 0.9, 0.3}, {-1.9, 0.6, 0.3}, {-1.9, 0.6, 0}}}}};
constexpr HalfTube kLowerSpout{
    {{{{1.7, 1.425, 0}, {1.7, 1.425, 0.66}, {1.7, 0.6, 0.66}, {1.7, 0.6, 0}}},
     {{{2.6, 1.425, 0}, {2.6, 1.425, 0.66}, {3.1, 0.825, 0.66}, {3.1, 0.825, 0}}},
     {{{2.3, 2.1, 0}, {2.3, 2.1, 0.25}, {2.4, 2.025, 0.25}, {2.4, 2.025, 0}}},
     {{{2.7, 2.4, 0}, {2.7, 2.4, 0.25}, {3.3, 2.4, 0.25}, {3.3, 2.4, 0}}}}};
constexpr HalfTube kUpperSpout{
    {{{{2.7, 2.4, 0}, {2.7, 2.4, 0.25}, {3.3, 2.4, 0.25}, {3.3, 2.4, 0}}},
     {{{2.8, 2.475, 0}, {2.8, 2.475, 0.25}, {3.525, 2.49375, 0.25}, {3.525, 2.49375, 0}}},
     {{{2.9, 2.475, 0}, {2.9, 2.475, 0.15}, {3.45, 2.5125, 0.15}, {3.45, 2.5125, 0}}},
     {{{2.8, 2.4, 0}, {2.8, 2.4, 0.15}, {3.2, 2.4, 0.15}, {3.2, 2.4, 0}}}}};

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

/// A quarter turn about +y, from +z to +x.
Vector3 quarterTurn(Vector3 p) {
  return {p.z, p.y, -p.x};
}

BezierPatch reversed(BezierPatch patch) {
  for (auto& row : patch.control) std::swap(row[0], row[3]), std::swap(row[1], row[2]);
  return patch;
}

/// Four patches of a profile that runs downward along their outside.
void addRevolved(const Profile& profile, std::vector<BezierPatch>& patches) {
  BezierPatch patch;
  for (std::size_t row = 0; row < 4; ++row) {
    const auto& [radius, height, handle] = profile[3 - row];
    const double h = handle * radius;
    patch.control[row] = {
        {{0, height, radius}, {h, height, radius}, {radius, height, h}, {radius, height, 0}}};
  }
  for (int quarter = 0; quarter < 4; ++quarter) {
    patches.push_back(patch);
    for (auto& row : patch.control) {
      for (Vector3& p : row) p = quarterTurn(p);
    }
  }
}

/// Both halves of a tube; the rows of the given one are right as seen from outside.
void addTube(const HalfTube& half, std::vector<BezierPatch>& patches) {
  BezierPatch far{half};
  for (auto& row : far.control) {
    for (Vector3& p : row) p.z = -p.z;
  }
  patches.push_back({half});
  patches.push_back(reversed(far));
}

}  // namespace

Vector3 BezierPatch::point(double u, double v) const {
  const auto across = bernstein(u), along = bernstein(v);
  Vector3 sum;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t i = 0; i < 4; ++i) sum = sum + along[row] * across[i] * control[row][i];
  }
  return sum;
}

std::vector<BezierPatch> teapotPatches() {
  std::vector<BezierPatch> patches;
  for (const Profile& profile : {kRim, kUpperBody, kLowerBody, kBottom, kKnob, kLid})
    addRevolved(profile, patches);
  for (const HalfTube& half : {kUpperHandle, kLowerHandle, kLowerSpout, kUpperSpout})
    addTube(half, patches);
  return patches;
}

TriangleMesh teapotMesh(int steps) {
  TriangleMesh mesh;
  mesh.name = "teapot";
  for (const BezierPatch& patch : teapotPatches()) {
    append(mesh, surfaceMesh([&](double u, double v) { return patch.point(u, v); }, steps, steps));
  }
  return mesh;
}

TriangleMesh unitTeapotMesh() {
  constexpr int kSteps = 24;
  Scene scene;
  scene.meshes = {teapotMesh(kSteps)};
  normalise(scene);
  return std::move(scene.meshes.front());
}

}  // namespace illum
