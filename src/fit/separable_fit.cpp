#include "fit/separable_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "fit/bases/light_basis_family.h"
#include "fit/coefficient_fit.h"
#include "fit/leave_one_out.h"
#include "fit/light_weights.h"
#include "fit/orthonormal.h"
#include "fit/table_choice.h"

namespace illum {
namespace {

// Numbers of coefficients that are tried: the paper found 16 to 25 sufficient (section 4.1), and
// relighting costs in proportion.
constexpr std::array kUsualCoefficients{9, 16, 25};
// More coefficients have to be worth their bytes and their time.
constexpr double kCoefficientToleranceDecibels = 0.05;
// What a smaller number of coefficients may gain before the user is told.
constexpr double kWarningDecibels = 0.5;
// The table's share of the error of the fit, at unseen lights or at those fitted, whichever is
// less. An error of this share that goes along with the fit's own changes it by up to 2
// sqrt(share), 0.09 dB. Never less than -90 dB.
constexpr double kTableShare = 1e-4, kLeastTableError = 1e-9;
constexpr int kTableRings = 12;

struct Trial {
  std::unique_ptr<AnalyticBasis> basis;
  CoefficientChoice choice;
  double decibels = 0;
};

Trial trial(const FitOptions& options, int coefficients, std::span<const Direction> lights,
            const Matrix& gram) {
  Trial result;
  result.basis = analyticBasis(options.family, coefficients, litCapOf(lights).domain());
  result.choice = chooseMethod(*result.basis, lights, gram, options);
  result.decibels = meanDecibels(result.choice.errors);
  return result;
}

// The given number of coefficients, or the fewest that do about as well as the best; and a warning
// if the lights cannot support them.
Trial chooseTrial(const FitOptions& options, std::span<const Direction> lights, const Matrix& gram,
                  std::vector<std::string>& warnings) {
  std::vector<Trial> trials;
  for (const int k : kUsualCoefficients) {
    const bool wanted = options.coefficients == 0 || k < options.coefficients;
    if (wanted) trials.push_back(trial(options, k, lights, gram));
  }
  if (options.coefficients != 0) {
    trials.push_back(trial(options, options.coefficients, lights, gram));
  }
  const auto best =
      std::max_element(trials.begin(), trials.end(),
                       [](const Trial& a, const Trial& b) { return a.decibels < b.decibels; });
  if (options.coefficients == 0) {
    const double enough = best->decibels - kCoefficientToleranceDecibels;
    return std::move(*std::find_if(trials.begin(), trials.end(),
                                   [=](const Trial& t) { return t.decibels >= enough; }));
  }
  Trial& chosen = trials.back();
  if (best->decibels > chosen.decibels + kWarningDecibels) {
    warnings.push_back(
        fmt::format("{} lights cannot support {} coefficients: at an unseen light {:.1f} dB are "
                    "expected, with {} "
                    "coefficients {:.1f} dB",
                    lights.size(), options.coefficients, chosen.decibels,
                    best->basis->coefficients(), best->decibels));
  } else if (static_cast<std::size_t>(options.coefficients) > lights.size()) {
    warnings.push_back(
        fmt::format("{} coefficients from {} lights: the regularizer alone decides "
                    "what the lights leave open",
                    options.coefficients, lights.size()));
  }
  return std::move(chosen);
}

// rgb = result * rotated, columns by falling variance of all coefficients' colours over pixels.
Eigen::Matrix3d colourRotation(const ChannelMoments& moments, const Matrix& coefficients) {
  const int n = moments.lights;
  const Matrix square = coefficients.transpose() * coefficients;
  Eigen::Matrix3d covariance;
  for (int c = 0; c < 3; ++c) {
    for (int d = 0; d < 3; ++d) {
      covariance(c, d) = moments.covariance.block(c * n, d * n, n, n).cwiseProduct(square).sum();
    }
  }
  return largestEigenPairs(covariance, 3).vectors;
}

PlaneRotation functionRotation(const AnalyticBasis& basis, std::span<const Direction> lights,
                               const ChannelMoments& moments, const Matrix& coefficients) {
  const std::vector<WeightedDirection> nodes = litDomainQuadrature(lights);
  std::vector<Direction> directions;
  for (const WeightedDirection& node : nodes) directions.push_back(node.direction);
  const Matrix covariance = meanOverChannels(moments.covariance, moments.lights);
  return orthonormalRotation(gramOverDomain(valuesAt(basis, directions), nodes),
                             coefficients * covariance * coefficients.transpose());
}

BasisTable rotatedTable(const AnalyticBasis& basis, const PlaneRotation& rotation,
                        const Matrix& planeMoments, std::span<const Direction> lights,
                        double errorPerChannel) {
  TableRequest request;
  request.domain = basis.domain();
  request.columns = basis.coefficients();
  request.smoothAcrossEquator = basis.smoothAcrossEquator();
  request.planeMoments = planeMoments;
  request.budget = std::max(kTableShare * errorPerChannel, kLeastTableError);
  request.nodes.assign(lights.begin(), lights.end());
  for (const WeightedDirection& node :
       capQuadrature(litCapOf(lights).thetaMaxRadians, kTableRings)) {
    request.nodes.push_back(node.direction);
  }
  request.values = [&](ChartPoint p, std::span<double> out) {
    basis.evaluateOnChart(p, out);
    Eigen::Map<Vector> values(out.data(), static_cast<Eigen::Index>(out.size()));
    values = (rotation.functionsFromOld * values).eval();
  };
  return chooseTable(request);
}

// Plane 3j+c: coefficient j of the rotated functions, channel c of the rotated colours.
PlaneOperator operatorOf(const Matrix& perChannel, const Eigen::Matrix3d& colour) {
  PlaneOperator result;
  result.planes = static_cast<int>(3 * perChannel.rows());
  result.lights = static_cast<int>(perChannel.cols());
  for (int plane = 0; plane < result.planes; ++plane) {
    for (int row = 0; row < 3 * result.lights; ++row) {
      const double value = perChannel(plane / 3, row / 3) * colour(row % 3, plane % 3);
      result.matrix.push_back(static_cast<float>(value));
    }
  }
  result.offset.assign(static_cast<std::size_t>(result.planes), 0.0F);
  return result;
}

std::vector<double> rowMajor(const Matrix& m) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) values.push_back(m(i, j));
  }
  return values;
}

BasisColour separableColour(const Eigen::Matrix3d& colour) {
  BasisColour result;
  result.kind = BasisColour::Kind::Separable;
  for (int i = 0; i < 9; ++i) result.colourMatrix[i] = colour(i / 3, i % 3);
  return result;
}

}  // namespace

Fit fitSeparable(std::span<const Direction> lights, const SampleStatistics& statistics,
                 const FitOptions& options) {
  const ChannelMoments moments = channelMoments(statistics);
  const Matrix gram = meanOverChannels(moments.gram, moments.lights);
  Fit fit;
  const Trial chosen = chooseTrial(options, lights, gram, fit.warnings);
  const AnalyticBasis& basis = *chosen.basis;
  const CoefficientMethod& method = chosen.choice.method;
  const Matrix values = valuesAt(basis, lights);
  const Matrix analytic = coefficientOperator(basis, values, lights, method);

  const PlaneRotation rotation = functionRotation(basis, lights, moments, analytic);
  const Matrix rotated = rotation.planesFromOld * analytic;
  const Matrix planeMoments = rotated * gram * rotated.transpose();
  const double error = std::pow(
      10.0, -std::max(chosen.decibels, meanDecibels(usedErrors(values * analytic, gram))) / 10);
  BasisTable table = rotatedTable(basis, rotation, planeMoments, lights, error);

  const Eigen::Matrix3d colour = colourRotation(moments, rotated);
  fit.basisName = std::string(basis.name());
  fit.coefficients = basis.coefficients();
  fit.leaveOneOutDecibels = chosen.decibels;
  fit.planes = operatorOf(rotated, colour);
  fit.mixing = rowMajor(rotation.functionsFromOld.transpose());
  fit.choices = {fmt::format("coefficients: {} ({})", fit.coefficients,
                             options.coefficients == 0 ? "leave-one-out" : "given"),
                 "fit: " + method.text() + " (leave-one-out where not given)",
                 fmt::format("light table: {0} x {0} samples", table.resolution())};
  fit.basis = LightBasis(std::move(table), separableColour(colour));
  return fit;
}

}  // namespace illum
