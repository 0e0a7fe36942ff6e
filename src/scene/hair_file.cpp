#include "scene/hair_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "illum/error.h"

namespace illum {
namespace {

constexpr double kFar = 1e9;

std::array<float, 4> pointOf(Vector3 p, double radius) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
          static_cast<float>(radius)};
}

std::string_view withoutCommentAndBlanks(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

/// Three numbers and nothing else.
bool readPoint(std::string_view line, Vector3& point) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (double* value : {&point.x, &point.y, &point.z}) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == ',')) ++at;
    const auto [next, fault] = std::from_chars(at, end, *value);
    if (fault != std::errc() || !(std::abs(*value) <= kFar)) return false;
    at = next;
  }
  return at == end;
}

}  // namespace

void addHair(CurveSet& curves, std::span<const Vector3> points, std::array<double, 2> radius) {
  curves.firstPoints.push_back(static_cast<std::uint32_t>(curves.points.size()));
  const std::size_t n = points.size();
  const double step = (radius[1] - radius[0]) / static_cast<double>(n - 1);
  // A uniform cubic B-spline begins in its first point if the one before it is the reflection of
  // the second: (p' + 4 p0 + p1) / 6 = p0 with p' = 2 p0 - p1.
  curves.points.push_back(pointOf(2 * points[0] - points[1], radius[0]));
  for (std::size_t i = 0; i < n; ++i)
    curves.points.push_back(pointOf(points[i], radius[0] + step * static_cast<double>(i)));
  curves.points.push_back(pointOf(2 * points[n - 1] - points[n - 2], radius[1]));
}

std::vector<std::vector<Vector3>> hairsFromText(std::string_view text, const std::string& source) {
  std::vector<std::vector<Vector3>> hairs;
  std::vector<Vector3> hair;
  std::size_t number = 0;
  const auto fail = [&](std::string_view expected, std::string_view found) {
    throw Error(Fault::Input,
                fmt::format("{}:{}: expected {}, found {}", source, number, expected, found));
  };
  const auto finish = [&] {
    if (hair.size() == 1) fail("at least two points to a hair", "one");
    if (!hair.empty()) hairs.push_back(std::move(hair));
    hair.clear();
  };
  while (!text.empty()) {
    ++number;
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view written = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    const std::string_view line = withoutCommentAndBlanks(written);
    if (!line.empty()) {
      if (!readPoint(line, hair.emplace_back())) fail("three numbers", "another line");
    } else if (written.find('#') == std::string_view::npos) {
      finish();
    }
  }
  finish();
  if (hairs.empty()) fail("at least one hair", "none");
  return hairs;
}

}  // namespace illum
