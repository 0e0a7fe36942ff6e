#include <cmath>

#include "illum/camera.h"
#include "illum/error.h"

namespace illum {
namespace {

using Row = std::array<double, 4>;

Row rowOf(const ProjectionMatrix& m, std::size_t row) {
  return {m[4 * row], m[4 * row + 1], m[4 * row + 2], m[4 * row + 3]};
}

Vector3 vectorOf(const Row& row) {
  return {row[0], row[1], row[2]};
}

Row combined(double a, const Row& x, double b, const Row& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2], a * x[3] + b * y[3]};
}

[[noreturn]] void refuse(const char* found) {
  throw Error(Fault::Input,
              std::string("camera: expected the projection matrix of a pinhole camera "
                          "with perpendicular axes, found ") +
                  found);
}

}  // namespace

ProjectionMatrix projectionMatrix(const PinholeCamera& camera) {
  const RigidTransform t = inverse(camera.objectFromCamera);
  const auto& r = t.rotation;
  const Row x{r[0], r[1], r[2], t.translation.x}, y{r[3], r[4], r[5], t.translation.y};
  const Row depth{-r[6], -r[7], -r[8], -t.translation.z};
  const Row columns = combined(camera.focalX, x, camera.centre.x, depth);
  const Row rows = combined(-camera.focalY, y, camera.centre.y, depth);
  return {columns[0], columns[1], columns[2], columns[3], rows[0],  rows[1],
          rows[2],    rows[3],    depth[0],   depth[1],   depth[2], depth[3]};
}

PinholeCamera pinholeFromProjection(const ProjectionMatrix& pixelsFromObject, Size size) {
  Row columns = rowOf(pixelsFromObject, 0), rows = rowOf(pixelsFromObject, 1);
  Row depth = rowOf(pixelsFromObject, 2);
  for (const double value : pixelsFromObject) {
    if (!std::isfinite(value)) refuse("a number that is not finite");
  }
  // The scale is free; its sign is the one that makes a right-handed camera.
  const double determinant = dot(vectorOf(columns), cross(vectorOf(rows), vectorOf(depth)));
  if (determinant == 0) refuse("a singular one");
  const double scale = std::copysign(1 / length(vectorOf(depth)), determinant);
  for (Row* row : {&columns, &rows, &depth}) *row = combined(scale, *row, 0, *row);

  PinholeCamera camera;
  camera.size = size;
  camera.centre = {dot(vectorOf(columns), vectorOf(depth)), dot(vectorOf(rows), vectorOf(depth))};
  const Row x = combined(1, columns, -camera.centre.x, depth);
  const Row y = combined(-1, rows, camera.centre.y, depth);
  camera.focalX = length(vectorOf(x));
  camera.focalY = length(vectorOf(y));
  if (!(camera.focalX > 0) || !(camera.focalY > 0)) refuse("a singular one");
  const double skew = dot(vectorOf(x), vectorOf(y)) / (camera.focalX * camera.focalY);
  if (std::abs(skew) > 1e-6) refuse("a skewed one");

  const Vector3 right = (1 / camera.focalX) * vectorOf(x), up = (1 / camera.focalY) * vectorOf(y);
  const Vector3 back = -1.0 * vectorOf(depth);
  RigidTransform cameraFromObject{
      {right.x, right.y, right.z, up.x, up.y, up.z, back.x, back.y, back.z},
      {x[3] / camera.focalX, y[3] / camera.focalY, -depth[3]}};
  camera.objectFromCamera = inverse(cameraFromObject);
  return camera;
}

std::array<double, 16> clipFromObject(const PinholeCamera& camera, double nearDepth,
                                      double farDepth) {
  const ProjectionMatrix m = projectionMatrix(camera);
  const Row w = rowOf(m, 2);
  const Row x = combined(2.0 / camera.size.width, rowOf(m, 0), -1, w);
  const Row y = combined(-2.0 / camera.size.height, rowOf(m, 1), 1, w);
  const double range = farDepth - nearDepth;
  Row z = combined((farDepth + nearDepth) / range, w, 0, w);
  z[3] -= 2 * farDepth * nearDepth / range;
  return {x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3],
          z[0], z[1], z[2], z[3], w[0], w[1], w[2], w[3]};
}

}  // namespace illum
