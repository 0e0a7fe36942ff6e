#include "fit/exact_basis.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <vector>

#include "codec/tile.h"
#include "fit/dense.h"
#include "fit/leave_one_out.h"
#include "fit/spherical_delaunay.h"
#include "illum/error.h"

namespace illum {
namespace {

void requireSense(std::size_t lights, const FitOptions& options) {
  if (options.coefficients != 0 || options.planes != 0)
    throw Error(Fault::Usage,
                "the exact basis keeps every photograph: expected neither coefficients nor planes");
  if (constexpr std::size_t most = kMaxPlanes / 3; lights > most)
    throw Error(Fault::Usage, fmt::format("the exact basis: expected at most {} lights from "
                                          "different directions, found {}",
                                          most, lights));
}

// The mean square error of every light's picture as interpolated between all the others.
Vector leftOutErrors(const std::vector<Direction>& lights, const Matrix& gram,
                     const std::vector<int>& rows) {
  const auto count = static_cast<Eigen::Index>(lights.size());
  Matrix smoother = Matrix::Zero(count, count), own(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) own(i, j) = gram(rows[i], rows[j]);
    std::vector<Direction> others = lights;
    others.erase(others.begin() + i);
    delaunayMesh(others).forEachWeight(lights[static_cast<std::size_t>(i)],
                                       [&](std::size_t light, double weight) {
                                         const auto j = static_cast<Eigen::Index>(light);
                                         smoother(i, j < i ? j : j + 1) += weight;
                                       });
  }
  return usedErrors(smoother, own);
}

}  // namespace

Fit fitExact(std::span<const Direction> lights, const SampleStatistics& statistics,
             const FitOptions& options) {
  Fit fit;
  const std::vector<int> first = firstOfSame(lights);
  std::vector<Direction> distinct;
  std::vector<int> rows;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (first[i] != static_cast<int>(i)) {
      fit.warnings.push_back(
          fmt::format("lights {} and {} of those used come from the same direction: the exact "
                      "basis keeps the first",
                      first[i] + 1, i + 1));
      continue;
    }
    distinct.push_back(lights[i]);
    rows.push_back(static_cast<int>(i));
  }
  requireSense(distinct.size(), options);
  auto mesh = std::make_shared<const LightMesh>(delaunayMesh(distinct));
  fit.basisName = "exact";
  fit.coefficients = mesh->lights();
  fit.choices.push_back(fmt::format("interpolation: linear on {} triangles, {} closing directions",
                                    mesh->triangles().size(),
                                    mesh->sites().size() - distinct.size()));
  fit.basis = LightBasis(std::move(mesh));
  fit.planes.planes = fit.basis.planes();
  fit.planes.lights = static_cast<int>(lights.size());
  for (const int row : rows)
    for (int c = 0; c < 3; ++c) fit.planes.picks.push_back(3 * row + c);
  if (distinct.size() > 1) {
    const ChannelMoments moments = channelMoments(statistics);
    const Matrix gram = meanOverChannels(moments.gram, moments.lights);
    fit.leaveOneOutDecibels = meanDecibels(leftOutErrors(distinct, gram, rows));
  } else {
    fit.leaveOneOutDecibels = std::numeric_limits<double>::quiet_NaN();
  }
  return fit;
}

}  // namespace illum
