#include "normals/grid_laplacian.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace illum {
namespace {

constexpr int kCoarsestPixels = 64;
constexpr int kSmoothings = 2;  // before and after each coarse correction
constexpr int kCoarsestSmoothings = 60;

template <typename Row>
void forRows(int height, Row row) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) row(y);
  });
}

/// Rows are summed up by themselves, then in order: the same on any number of threads.
template <typename Term>
double sumOf(Size size, Term term) {
  std::vector<double> rows(static_cast<std::size_t>(size.height));
  forRows(size.height, [&](int y) {
    const auto width = static_cast<std::size_t>(size.width);
    const std::size_t first = static_cast<std::size_t>(y) * width;
    double sum = 0;
    for (std::size_t i = first; i < first + width; ++i) sum += term(i);
    rows[static_cast<std::size_t>(y)] = sum;
  });
  double sum = 0;
  for (const double row : rows) sum += row;
  return sum;
}

template <typename Step>
void forPixels(Size size, Step step) {
  forRows(size.height, [&](int y) {
    const auto width = static_cast<std::size_t>(size.width);
    const std::size_t first = static_cast<std::size_t>(y) * width;
    for (std::size_t i = first; i < first + width; ++i) step(i);
  });
}

/// visit(weight, index of the neighbour), for the neighbours that there are.
template <typename Visit>
void forNeighbours(const GridEdges& edges, int x, int y, Visit visit) {
  const auto width = static_cast<std::size_t>(edges.size.width);
  const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
  if (x > 0) visit(edges.right[i - 1], i - 1);
  if (x + 1 < edges.size.width) visit(edges.right[i], i + 1);
  if (y > 0) visit(edges.down[i - width], i - width);
  if (y + 1 < edges.size.height) visit(edges.down[i], i + width);
}

/// Gauss and Seidel on the pixels of one colour of a chessboard, which are not joined to each
/// other.
void smooth(const GridEdges& edges, std::span<const float> rightSide, std::span<float> z,
            int colour) {
  forRows(edges.size.height, [&](int y) {
    for (int x = (y + colour) & 1; x < edges.size.width; x += 2) {
      float sum = 0, weights = 0;
      forNeighbours(edges, x, y, [&](float weight, std::size_t j) {
        sum += weight * z[j];
        weights += weight;
      });
      const std::size_t i = Size{edges.size.width, y}.pixels() + static_cast<std::size_t>(x);
      if (weights > 0) z[i] = (rightSide[i] + sum) / weights;
    }
  });
}

/// Two by two pixels become one. An edge of the coarse grid stands for the two that cross it; the
/// half of their sum is what a grid of twice the spacing has (D. Braess, "Towards algebraic
/// multigrid for elliptic problems of second order", 1995).
GridEdges coarser(const GridEdges& fine) {
  GridEdges coarse;
  coarse.size = {(fine.size.width + 1) / 2, (fine.size.height + 1) / 2};
  coarse.right.assign(coarse.size.pixels(), 0);
  coarse.down.assign(coarse.size.pixels(), 0);
  for (int y = 0; y < fine.size.height; ++y) {
    for (int x = 0; x < fine.size.width; ++x) {
      const std::size_t i = Size{fine.size.width, y}.pixels() + static_cast<std::size_t>(x);
      const std::size_t j =
          Size{coarse.size.width, y / 2}.pixels() + static_cast<std::size_t>(x / 2);
      if ((x & 1) != 0) coarse.right[j] += 0.5F * fine.right[i];
      if ((y & 1) != 0) coarse.down[j] += 0.5F * fine.down[i];
    }
  }
  return coarse;
}

}  // namespace

void applyLaplacian(const GridEdges& edges, std::span<const double> z, std::span<double> out) {
  forRows(edges.size.height, [&](int y) {
    for (int x = 0; x < edges.size.width; ++x) {
      const std::size_t i = Size{edges.size.width, y}.pixels() + static_cast<std::size_t>(x);
      double sum = 0;
      forNeighbours(edges, x, y,
                    [&](float weight, std::size_t j) { sum += weight * (z[i] - z[j]); });
      out[i] = sum;
    }
  });
}

MultigridCycle::MultigridCycle(GridEdges edges) {
  levels_.push_back({std::move(edges), {}, {}});
  while (levels_.back().edges.size.pixels() > kCoarsestPixels)
    levels_.push_back({coarser(levels_.back().edges), {}, {}});
  for (Level& level : levels_) {
    level.z.resize(level.edges.size.pixels());
    level.right.resize(level.edges.size.pixels());
  }
}

void MultigridCycle::apply(std::span<const double> residual, std::span<double> z) {
  Level& finest = levels_.front();
  forPixels(finest.edges.size,
            [&](std::size_t i) { finest.right[i] = static_cast<float>(residual[i]); });
  cycle(0);
  forPixels(finest.edges.size, [&](std::size_t i) { z[i] = finest.z[i]; });
}

// Red, black, ... going down and black, red, ... coming up: together a symmetrical operator.
void MultigridCycle::cycle(std::size_t index) {
  Level& level = levels_[index];
  const GridEdges& edges = level.edges;
  std::fill(level.z.begin(), level.z.end(), 0.0F);
  const bool coarsest = index + 1 == levels_.size();
  const int smoothings = coarsest ? kCoarsestSmoothings : kSmoothings;
  for (int k = 0; k < smoothings; ++k) {
    smooth(edges, level.right, level.z, 0);
    smooth(edges, level.right, level.z, 1);
  }
  if (!coarsest) {
    Level& coarse = levels_[index + 1];
    const Size size = edges.size;
    forRows(coarse.edges.size.height, [&](int row) {
      float* const sums = coarse.right.data() + Size{coarse.edges.size.width, row}.pixels();
      std::fill(sums, sums + coarse.edges.size.width, 0.0F);
      for (int y = 2 * row; y < std::min(2 * row + 2, size.height); ++y) {
        for (int x = 0; x < size.width; ++x) {
          const std::size_t i = Size{size.width, y}.pixels() + static_cast<std::size_t>(x);
          float rest = level.right[i];
          forNeighbours(edges, x, y, [&](float weight, std::size_t j) {
            rest -= weight * (level.z[i] - level.z[j]);
          });
          sums[x / 2] += rest;
        }
      }
    });
    cycle(index + 1);
    forRows(size.height, [&](int y) {
      const float* const corrections =
          coarse.z.data() + Size{coarse.edges.size.width, y / 2}.pixels();
      float* const row = level.z.data() + Size{size.width, y}.pixels();
      for (int x = 0; x < size.width; ++x) row[x] += corrections[x / 2];
    });
  }
  for (int k = 0; k < smoothings; ++k) {
    smooth(edges, level.right, level.z, 1);
    smooth(edges, level.right, level.z, 0);
  }
}

// Conjugate gradients, preconditioned (M. R. Hestenes, E. Stiefel 1952). L has the constants for a
// null space; a right side without them keeps all directions free of it but for rounding, which
// does no harm because they do not change L z.
int solveLaplacian(const GridEdges& edges, std::span<const double> rightSide, std::span<double> z,
                   double tolerance, int mostSteps) {
  const Size size = edges.size;
  MultigridCycle inverse(edges);
  std::vector<double> r(size.pixels()), p(size.pixels()), q(size.pixels());
  applyLaplacian(edges, z, r);
  forPixels(size, [&](std::size_t i) { r[i] = rightSide[i] - r[i]; });
  const auto dotOf = [&](std::span<const double> a, std::span<const double> b) {
    return sumOf(size, [&](std::size_t i) { return a[i] * b[i]; });
  };
  const double goal = tolerance * tolerance * dotOf(rightSide, rightSide);
  double before = 0;
  for (int step = 0; step < mostSteps; ++step) {
    if (dotOf(r, r) <= goal) return step;
    inverse.apply(r, q);
    const double now = dotOf(r, q);
    const double beta = step == 0 ? 0 : now / before;
    forPixels(size, [&](std::size_t i) { p[i] = q[i] + beta * p[i]; });
    applyLaplacian(edges, p, q);
    const double alpha = now / dotOf(p, q);
    forPixels(size, [&](std::size_t i) {
      z[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    });
    before = now;
  }
  return mostSteps;
}

}  // namespace illum
