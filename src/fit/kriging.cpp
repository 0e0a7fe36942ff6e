#include "fit/kriging.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "fit/bases/light_basis_family.h"
#include "fit/leave_one_out.h"

namespace illum {
namespace {

constexpr int kGreatestTrend = 2;

Matrix trendAt(std::span<const Direction> directions, int order) {
  const auto harmonics = analyticBasis(BasisFamily::SphericalHarmonics, (order + 1) * (order + 1),
                                       LightDomain::Sphere);
  Matrix values(directions.size(), harmonics->coefficients());
  std::vector<double> row(static_cast<std::size_t>(values.cols()));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    harmonics->evaluate(directions[i], row);
    for (Eigen::Index k = 0; k < values.cols(); ++k) values(i, k) = row[k];
  }
  return values;
}

Matrix kernelAt(std::span<const Direction> rows, std::span<const Direction> columns,
                const SplineKernel& kernel) {
  Matrix values(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const double cosine = dot(rows[i].vector(), columns[j].vector());
      values(i, j) = kernel(std::clamp(cosine, -1.0, 1.0));
    }
  }
  return values;
}

// An orthonormal basis of what the trend functions do not reach: N^T F = 0.
Matrix complementOf(const Matrix& trend) {
  const Eigen::HouseholderQR<Matrix> qr(trend);
  const Matrix q = qr.householderQ();
  return q.rightCols(trend.rows() - trend.cols());
}

// Directions all over the domain, evenly (Fibonacci spiral).
std::vector<Direction> probes(LightDomain domain) {
  constexpr int kProbes = 400;
  const double zSpan = domain == LightDomain::Sphere ? 2 : 1;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Direction> directions;
  for (int i = 0; i < kProbes; ++i) {
    const double z = 1 - zSpan * (i + 0.5) / kProbes;
    directions.push_back(
        Direction::fromAngles(std::acos(z), std::remainder(golden * i, 2 * std::numbers::pi)));
  }
  return directions;
}

// How far a predictor goes astray anywhere in the domain.
struct Excess {
  double noiseGain = 0;  // greatest rms amplification of independent noise in the photographs
  double brightness =
      0;  // greatest predicted rms over pixels, relative to the brightest photograph's
  // Of a light set that surrounds the prediction the gain is at most 1; at the rim of a narrow cap
  // it grows with the distance that is extrapolated over, and 5 is what such sets need.
  bool tolerable() const { return noiseGain <= 5 && brightness <= 1.25; }
};

Excess excessOf(const Kriging& kriging, std::span<const Direction> where, const Matrix& gram) {
  const Matrix w = kriging.weightsAt(where);
  const Matrix product = w * gram;
  const double predicted = product.cwiseProduct(w).rowwise().sum().maxCoeff();
  const double brightest = std::max(gram.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  return {std::sqrt(w.rowwise().squaredNorm().maxCoeff()),
          std::sqrt(std::max(predicted, 0.0) / brightest)};
}

struct Candidate {
  KrigingModel model;
  Vector errors;
  double decibels = 0;
};

// Half decades, from interpolation to almost pure trend.
std::vector<double> nuggetGrid(std::optional<double> fixed) {
  if (fixed) return {*fixed};
  std::vector<double> grid;
  for (int step = -10; step <= 1; ++step) grid.push_back(std::pow(10.0, step / 2.0));
  return grid;
}

// Every order with every trend that the lights support. The cost grows with the cube of the number
// of lights; many lights leave less to choose.
std::vector<KrigingModel> shapes(std::span<const Direction> lights) {
  const bool many = lights.size() > 200;
  const std::vector<double> orders =
      many ? std::vector<double>{1.5, 2, 2.5} : std::vector<double>{1.25, 1.5, 1.75, 2, 2.5, 3};
  std::vector<KrigingModel> list;
  for (int trend = 0; trend <= (many ? 1 : kGreatestTrend); ++trend) {
    if (!trendIsSupported(lights, trend)) break;
    for (const double order : orders) list.push_back({order, trend, 0});
  }
  return list;
}

std::vector<Candidate> candidates(std::span<const Direction> lights, const Matrix& gram,
                                  std::optional<double> nugget) {
  const std::vector<double> nuggets = nuggetGrid(nugget);
  const std::vector<KrigingModel> list = shapes(lights);
  std::vector<Candidate> all(list.size() * nuggets.size());
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
    const Matrix errors =
        krigingLeaveOneOut(lights, list[i].splineOrder, list[i].trendOrder, nuggets, gram);
    for (std::size_t j = 0; j < nuggets.size(); ++j) {
      Candidate& candidate = all[i * nuggets.size() + j];
      candidate.model = {list[i].splineOrder, list[i].trendOrder, nuggets[j]};
      candidate.errors = errors.col(static_cast<Eigen::Index>(j));
      candidate.decibels = meanDecibels(candidate.errors);
    }
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.decibels > b.decibels; });
  return all;
}

}  // namespace

bool trendIsSupported(std::span<const Direction> lights, int order) {
  const std::size_t functions = static_cast<std::size_t>(order + 1) * (order + 1);
  // One light beyond what the trend takes, or there is no error left to choose by.
  if (order > 0 && lights.size() <= functions) return false;
  // Singular values of the trend, squared.
  const Matrix trend = trendAt(lights, order);
  const Matrix moments = trend.transpose() * trend;
  const Vector squared = largestEigenPairs(moments, static_cast<int>(moments.rows())).values;
  return squared[squared.size() - 1] > 1e-8 * squared[0];
}

Kriging::Kriging(std::span<const Direction> lights, KrigingModel model)
    : lights_(lights.begin(), lights.end()), model_(model), kernel_(model.splineOrder) {
  assert(!lights.empty());
  const Matrix trend = trendAt(lights, model.trendOrder);
  Matrix a = kernelAt(lights, lights, kernel_);
  // Lights in the same direction make the covariance singular; this is far below any photograph's
  // noise.
  a.diagonal().array() += std::max(model.nugget, 1e-10);
  // Q = N (N^T A N)^-1 N^T, which stays accurate where A itself is nearly singular.
  const Matrix complement = complementOf(trend);
  const Matrix inner = complement.transpose() * a * complement;
  kernelWeights_ = complement * solveSymmetric(inner, complement.transpose());
  // Kriging's weights w = Q k + T f solve A w + F mu = k, F^T w = f: T = (I - Q A) F (F^T F)^-1.
  const Matrix pseudo = solveSymmetric(trend.transpose() * trend, trend.transpose()).transpose();
  trendWeights_ = pseudo - kernelWeights_ * (a * pseudo);
}

void Kriging::weights(Direction d, std::span<double> weights) const {
  assert(weights.size() == lights_.size());
  const Matrix row = weightsAt({&d, 1});
  std::copy(row.data(), row.data() + row.size(), weights.begin());
}

Matrix Kriging::weightsAt(std::span<const Direction> directions) const {
  return kernelAt(directions, lights_, kernel_) * kernelWeights_ +
         trendAt(directions, model_.trendOrder) * trendWeights_.transpose();
}

Matrix krigingLeaveOneOut(std::span<const Direction> lights, double splineOrder, int trendOrder,
                          std::span<const double> nuggets, const Matrix& gram) {
  const Matrix complement = complementOf(trendAt(lights, trendOrder));
  const Matrix covariance = kernelAt(lights, lights, SplineKernel(splineOrder));
  const int m = static_cast<int>(complement.cols());
  const EigenPairs pairs = largestEigenPairs(complement.transpose() * covariance * complement, m);
  const Matrix b = complement * pairs.vectors;
  const Matrix inner = b.transpose() * gram * b;
  Matrix errors(lights.size(), nuggets.size());
  for (std::size_t j = 0; j < nuggets.size(); ++j) {
    // Q = B diag(1 / (eigenvalue + nugget)) B^T.
    const Vector inverse = (pairs.values.array().max(0.0) + std::max(nuggets[j], 1e-10)).inverse();
    const Matrix scaled = b * inverse.asDiagonal();
    const Vector own = scaled.cwiseProduct(b).rowwise().sum();
    const Matrix product = scaled * inner;
    const Vector squared = product.cwiseProduct(scaled).rowwise().sum().cwiseMax(0.0);
    for (Eigen::Index i = 0; i < own.size(); ++i) {
      errors(i, j) =
          own[i] > 1e-12 ? squared[i] / (own[i] * own[i]) : std::numeric_limits<double>::infinity();
    }
  }
  return errors;
}

KrigingChoice chooseKriging(std::span<const Direction> lights, const Matrix& gram,
                            LightDomain domain, std::optional<double> nugget) {
  assert(!lights.empty());
  if (lights.size() == 1) return {{2, 0, nugget.value_or(1e-2)}, gram.diagonal()};
  const std::vector<Direction> where = probes(domain);
  const std::vector<Candidate> all = candidates(lights, gram, nugget);
  const Candidate* tamest = nullptr;
  double leastGain = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : all) {
    const Excess excess = excessOf(Kriging(lights, candidate.model), where, gram);
    if (excess.tolerable()) return {candidate.model, candidate.errors};
    if (excess.noiseGain < leastGain) {
      leastGain = excess.noiseGain;
      tamest = &candidate;
    }
  }
  return {tamest->model, tamest->errors};
}

}  // namespace illum
