#include "fit/principal_planes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "fit/leave_one_out.h"
#include "fit/light_weights.h"
#include "fit/orthonormal.h"

namespace illum {
namespace {

constexpr int kFolds = 5;

// Gauss-Legendre rings enough for the products of interpolation weights (see SplineKernel's
// degree).
constexpr int kRings = 24;

// mean over directions of w(d) w(d)^T, half over the lit domain and half over the lights.
Matrix interpolationGram(const Kriging& kriging, std::span<const Direction> lights) {
  const std::vector<WeightedDirection> nodes =
      capQuadrature(litCapOf(lights).thetaMaxRadians, kRings);
  std::vector<Direction> directions;
  for (const WeightedDirection& node : nodes) directions.push_back(node.direction);
  const Matrix atLights = kriging.weightsAt(lights);
  return 0.5 * gramOverDomain(kriging.weightsAt(directions), nodes) +
         0.5 / static_cast<double>(lights.size()) * (atLights.transpose() * atLights);
}

// symmetric = root^T root; inverse is root's pseudo-inverse. Rows below 1e-10 of the largest are
// cut.
struct MatrixRoot {
  Matrix root, inverse;
};

MatrixRoot rootOf(const Matrix& symmetric) {
  const EigenPairs pairs = largestEigenPairs(symmetric, static_cast<int>(symmetric.rows()));
  Eigen::Index rank = 0;
  while (rank < pairs.values.size() && pairs.values[rank] > 1e-10 * pairs.values[0]) ++rank;
  const Vector scale = pairs.values.head(rank).cwiseSqrt();
  const Matrix vectors = pairs.vectors.leftCols(rank);
  return {scale.asDiagonal() * vectors.transpose(), vectors * scale.cwiseInverse().asDiagonal()};
}

// Applies `block` to every channel's rows.
Matrix perChannel(const Matrix& block, const Matrix& rows) {
  Matrix result(3 * block.rows(), rows.cols());
  for (int c = 0; c < 3; ++c) {
    result.middleRows(c * block.rows(), block.rows()).noalias() =
        block * rows.middleRows(c * block.cols(), block.cols());
  }
  return result;
}

// Folds that do not depend on the order of the lights: every fifth along z.
std::vector<int> foldOf(std::span<const Direction> lights) {
  std::vector<int> order(lights.size()), fold(lights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const Vector3 u = lights[a].vector(), v = lights[b].vector();
    return std::tie(u.z, u.y, u.x) < std::tie(v.z, v.y, v.x);
  });
  for (std::size_t rank = 0; rank < order.size(); ++rank) fold[order[rank]] = rank % kFolds;
  return fold;
}

std::vector<Direction> directionsAt(std::span<const Direction> lights, std::span<const int> which) {
  std::vector<Direction> directions;
  for (const int l : which) directions.push_back(lights[l]);
  return directions;
}

std::vector<int> channelRows(std::span<const int> lights, int count) {
  std::vector<int> rows;
  for (int c = 0; c < 3; ++c) {
    for (const int l : lights) rows.push_back(c * count + l);
  }
  return rows;
}

// held x steps: mean square errors at lights `held` with 3, 6, 9, ... planes fitted to lights
// `used`.
Matrix heldOutErrors(std::span<const Direction> lights, const ChannelMoments& moments,
                     KrigingModel model, std::span<const int> used, std::span<const int> held,
                     int steps) {
  const std::vector<Direction> usedLights = directionsAt(lights, used);
  const ChannelMoments usedMoments = selectLights(moments, used);
  while (!trendIsSupported(usedLights, model.trendOrder)) --model.trendOrder;
  const Kriging kriging(usedLights, model);
  const PrincipalPlanes planes = principalPlanes(kriging, usedLights, usedMoments, 3 * steps);
  const Matrix weights = kriging.weightsAt(directionsAt(lights, held));

  // With P uncorrelated, E(x - sum_k g_k P_k)^2 = E x^2 + sum_k (g_k^2 var_k - 2 g_k cov(x, P_k)),
  // where x is the sample less its mean over pixels; the means' own error adds its square.
  const std::vector<int> usedRows = channelRows(used, moments.lights);
  const std::vector<int> heldRows = channelRows(held, moments.lights);
  const Matrix g = perChannel(weights, planes.functions);
  const Matrix cross = moments.covariance(heldRows, usedRows) * planes.analysis.transpose();
  const Vector bias = moments.mean(heldRows) - perChannel(weights, usedMoments.mean);
  const Matrix change =
      g.cwiseProduct(g) * planes.variances.asDiagonal() - 2 * g.cwiseProduct(cross);
  const int heldCount = static_cast<int>(held.size()), planeCount = static_cast<int>(g.cols());
  Matrix errors(heldCount, steps);
  for (int i = 0; i < heldCount; ++i) {
    double error = 0;
    for (int c = 0; c < 3; ++c) {
      const int row = c * heldCount + i;
      error += bias[row] * bias[row] + moments.covariance(heldRows[row], heldRows[row]);
    }
    for (int step = 0; step < steps; ++step) {
      for (int k = 3 * step; k < std::min(3 * step + 3, planeCount); ++k) {
        for (int c = 0; c < 3; ++c) error += change(c * heldCount + i, k);
      }
      errors(i, step) = std::max(error, 0.0) / 3;
    }
  }
  return errors;
}

}  // namespace

PrincipalPlanes principalPlanes(const Kriging& kriging, std::span<const Direction> lights,
                                const ChannelMoments& moments, int count) {
  const MatrixRoot metric = rootOf(interpolationGram(kriging, lights));
  const Matrix half = perChannel(metric.root, moments.covariance);
  const Matrix whitened = perChannel(metric.root, half.transpose());
  const int available = static_cast<int>(whitened.rows());
  const EigenPairs pairs = largestEigenPairs(whitened, std::min(count, available));
  return {perChannel(metric.inverse, pairs.vectors),
          perChannel(metric.root.transpose(), pairs.vectors).transpose(),
          pairs.values.cwiseMax(0.0)};
}

int choosePlaneCount(std::span<const Direction> lights, const ChannelMoments& moments,
                     const KrigingModel& model) {
  const int n = moments.lights;
  if (n < 2 * kFolds) return std::min(3 * n, kGreatestDefaultPlanes);
  const int steps = std::min(kGreatestDefaultPlanes / 3, n - (n + kFolds - 1) / kFolds);
  const std::vector<int> folds = foldOf(lights);
  Matrix errors(n, steps);
  tbb::parallel_for(0, kFolds, [&](int fold) {
    std::vector<int> used, held;
    for (int l = 0; l < n; ++l) (folds[l] == fold ? held : used).push_back(l);
    errors(held, Eigen::all) = heldOutErrors(lights, moments, model, used, held, steps);
  });
  Vector decibels(steps);
  for (int step = 0; step < steps; ++step) decibels[step] = meanDecibels(errors.col(step));
  int chosen = 0;
  while (decibels[chosen] < decibels.maxCoeff() - kPlaneToleranceDecibels) ++chosen;
  return 3 * (chosen + 1);
}

}  // namespace illum
