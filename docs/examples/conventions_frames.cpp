// docs/conventions.md, "Frames".
#include "expect.h"
#include "illum/picture.h"
#include "illum/vector.h"

#include <algorithm>
#include <array>

using illum::Direction;
using illum::Size;
using illum::Vector3;

namespace {

/// The point of z = 0 under the position (column, row) of a photograph; pixel (i, j) covers
/// [i, i + 1) x [j, j + 1), so its centre is (i + 0.5, j + 0.5).
Vector3 objectFromPhotograph(Size size, double column, double row) {
  const double longerSide = std::max(size.width, size.height);
  return {(2 * column - size.width) / longerSide, (size.height - 2 * row) / longerSide, 0};
}

/// Rows of a rotation matrix; objectFromGroup * v takes v's group coordinates to object
/// coordinates.
using Rotation = std::array<Vector3, 3>;

Vector3 operator*(const Rotation& rotation, Vector3 v) {
  return {dot(rotation[0], v), dot(rotation[1], v), dot(rotation[2], v)};
}

Rotation inverse(const Rotation& r) {
  return {Vector3{r[0].x, r[1].x, r[2].x}, Vector3{r[0].y, r[1].y, r[2].y},
          Vector3{r[0].z, r[1].z, r[2].z}};
}

/// What the table of a group's light basis is asked for when the light comes from `inObject`.
Direction groupDirection(const Rotation& objectFromGroup, Direction inObject) {
  return Direction::fromVector(inverse(objectFromGroup) * inObject.vector());
}

}  // namespace

int main() {
  expect(cross(Vector3{1, 0, 0}, Vector3{0, 1, 0}) == Vector3{0, 0, 1}, "x cross y is z");

  const Size size{400, 300};
  expect(objectFromPhotograph(size, 200, 150) == Vector3{}, "the middle is the origin");
  expect(objectFromPhotograph(size, 400, 150).x == 1, "half the longer side is 1");
  expect(objectFromPhotograph(size, 0, 0).y == 0.75, "rows start at the top");
  expect(objectFromPhotograph(size, 0.5, 150).x == -0.9975, "pixel centres are at half integers");

  // A slab turned by 90 degrees about y: its own z points along the object's x.
  const Rotation objectFromGroup = {Vector3{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
  expect(objectFromGroup * Vector3{0, 0, 1} == Vector3{1, 0, 0}, "the group's z is the object's x");
  const Direction light = Direction::fromVector({1, 0, 0});
  expect(groupDirection(objectFromGroup, light).z() == 1, "light along x falls onto it frontally");
}
