#include "fit/spherical_voronoi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace illum {
namespace {

using std::numbers::pi;

struct Point2 {
  double x, y;
};

double crossOf(Point2 a, Point2 b, Point2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Counter-clockwise hull without collinear points (A. M. Andrew 1979); one or two points stay as
// they are.
std::vector<Point2> convexHull(std::vector<Point2> points) {
  const auto less = [](Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  const auto equal = [](Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end(), equal), points.end());
  if (points.size() < 3) return points;
  std::vector<Point2> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t base = hull.size();
    for (const Point2 p : points) {
      while (hull.size() >= base + 2 && crossOf(hull[hull.size() - 2], hull.back(), p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Into [-pi, pi).
double wrapped(double angle) {
  return angle - 2 * pi * std::floor((angle + pi) / (2 * pi));
}

// How far b lies ahead of a, in [0, 3 pi/2); rounding may have put it a little behind. Edges of
// cells with more than one are at most pi long.
double ahead(double a, double b) {
  const double difference = b - a - 2 * pi * std::floor((b - a) / (2 * pi));
  return difference < 1.5 * pi ? difference : 0;
}

// Signed area of the spherical triangle of the north pole, p and q: A. Van Oosterom, J. Strackee,
// "The Solid Angle of a Plane Triangle", 1983.
double triangleWithPole(Vector3 p, Vector3 q) {
  return 2 * std::atan2(p.x * q.y - p.y * q.x, 1 + p.z + q.z + dot(p, q));
}

Vector3 unit(Vector3 v) {
  return (1 / length(v)) * v;
}

// Any unit vector orthogonal to v.
Vector3 orthogonalTo(Vector3 v) {
  const Vector3 axis = std::abs(v.x) < 0.6 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  return unit(cross(v, axis));
}

// Integral of (1 - cos(theta)) dphi along the arc of the great circle.
double poleIntegral(Vector3 start, Vector3 ahead, double from, double to) {
  const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / (pi / 4))));
  const auto at = [&](double s) { return std::cos(s) * start + std::sin(s) * ahead; };
  double sum = 0;
  Vector3 p = at(from);
  for (int i = 1; i <= parts; ++i) {
    const Vector3 q = at(from + (to - from) * i / parts);
    sum += triangleWithPole(p, q);
    p = q;
  }
  return sum;
}

// Integral over the part of the arc that has z >= height.
double poleIntegralAbove(Vector3 start, Vector3 ahead, double from, double to, double height) {
  // z(s) = highest * cos(s - top).
  const double highest = std::hypot(start.z, ahead.z), top = std::atan2(ahead.z, start.z);
  if (highest <= std::abs(height)) {
    return height < 0 ? poleIntegral(start, ahead, from, to) : 0;
  }
  const double reach = std::acos(height / highest);
  double sum = 0;
  // The arc is at most one turn long and begins in [-pi, pi]: it meets these turns of the interval
  // only.
  for (int turn = -1; turn <= 2; ++turn) {
    const double centre = top + 2 * pi * turn;
    const double a = std::max(from, centre - reach), b = std::min(to, centre + reach);
    if (a < b) sum += poleIntegral(start, ahead, a, b);
  }
  return sum;
}

}  // namespace

// In polar coordinates (rho, alpha) around the site, with u(alpha) the tangent direction, the
// bisector with a site at distance d in direction alpha_j is
//   cot(rho) = cot(d/2) cos(alpha - alpha_j).
// The cell's boundary is the nearest bisector, the largest cotangent: the support function of the
// planar points cot(d/2) (cos(alpha_j), sin(alpha_j)). So the neighbours are the corners of these
// points' convex hull, in order, and the cell's corners lie in the directions of the hull edges'
// normals.
SphericalVoronoiCell::SphericalVoronoiCell(Direction site, std::span<const Direction> others) {
  const Vector3 s = site.vector(), e1 = orthogonalTo(s), e2 = cross(s, e1);
  std::vector<Point2> points;
  points.reserve(others.size());
  for (const Direction& other : others) {
    const Vector3 difference = other.vector() - s;
    // cot(d/2) = sin(d) / (1 - cos(d)), and 1 - cos(d) is half the squared chord.
    const double scale = 2 / dot(difference, difference);
    points.push_back({scale * dot(difference, e1), scale * dot(difference, e2)});
  }
  const std::vector<Point2> hull = convexHull(std::move(points));
  const auto normalAngle = [&](std::size_t i) {  // outward, of the edge from corner i
    const Point2 a = hull[i], b = hull[(i + 1) % hull.size()];
    return std::atan2(a.x - b.x, b.y - a.y);
  };
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const double cotangent = std::hypot(hull[i].x, hull[i].y);
    const double alphaJ = std::atan2(hull[i].y, hull[i].x);
    const Vector3 toward = std::cos(alphaJ) * e1 + std::sin(alphaJ) * e2;
    // Half the distance: its sine and cosine from its cotangent.
    const double sine = 1 / std::hypot(1.0, cotangent), cosine = cotangent * sine;
    Edge edge;
    edge.inward = sine * s - cosine * toward;
    edge.start = cosine * s + sine * toward;
    edge.ahead = cross(edge.inward, edge.start);
    double t0 = -pi, width = 2 * pi;
    if (hull.size() > 1) {
      const double before = normalAngle((i + hull.size() - 1) % hull.size());
      t0 = wrapped(before - alphaJ);
      width = ahead(before, normalAngle(i));
    }
    // The angle t at the site against the arc along the bisector, by Napier's rule for the right
    // triangle between them: tan(arc) = sin(d/2) tan(t), both in the same quadrant.
    const auto arc = [&](double t) { return std::atan2(sine * std::sin(t), std::cos(t)); };
    edge.from = arc(t0);
    edge.to = edge.from + (hull.size() > 1 ? ahead(edge.from, arc(t0 + width)) : 2 * pi);
    // The integral of 1 - cos(rho) over the edge's angle.
    edge.sectorArea =
        width - std::asin(cosine * std::sin(t0 + width)) + std::asin(cosine * std::sin(t0));
    edges_.push_back(edge);
  }
}

double SphericalVoronoiCell::area() const {
  if (edges_.empty()) return 4 * pi;
  double sum = 0;
  for (const Edge& edge : edges_) sum += edge.sectorArea;
  return sum;
}

// Green's theorem: d((1 - cos(theta)) dphi) is the element of area, and the form is smooth
// everywhere but at the south pole, which lies below any height. So the area is the form's integral
// along the boundary: the edges' parts above the height, and the circle at that height where it
// lies in the cell.
double SphericalVoronoiCell::areaAbove(double height) const {
  double sum = (1 - height) * circleInside(height);
  for (const Edge& edge : edges_) {
    sum += poleIntegralAbove(edge.start, edge.ahead, edge.from, edge.to, height);
  }
  return std::max(0.0, sum);
}

double SphericalVoronoiCell::circleInside(double height) const {
  // Each neighbour leaves the arc around phi_n with cos(phi - phi_n) >= a bound.
  struct Arc {
    double centre, half;
  };
  std::vector<Arc> arcs;
  std::vector<double> ends{0, 2 * pi};
  const double radius = std::sqrt(1 - height * height);
  for (const Edge& edge : edges_) {
    const double slope = radius * std::hypot(edge.inward.x, edge.inward.y);
    const double offset = -edge.inward.z * height;
    if (offset <= -slope) continue;
    if (offset >= slope) return 0;
    const Arc arc{std::atan2(edge.inward.y, edge.inward.x), std::acos(offset / slope)};
    arcs.push_back(arc);
    for (const double end : {arc.centre - arc.half, arc.centre + arc.half}) {
      ends.push_back(wrapped(end) + pi);
    }
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = (ends[i] + ends[i + 1]) / 2 - pi;
    const bool inside = std::all_of(arcs.begin(), arcs.end(), [&](const Arc& arc) {
      return std::abs(wrapped(middle - arc.centre)) <= arc.half;
    });
    if (inside) sum += ends[i + 1] - ends[i];
  }
  return sum;
}

}  // namespace illum
