#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "illum/error.h"
#include "illum/normals.h"
#include "normals/grid_laplacian.h"

namespace illum {
namespace {

// A slope p = tan(t) has the error dt / cos^2(t) for an error dt of the normal, so that its weight
// is cos^4(t) = n_z^4. Below this n_z slopes say little but that they are steep.
constexpr double kSteepest = 0.1;

// Of edges at pixels without a normal: enough to carry heights over, too little to bend surfaces.
constexpr double kFreeWeight = 1e-3;

constexpr double kTolerance = 1e-6;
constexpr int kMostSteps = 300;

struct Slope {
  double x = 0, y = 0;  ///< dz/dx to the right, dz/dy upward
  double weight = 0;    ///< 0: unknown
};

Slope slopeOf(const float* n) {
  if (n[0] == 0 && n[1] == 0 && n[2] == 0) return {};
  const double across = std::hypot(n[0], n[1]);
  const double z = std::max<double>(n[2], kSteepest);
  // Of what is too steep only the steepness is cut, not the side to which it falls.
  const double kept =
      n[2] >= kSteepest ? 1 : std::sqrt(1 - kSteepest * kSteepest) / std::max(across, 1e-6);
  return {-kept * n[0] / z, -kept * n[1] / z, z * z * z * z};
}

void checkNormals(const Picture& normals) {
  if (normals.channels() != 3 || normals.empty()) {
    throw Error(Fault::Input, fmt::format("normals: expected a picture of 3 channels, found {}",
                                          normals.channels()));
  }
  const auto samples = normals.samples();
  if (!std::all_of(samples.begin(), samples.end(), [](float s) { return std::isfinite(s); }))
    throw Error(Fault::Input, "normals: expected finite numbers, found others");
}

/// sum over edges (i, j) of w_ij (z_j - z_i - g_ij)^2, to be made least: L z = the divergence of w
/// g.
struct Springs {
  GridEdges edges;
  std::vector<double> divergence;

  explicit Springs(Size size) {
    edges.size = size;
    edges.right.assign(size.pixels(), 0);
    edges.down.assign(size.pixels(), 0);
    divergence.assign(size.pixels(), 0);
  }
  void join(std::size_t i, std::size_t j, double weight, double rise, std::vector<float>& weights) {
    weights[i] = static_cast<float>(weight);
    divergence[i] -= weights[i] * rise;
    divergence[j] += weights[i] * rise;
  }
};

/// Between two pixels the surface rises by the mean of their slopes.
Springs springsOf(const Picture& normals, double pixelSide) {
  const Size size = normals.size();
  Springs springs(size);
  const auto slopeAt = [&](int x, int y) { return slopeOf(&normals.at(x, y, 0)); };
  const auto weightOf = [](const Slope& a, const Slope& b) {
    return a.weight > 0 && b.weight > 0 ? std::sqrt(a.weight * b.weight) : kFreeWeight;
  };
  const auto known = [](const Slope& a, const Slope& b) { return a.weight > 0 && b.weight > 0; };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const std::size_t i = Size{size.width, y}.pixels() + static_cast<std::size_t>(x);
      const Slope here = slopeAt(x, y);
      if (x + 1 < size.width) {
        const Slope right = slopeAt(x + 1, y);
        const double rise = known(here, right) ? pixelSide * (here.x + right.x) / 2 : 0;
        springs.join(i, i + 1, weightOf(here, right), rise, springs.edges.right);
      }
      if (y + 1 < size.height) {
        const Slope below = slopeAt(x, y + 1);
        const double rise = known(here, below) ? -pixelSide * (here.y + below.y) / 2 : 0;
        springs.join(i, i + static_cast<std::size_t>(size.width), weightOf(here, below), rise,
                     springs.edges.down);
      }
    }
  }
  return springs;
}

/// Of pixels that have a normal.
double meanOf(std::span<const double> z, const Picture& normals) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const float* n = normals.samples().data() + 3 * i;
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
    sum += z[i];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

Picture integrateHeights(const Picture& normals, double pixelSide) {
  checkNormals(normals);
  const Size size = normals.size();
  std::vector<double> z(size.pixels());
  {
    const Springs springs = springsOf(normals, pixelSide);
    solveLaplacian(springs.edges, springs.divergence, z, kTolerance, kMostSteps);
  }
  const double mean = meanOf(z, normals);
  Picture heights(size, 1);
  for (std::size_t i = 0; i < z.size(); ++i) heights.samples()[i] = static_cast<float>(z[i] - mean);
  return heights;
}

Picture photographHeights(const Picture& normals) {
  return integrateHeights(normals, 2.0 / std::max(normals.width(), normals.height()));
}

Picture photographHeights(const Object& object, int group, const NormalOptions& options) {
  if (group >= 0 && group < object.groups() &&
      !std::holds_alternative<OrthographicView>(object.view(group).geometry)) {
    throw Error(Fault::Usage,
                fmt::format("{}: heights are integrated for photographs, this view is none",
                            object.path().string()));
  }
  return photographHeights(surfaceNormals(object, group, options));
}

}  // namespace illum
