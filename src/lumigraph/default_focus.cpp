#include "lumigraph/default_focus.h"

#include <array>
#include <cmath>

namespace illum {
namespace {

constexpr double kFarAway = 1e9;
constexpr double kParallel = 1e-6;  // least squared sine, averaged, of axes that meet

// a x = b of three unknowns by Cramer's rule; the columns of `a` are given.
Vector3 solved(const std::array<Vector3, 3>& a, Vector3 b, double determinant) {
  return {dot(b, cross(a[1], a[2])) / determinant, dot(a[0], cross(b, a[2])) / determinant,
          dot(a[0], cross(a[1], b)) / determinant};
}

}  // namespace

Plane windowOf(const LightSlab& slab) {
  return {slab.objectFromSlab.point({0, 0, 0}), slab.objectFromSlab.vector({0, 0, 1})};
}

std::optional<Plane> planeLookedAt(std::span<const ViewProjector* const> views) {
  // Least squares: the sum of (1 - d d') (p - eye) over the axes d is 0.
  std::array<Vector3, 3> columns{};
  Vector3 right, mean;
  for (const ViewProjector* view : views) {
    if (view->wraps()) return std::nullopt;
    const Vector3 d = view->axis(), eye = view->eye();
    columns[0] = columns[0] + Vector3{1, 0, 0} - d.x * d;
    columns[1] = columns[1] + Vector3{0, 1, 0} - d.y * d;
    columns[2] = columns[2] + Vector3{0, 0, 1} - d.z * d;
    right = right + eye - dot(d, eye) * d;
    mean = mean + d;
  }
  const double determinant = dot(columns[0], cross(columns[1], columns[2]));
  const auto count = static_cast<double>(views.size());
  if (!(determinant > kParallel * count * count * count) || !(length(mean) > 0)) {
    return std::nullopt;
  }
  return Plane{solved(columns, right, determinant), (1 / length(mean)) * mean};
}

Vector3 onPlane(const Ray& ray, const std::optional<Plane>& plane, bool wholeLine) {
  if (!plane) return ray.origin + (kFarAway / length(ray.direction)) * ray.direction;
  const double steps =
      dot(plane->normal, plane->point - ray.origin) / dot(plane->normal, ray.direction);
  if (!std::isfinite(steps) || (steps <= 0 && !wholeLine)) return {kNothing, kNothing, kNothing};
  return ray.origin + steps * ray.direction;
}

}  // namespace illum
