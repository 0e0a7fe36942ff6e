#include "lumigraph/depth_mesh.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace illum {
namespace {

// Of a step between neighbours, in widths of a pixel: about 72 degrees.
constexpr double kSteepestStep = 3;
// In pixels: where bilinear coverage ends; not quite, or it would touch the next centre.
constexpr double kFringe = 0.98;
// Less is an outline, or thinner than a pixel.
constexpr float kWholly = 0.95F;

class DepthMesh {
 public:
  DepthMesh(const ViewProjector& view, const Picture& depth, const Picture* coverage,
            RangeBuffer& buffer)
      : view_(view),
        size_(view.size()),
        outward_(coverage == nullptr ? kFringe : 0.5),
        buffer_(buffer) {
    ranges_.resize(size_.pixels());
    vertices_.resize(size_.pixels());
    tbb::parallel_for(0, size_.height, [&](int y) {
      for (int x = 0; x < size_.width; ++x) {
        const bool shown =
            coverage == nullptr || coverage->at(x, y, coverage->channels() - 1) >= kWholly;
        const double range = shown ? view_.rangeOf(depth.at(x, y, 0)) : kNothing;
        ranges_[at(x, y)] = range > 0 ? range : kNothing;
        if (range < kNothing) {
          vertices_[at(x, y)] = buffer_.vertex(view_.pointAt(x + 0.5, y + 0.5, range));
        }
      }
    });
  }

  void draw() {
    tbb::parallel_for(0, size_.height, [&](int y) {
      for (int x = 0; x < size_.width; ++x) {
        if (!(rangeAt(x, y) < kNothing)) continue;
        if (!isInside(x, y)) drawSquare(x, y);
      }
      for (int x = 0; x < size_.width; ++x) drawCell(x, y);
    });
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
           static_cast<std::size_t>(x);
  }
  int column(int x) const { return view_.wraps() ? (x + size_.width) % size_.width : x; }
  double rangeAt(int x, int y) const {
    x = column(x);
    if (x < 0 || y < 0 || x >= size_.width || y >= size_.height) return kNothing;
    return ranges_[at(x, y)];
  }
  // Toward (x + dx, y + dy), one of them 1 or -1.
  bool joined(int x, int y, int dx, int dy) const {
    const double a = rangeAt(x, y), b = rangeAt(x + dx, y + dy);
    if (!(a < kNothing) || !(b < kNothing)) return false;
    return isJoined(rangeAt(x - dx, y - dy), a, b, rangeAt(x + 2 * dx, y + 2 * dy),
                    kSteepestStep * view_.pixelWidth(std::min(a, b)));
  }
  bool isInside(int x, int y) const {
    return joined(x, y, 1, 0) && joined(x, y, -1, 0) && joined(x, y, 0, 1) && joined(x, y, 0, -1);
  }

  // The square between the centres of four pixels, (x, y) at its top left.
  void drawCell(int x, int y) {
    const int right = column(x + 1);
    if (right >= size_.width || y + 1 >= size_.height) return;
    const bool top = joined(x, y, 1, 0), bottom = joined(x, y + 1, 1, 0);
    const bool left = joined(x, y, 0, 1), rightSide = joined(right, y, 0, 1);
    const ScreenVertex &a = vertices_[at(x, y)], &b = vertices_[at(right, y)],
                       &c = vertices_[at(right, y + 1)], &d = vertices_[at(x, y + 1)];
    // Along the diagonal on which the surface is flatter.
    if (top && bottom && left && rightSide) {
      const bool down = std::abs(rangeAt(x, y) - rangeAt(right, y + 1)) <=
                        std::abs(rangeAt(right, y) - rangeAt(x, y + 1));
      if (down) {
        buffer_.drawTriangle(a, b, c);
        buffer_.drawTriangle(a, c, d);
      } else {
        buffer_.drawTriangle(a, b, d);
        buffer_.drawTriangle(b, c, d);
      }
      return;
    }
    if (top && left) buffer_.drawTriangle(a, b, d);
    if (top && rightSide) buffer_.drawTriangle(a, b, c);
    if (bottom && rightSide) buffer_.drawTriangle(b, c, d);
    if (bottom && left) buffer_.drawTriangle(a, c, d);
  }

  void drawSquare(int x, int y) {
    const auto reach = [&](int dx, int dy) {
      return rangeAt(x + dx, y + dy) < kNothing ? 0.5 : outward_;
    };
    const double range = rangeAt(x, y);
    const double left = x + 0.5 - reach(-1, 0), right = x + 0.5 + reach(1, 0);
    const double top = y + 0.5 - reach(0, -1), bottom = y + 0.5 + reach(0, 1);
    const auto corner = [&](double px, double py) {
      return buffer_.vertex(view_.pointAt(px, py, range));
    };
    const ScreenVertex a = corner(left, top), b = corner(right, top), c = corner(right, bottom),
                       d = corner(left, bottom);
    buffer_.drawTriangle(a, b, c);
    buffer_.drawTriangle(a, c, d);
  }

  const ViewProjector& view_;
  Size size_;
  double outward_;  // how far squares reach toward nothing, in pixels
  RangeBuffer& buffer_;
  std::vector<double> ranges_;
  std::vector<ScreenVertex> vertices_;
};

}  // namespace

bool isJoined(double before, double a, double b, double after, double steepest) {
  const double step = b - a;
  if (!std::isfinite(step)) return false;
  if (std::abs(step) <= steepest) return true;
  const double stepBefore = a - before, stepAfter = after - b;
  if (!std::isfinite(stepBefore) || !std::isfinite(stepAfter)) return false;
  const double sign = step > 0 ? 1 : -1;
  return std::abs(step) <= 2 * sign * stepBefore && std::abs(step) <= 2 * sign * stepAfter;
}

void drawDepth(const ViewProjector& view, const Picture& depth, const Picture* coverage,
               RangeBuffer& buffer) {
  DepthMesh(view, depth, coverage, buffer).draw();
}

}  // namespace illum
