#include "capture/proxy_mesh.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <charconv>
#include <cmath>

#include "illum/error.h"
#include "lumigraph/range_buffer.h"

namespace illum {
namespace {

constexpr double kMaxCoordinate = 1e9;

class ObjReader {
 public:
  ObjReader(std::string_view text, std::string_view source) : rest_(text), source_(source) {}

  ProxyMesh read() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line_ = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
      ++number_;
      const std::string_view keyword = word();
      if (keyword == "v") readVertex();
      if (keyword == "f") readFace();
    }
    if (mesh_.triangles.empty()) throw wrong("a mesh with at least one face", "none");
    return std::move(mesh_);
  }

 private:
  Error wrong(std::string_view expected, std::string_view found) const {
    return inputError(fmt::format("{}:{}", source_, number_), expected, found.substr(0, 80));
  }
  std::string_view word() {
    const std::size_t begin = line_.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return line_ = {};
    const std::size_t end = std::min(line_.size(), line_.find_first_of(" \t\r", begin));
    const std::string_view found = line_.substr(begin, end - begin);
    line_ = line_.substr(end);
    return found;
  }

  double coordinate() {
    const std::string_view text = word();
    double value = NAN;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || !(std::abs(value) <= kMaxCoordinate)) {
      throw wrong("three coordinates", text);
    }
    return value;
  }
  void readVertex() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    mesh_.positions.push_back({x, y, z});
  }

  // "7", "7/1", "7/1/3" or "-1", the last vertex so far.
  std::uint32_t corner(std::string_view text) const {
    long long index = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), index);
    const auto count = static_cast<long long>(mesh_.positions.size());
    const long long place = index > 0 ? index - 1 : count + index;
    if (result.ec != std::errc() || index == 0 || place < 0 || place >= count) {
      throw wrong(fmt::format("a corner among {} vertices", count), text);
    }
    return static_cast<std::uint32_t>(place);
  }
  void readFace() {
    std::array<std::uint32_t, 3> triangle{};
    int corners = 0;
    for (std::string_view text = word(); !text.empty(); text = word(), ++corners) {
      triangle[std::min<std::size_t>(2, static_cast<std::size_t>(corners))] = corner(text);
      if (corners < 2) continue;
      mesh_.triangles.push_back(triangle);
      triangle[1] = triangle[2];
    }
    if (corners < 3) throw wrong("a face of three corners", fmt::format("{}", corners));
  }

  std::string_view rest_, source_, line_;
  std::size_t number_ = 0;
  ProxyMesh mesh_;
};

}  // namespace

ProxyMesh proxyFromObj(std::string_view text, std::string_view source) {
  return ObjReader(text, source).read();
}

Picture depthOfProxy(const ProxyMesh& mesh, const ViewGeometry& view) {
  const ViewProjector projector(view);
  RangeBuffer buffer(projector);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size()), [&](const auto& r) {
    for (std::size_t t = r.begin(); t < r.end(); ++t) {
      const auto corner = [&](std::size_t i) {
        return buffer.vertex(mesh.positions[mesh.triangles[t][i]]);
      };
      const ScreenVertex a = corner(0), b = corner(1), c = corner(2);
      buffer.drawTriangle(a, b, c);
      buffer.drawTriangle(a, c, b);
    }
  });
  Picture depth(projector.size(), 1);
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const double range = buffer.range(x, y);
      depth.at(x, y, 0) =
          static_cast<float>(range < kNothing ? projector.depthOf(range) : kNothing);
    }
  }
  return depth;
}

}  // namespace illum
