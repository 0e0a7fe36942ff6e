// Large sparse systems of one kind: a grid of pixels joined to their four neighbours by springs.
#pragma once

#include <span>
#include <vector>

#include "illum/picture.h"

namespace illum {

/// The weights of a grid's edges, >= 0: right[i] joins pixel i = y * width + x to (x + 1, y),
/// down[i] to (x, y + 1). 0 at the right (lower) margin.
struct GridEdges {
  Size size;
  std::vector<float> right, down;
};

/// L z, where (L z)_i = sum over neighbours j of w_ij (z_i - z_j).
void applyLaplacian(const GridEdges& edges, std::span<const double> z, std::span<double> out);

/// An approximate inverse of L: one cycle of multigrid over grids of half, a quarter, ... of the
/// size. Symmetrical and positive, so that conjugate gradients may be preconditioned by it.
class MultigridCycle {
 public:
  explicit MultigridCycle(GridEdges edges);
  void apply(std::span<const double> residual, std::span<double> z);

 private:
  struct Level {
    GridEdges edges;
    std::vector<float> z, right;  // the unknown and the right side
  };
  void cycle(std::size_t level);

  std::vector<Level> levels_;
};

/// Solves L z = rightSide, whose sum must be 0, up to a constant: |L z - rightSide| <= `tolerance`
/// |rightSide|, or the best after `mostSteps`. `z` holds a first guess. Returns the steps taken.
/// The same on any number of threads.
int solveLaplacian(const GridEdges& edges, std::span<const double> rightSide, std::span<double> z,
                   double tolerance, int mostSteps);

}  // namespace illum
