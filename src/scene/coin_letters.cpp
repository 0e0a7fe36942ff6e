#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "illum/error.h"
#include "scene/coin.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

struct Stroke {
  double x0, y0, x1, y1;  // letters are 1 high
};
struct Letter {
  char name;
  double width;
  std::vector<Stroke> strokes;
};

const std::vector<Letter>& letters() {
  static const std::vector<Letter> kLetters{
      {'A', 0.72, {{0, 0, 0.36, 1}, {0.36, 1, 0.72, 0}, {0.13, 0.36, 0.59, 0.36}}},
      {'G',
       0.72,
       {{0.70, 0.80, 0.50, 0.99},
        {0.50, 0.99, 0.24, 0.97},
        {0.24, 0.97, 0.04, 0.72},
        {0.04, 0.72, 0.04, 0.28},
        {0.04, 0.28, 0.24, 0.03},
        {0.24, 0.03, 0.50, 0.01},
        {0.50, 0.01, 0.70, 0.18},
        {0.70, 0.18, 0.70, 0.45},
        {0.70, 0.45, 0.44, 0.45}}},
      {'H', 0.66, {{0, 0, 0, 1}, {0.66, 0, 0.66, 1}, {0, 0.52, 0.66, 0.52}}},
      {'I', 0.02, {{0, 0, 0, 1}}},
      {'L', 0.50, {{0, 0, 0, 1}, {0, 0, 0.50, 0}}},
      {'M',
       0.84,
       {{0, 0, 0.08, 1}, {0.08, 1, 0.42, 0.2}, {0.42, 0.2, 0.76, 1}, {0.76, 1, 0.84, 0}}},
      {'P',
       0.54,
       {{0, 0, 0, 1},
        {0, 1, 0.36, 1},
        {0.36, 1, 0.54, 0.86},
        {0.54, 0.86, 0.54, 0.62},
        {0.54, 0.62, 0.36, 0.48},
        {0.36, 0.48, 0, 0.48}}},
      {'R',
       0.58,
       {{0, 0, 0, 1},
        {0, 1, 0.36, 1},
        {0.36, 1, 0.54, 0.86},
        {0.54, 0.86, 0.54, 0.64},
        {0.54, 0.64, 0.36, 0.50},
        {0.36, 0.50, 0, 0.50},
        {0.30, 0.50, 0.58, 0}}},
      {'U',
       0.64,
       {{0, 1, 0, 0.28},
        {0, 0.28, 0.14, 0.05},
        {0.14, 0.05, 0.32, 0},
        {0.32, 0, 0.50, 0.05},
        {0.50, 0.05, 0.64, 0.28},
        {0.64, 0.28, 0.64, 1}}}};
  return kLetters;
}

const Letter& letterOf(char name) {
  const auto found = std::ranges::find(letters(), name, &Letter::name);
  if (found == letters().end()) throw Error(Fault::Input, "expected a letter that the coin has");
  return *found;
}

double distanceTo(const Letter& letter, double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Stroke& s : letter.strokes) {
    const Vector3 a{s.x0, s.y0, 0}, b{s.x1, s.y1, 0};
    nearest = std::min(nearest, rodDistance({x, y, 0}, a, b, 0, 0));
  }
  return nearest;
}

}  // namespace

double distanceToLetters(std::string_view text, double radius, double letterHeight, double x,
                         double y) {
  constexpr double kGap = 0.42;  // between letters, of their height
  double length = -kGap;
  for (const char c : text) length += letterOf(c).width + kGap;
  // Along the line of the letters and up from it, in letter heights.
  const double along = std::atan2(x, y) * radius / letterHeight + 0.5 * length;
  const double up = (std::hypot(x, y) - radius) / letterHeight;
  double left = 0, nearest = std::numeric_limits<double>::infinity();
  for (const char c : text) {
    const Letter& letter = letterOf(c);
    nearest = std::min(nearest, distanceTo(letter, along - left, up));
    left += letter.width + kGap;
  }
  return letterHeight * nearest;
}

}  // namespace illum
