// The face. Proportions after the usual canon (eyes at half the height, thirds from hairline to
// brow, nose and chin); everything in half heights of the head.
#include <cmath>

#include "scene/bust.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

// In the functions below q is p with x = |x|: the face is symmetric.

double skull(Vector3 q) {
  double d = ellipsoidDistance(q, {0, 0.24, -0.12}, {0.66, 0.74, 0.82});
  d = smoothUnion(d, ellipsoidDistance(q, {0, -0.30, 0.20}, {0.50, 0.60, 0.47}), 0.20);
  d = smoothUnion(d, ellipsoidDistance(q, {0, 0.38, 0.34}, {0.48, 0.34, 0.36}), 0.15);  // forehead
  d = smoothUnion(d, rodDistance(q, {0.45, -0.46, -0.04}, {0.13, -0.86, 0.46}, 0.12, 0.11), 0.18);
  d = smoothUnion(d, ellipsoidDistance(q, {0, -0.87, 0.50}, {0.20, 0.14, 0.16}), 0.12);  // chin
  d = smoothUnion(d, ellipsoidDistance(q, {0.39, -0.15, 0.42}, {0.17, 0.12, 0.18}), 0.14);
  return smoothUnion(d, ellipsoidDistance(q, {0.25, -0.24, 0.50}, {0.17, 0.16, 0.155}), 0.12);
}

/// Brow ridge, drawn together above the nose, and the hollows of the eyes under it.
double browAndHollows(Vector3 q, double d) {
  d = smoothUnion(d, rodDistance(q, {0.06, 0.135, 0.69}, {0.26, 0.195, 0.655}, 0.06, 0.06), 0.10);
  d = smoothUnion(d, rodDistance(q, {0.26, 0.195, 0.655}, {0.47, 0.07, 0.45}, 0.06, 0.05), 0.12);
  d = smoothDifference(d, ellipsoidDistance(q, {0.27, 0.035, 0.76}, {0.17, 0.09, 0.15}), 0.08);
  d = smoothDifference(d, ellipsoidDistance(q, {0.13, 0.02, 0.79}, {0.05, 0.09, 0.11}), 0.07);
  return smoothDifference(d, rodDistance(q, {0.035, 0.12, 0.80}, {0.05, 0.24, 0.79}, 0.012, 0.006),
                          0.05);  // frown
}

/// Ball, lids that are parts of a wider ball, and the drilled pupil of classical busts.
double eye(Vector3 q, double d) {
  const Vector3 centre{0.268, -0.005, 0.545};
  const Vector3 e = q - centre;
  if (lengthOf(e) > 0.40) return d;  // out of its reach
  double ball = lengthOf(e) - 0.148;
  const Vector3 pupil{0.262, 0.004, 0.70};
  const double iris = lengthOf(q - pupil);
  ball = smoothDifference(ball, iris - 0.045, 0.015);
  const double lidBall = lengthOf(e) - 0.172;
  // Planes through the corners of the eye; the outer corner a little lower.
  const double tilt = 0.06 * e.x;
  const double upper = -(0.93 * (e.y + tilt) - 0.30 * e.z);
  const double lower = -(-0.95 * (e.y + tilt) - 0.23 * e.z);
  const double upperLid = smoothIntersection(lidBall, upper, 0.02);
  const double lowerLid = smoothIntersection(lidBall + 0.006, lower, 0.02);
  d = smoothUnion(d, smoothUnion(upperLid, lowerLid, 0.01), 0.035);
  return smoothUnion(d, ball, 0.006);
}

double nose(Vector3 q, double d) {
  if (sphereDistance(q, {0, -0.2, 0.8}, 0.7) > 0) return d;  // out of its reach
  double n = rodDistance(q, {0, 0.11, 0.685}, {0, -0.12, 0.80}, 0.062, 0.075);
  n = smoothUnion(n, rodDistance(q, {0, -0.12, 0.80}, {0, -0.325, 0.915}, 0.07, 0.082), 0.05);
  n = smoothUnion(n, sphereDistance(q, {0, -0.335, 0.905}, 0.098), 0.05);
  n = smoothUnion(n, ellipsoidDistance(q, {0.112, -0.362, 0.79}, {0.062, 0.068, 0.11}), 0.06);
  d = smoothUnion(d, n, 0.08);
  d = smoothDifference(d, ellipsoidDistance(q, {0.062, -0.445, 0.835}, {0.03, 0.045, 0.055}), 0.03);
  // From the wings of the nose to the corners of the mouth.
  return smoothDifference(d, rodDistance(q, {0.185, -0.36, 0.76}, {0.30, -0.60, 0.66}, 0.014, 0.01),
                          0.07);
}

double mouth(Vector3 q, double d) {
  if (sphereDistance(q, {0, -0.6, 0.65}, 0.7) > 0) return d;  // out of its reach
  d = smoothUnion(d, ellipsoidDistance(q, {0, -0.57, 0.50}, {0.28, 0.20, 0.215}), 0.12);
  d = smoothUnion(d, rodDistance(q, {0.03, -0.537, 0.70}, {0.22, -0.60, 0.605}, 0.040, 0.012),
                  0.05);
  d = smoothUnion(d, rodDistance(q, {0, -0.652, 0.685}, {0.17, -0.632, 0.62}, 0.050, 0.018), 0.045);
  d = smoothDifference(d, rodDistance(q, {0, -0.590, 0.785}, {0.12, -0.592, 0.745}, 0.012, 0.012),
                       0.025);
  d = smoothDifference(d, rodDistance(q, {0.12, -0.592, 0.745}, {0.25, -0.625, 0.63}, 0.012, 0.01),
                       0.025);
  d = smoothDifference(d, rodDistance(q, {0, -0.44, 0.81}, {0, -0.50, 0.775}, 0.02, 0.022), 0.05);
  return smoothDifference(d, rodDistance(q, {0, -0.755, 0.73}, {0.12, -0.745, 0.68}, 0.03, 0.02),
                          0.09);
}

double ear(Vector3 q, double d) {
  double e = ellipsoidDistance(q, {0.675, -0.10, -0.10}, {0.055, 0.20, 0.125});
  e = smoothDifference(e, ellipsoidDistance(q, {0.735, -0.08, -0.075}, {0.055, 0.13, 0.07}), 0.03);
  return smoothUnion(d, e, 0.05);
}

double neck(Vector3 q, double d) {
  return smoothUnion(d, rodDistance(q, {0, -0.45, -0.22}, {0, -1.2, -0.32}, 0.39, 0.37), 0.12);
}

}  // namespace

double headDistance(Vector3 p) {
  const Vector3 q{std::abs(p.x), p.y, p.z};
  double d = neck(q, skull(q));
  if (p.z < 0.15) return ear(q, d);  // behind the face
  d = browAndHollows(q, d);
  d = mouth(q, d);
  d = nose(q, d);
  d = eye(q, d);
  return ear(q, d);
}

}  // namespace illum
