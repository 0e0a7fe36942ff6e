#include "lumigraph/default_focus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

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

Vector3 middleOf(std::span<const View> views) {
  std::deque<ViewProjector> projectors;
  std::vector<const ViewProjector*> all;
  Vector3 sum;
  for (const View& view : views) {
    if (std::holds_alternative<OrthographicView>(view.geometry)) return {};
    all.push_back(&projectors.emplace_back(view.geometry));
    const auto* slab = std::get_if<SlabView>(&view.geometry);
    if (slab != nullptr) {
      const PlaneRectangle& st = slab->slab.st;
      sum = sum + slab->slab.objectFromSlab.point(
                      {0.5 * (st.left + st.right), 0.5 * (st.bottom + st.top), 0});
    } else {
      sum = sum + projectors.back().eye();
    }
  }
  const Vector3 mean = (1 / static_cast<double>(std::max<std::size_t>(1, views.size()))) * sum;
  if (views.empty() || std::holds_alternative<SlabView>(views.front().geometry)) return mean;
  if (const auto plane = planeLookedAt(all)) return plane->point;
  return projectors.front().wraps() ? mean : mean + projectors.front().axis();
}

Vector3 onPlane(const Ray& ray, const std::optional<Plane>& plane, bool wholeLine) {
  if (!plane) return ray.origin + (kFarAway / length(ray.direction)) * ray.direction;
  const double steps =
      dot(plane->normal, plane->point - ray.origin) / dot(plane->normal, ray.direction);
  if (!std::isfinite(steps) || (steps <= 0 && !wholeLine)) return {kNothing, kNothing, kNothing};
  return ray.origin + steps * ray.direction;
}

}  // namespace illum
