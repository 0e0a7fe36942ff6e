#include "fit/learned_basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/kriging.h"
#include "fit/leave_one_out.h"
#include "fit/light_weights.h"
#include "fit/orthonormal.h"
#include "fit/principal_planes.h"
#include "fit/table_choice.h"

namespace illum {
namespace {

// The table's share of the error at an unseen light: 0.01 dB.
constexpr double kTableShare = 0.002;
constexpr int kTableRings = 12;

// Rotates the planes into the form that is stored; see orthonormalRotation.
void makeOrthonormal(PrincipalPlanes& planes, const Kriging& kriging,
                     std::span<const Direction> lights) {
  const std::vector<WeightedDirection> nodes = litDomainQuadrature(lights);
  std::vector<Direction> directions;
  for (const WeightedDirection& node : nodes) directions.push_back(node.direction);
  const Matrix weights = kriging.weightsAt(directions);
  const int count = static_cast<int>(planes.variances.size());
  const int n = kriging.lights();
  Matrix gram = Matrix::Zero(count, count);
  for (int c = 0; c < 3; ++c) {
    gram += gramOverDomain(weights * planes.functions.middleRows(c * n, n), nodes);
  }
  const PlaneRotation rotation = orthonormalRotation(gram, planes.variances.asDiagonal());
  planes.functions = planes.functions * rotation.functionsFromOld.transpose();
  planes.analysis = rotation.planesFromOld * planes.analysis;
  planes.variances =
      (rotation.planesFromOld * planes.variances.asDiagonal() * rotation.planesFromOld.transpose())
          .diagonal();
}

std::vector<Direction> tableNodes(std::span<const Direction> lights) {
  std::vector<Direction> nodes(lights.begin(), lights.end());
  for (const WeightedDirection& node :
       capQuadrature(litCapOf(lights).thetaMaxRadians, kTableRings)) {
    nodes.push_back(node.direction);
  }
  return nodes;
}

// The greatest rms amplification of the photographs' noise under a light above the horizon.
double noiseGain(const Kriging& kriging) {
  std::vector<Direction> directions;
  for (const WeightedDirection& node : capQuadrature(std::numbers::pi / 2, kTableRings))
    directions.push_back(node.direction);
  return std::sqrt(kriging.weightsAt(directions).rowwise().squaredNorm().maxCoeff());
}

// How far from the lights the interpolation is believed. Beyond, lights that stand in a narrow cap
// tell nothing, and what is predicted there is amplified noise, the more of it the farther out. So
// a light beyond does what one at the cap's edge does that stands at the same side, weaker as a
// level surface has it: by the cosine. The edge is soft, two mean spacings wide, for a table with
// a crease in it takes more bytes; half of that, which is what is believed, is as far as
// leave-one-out has tried it. Interpolation that stays calm to the horizon is believed everywhere.
class Reach {
 public:
  Reach(const Kriging& kriging, std::span<const Direction> lights, bool displayReferred)
      : edge_(litCapOf(lights).thetaMaxRadians),
        width_(2 * meanSpacingRadians(lights)),
        exponent_(displayReferred ? 1 / kDisplayGamma : 1) {
    if (noiseGain(kriging) <= kCalm) edge_ = std::numbers::pi;
  }

  struct Believed {
    Direction direction;
    double factor = 1;
  };
  Believed believed(Direction d) const {
    const double beyond = d.thetaRadians() - edge_;
    if (edge_ + 0.5 * width_ >= std::numbers::pi / 2 || beyond <= 0) return {d};
    const double x = std::min(beyond, width_);
    const double theta = edge_ + x - 0.5 * x * x / width_;
    const double cosine = std::max(0.0, d.z()) / std::cos(theta);
    return {Direction::fromAngles(theta, d.phiRadians()), std::pow(cosine, exponent_)};
  }

 private:
  // sRGB's curve is about a power of this, and a factor of light about one of its values.
  static constexpr double kDisplayGamma = 2.2;
  static constexpr double kCalm = 1.5;
  double edge_, width_, exponent_;
};

// Columns 3k..3k+2: plane k's colour; the last three: the mean picture's.
BasisTable tableOf(const PrincipalPlanes& planes, const Kriging& kriging, const Vector& mean,
                   std::span<const Direction> lights, const Reach& reach, double errorPerChannel) {
  const int count = static_cast<int>(planes.variances.size()), n = kriging.lights();
  // Row c*n+l of [functions mean], as lights x (columns): one product a direction.
  Matrix columns(n, 3 * count + 3);
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < count; ++k)
      columns.col(3 * k + c) = planes.functions.col(k).segment(c * n, n);
    columns.col(3 * count + c) = mean.segment(c * n, n);
  }
  TableRequest request;
  request.domain = litCapOf(lights).domain();
  request.columns = static_cast<int>(columns.cols());
  Vector squares = Vector::Ones(columns.cols());  // planes are uncorrelated, of mean 0
  for (int k = 0; k < count; ++k) squares.segment(3 * k, 3).setConstant(planes.variances[k]);
  request.planeMoments = squares.asDiagonal();
  request.budget = 3 * kTableShare * errorPerChannel;
  request.nodes = tableNodes(lights);
  request.values = [&](ChartPoint p, std::span<double> out) {
    const auto [direction, factor] = reach.believed(directionFromChart(p));
    Eigen::Map<Eigen::RowVectorXd>(out.data(), columns.cols()) =
        factor * kriging.weightsAt({&direction, 1}) * columns;
  };
  return chooseTable(request);
}

PlaneOperator operatorOf(const PrincipalPlanes& planes, const Vector& mean, int lights) {
  PlaneOperator result;
  result.planes = static_cast<int>(planes.analysis.rows());
  result.lights = lights;
  const Vector offset = -(planes.analysis * mean);
  for (int k = 0; k < result.planes; ++k) {
    for (int row = 0; row < 3 * lights; ++row) {
      const int at = row % 3 * lights + row / 3;  // row 3l+c of the samples, c*lights+l here
      result.matrix.push_back(static_cast<float>(planes.analysis(k, at)));
    }
    result.offset.push_back(static_cast<float>(offset[k]));
  }
  return result;
}

std::string modelText(const KrigingModel& model, bool nuggetGiven) {
  return fmt::format(
      "interpolation: kriging, spline of order {}, trend of order {} (leave-one-out), "
      "nugget {:.2g} ({})",
      model.splineOrder, model.trendOrder, model.nugget, nuggetGiven ? "given" : "leave-one-out");
}

void warnOfUnused(const FitOptions& options, Fit& fit) {
  if (options.coefficients != 0 || options.solidAngleWeights || options.extension ||
      options.projection) {
    fit.warnings.push_back(
        "the learned basis has no coefficients, light weights, extension or "
        "projection: these options have no effect");
  }
}

}  // namespace

Fit fitLearned(std::span<const Direction> lights, const SampleStatistics& statistics,
               const FitOptions& options) {
  const ChannelMoments moments = channelMoments(statistics);
  const Matrix gram = meanOverChannels(moments.gram, moments.lights);
  const KrigingChoice choice =
      chooseKriging(lights, gram, litCapOf(lights).domain(), options.regularizer);
  const Kriging kriging(lights, choice.model);

  Fit fit;
  fit.basisName = "learned";
  fit.leaveOneOutDecibels = meanDecibels(choice.errors);
  const bool alone = lights.size() == 1;
  fit.choices.push_back(alone ? "one light: the same from every direction"
                              : modelText(choice.model, options.regularizer.has_value()));
  const int wanted =
      options.planes > 0 ? options.planes : choosePlaneCount(lights, moments, choice.model);
  PrincipalPlanes planes = principalPlanes(kriging, lights, moments, wanted);
  makeOrthonormal(planes, kriging, lights);
  const int count = static_cast<int>(planes.variances.size());
  if (count < options.planes) {
    fit.warnings.push_back(fmt::format("{} planes asked for, but {} lights give no more than {}",
                                       options.planes, lights.size(), count));
  }
  fit.choices.push_back(fmt::format("planes: {} ({})", count,
                                    options.planes > 0 ? "given"
                                    : alone            ? "all there are"
                                                       : "cross-validation"));
  const double errorPerChannel = std::pow(10.0, -fit.leaveOneOutDecibels / 10);
  BasisTable table = tableOf(planes, kriging, moments.mean, lights,
                             Reach(kriging, lights, options.displayReferred), errorPerChannel);
  fit.choices.push_back(fmt::format("light table: {0} x {0} samples", table.resolution()));
  BasisColour colour;
  colour.kind = BasisColour::Kind::Full;
  fit.basis = LightBasis(std::move(table), colour);
  fit.planes = operatorOf(planes, moments.mean, moments.lights);
  warnOfUnused(options, fit);
  return fit;
}

}  // namespace illum
