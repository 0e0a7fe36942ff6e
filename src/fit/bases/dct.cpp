#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "fit/bases/families.h"

namespace illum {
namespace {

// Frequencies of a product of cosines on the square.
struct Frequency {
  int i, j;
};

// Zonal selection: the pairs of lowest i + j, those of lowest i first among equals.
std::vector<Frequency> zone(int count) {
  std::vector<Frequency> frequencies;
  for (int sum = 0; static_cast<int>(frequencies.size()) < count; ++sum) {
    for (int i = 0; i <= sum && static_cast<int>(frequencies.size()) < count; ++i) {
      frequencies.push_back({i, sum - i});
    }
  }
  return frequencies;
}

// Wong et al. 1997, section 4.2: c_i c_j cos(pi i x) cos(pi j y) on the stereographic square, c_0 =
// 1, else sqrt(2): orthonormal on the square (not with respect to solid angle). On the sphere each
// square has functions of its own, which are 0 on the other one.
class ChartCosines final : public AnalyticBasis {
 public:
  ChartCosines(int coefficients, LightDomain domain)
      : coefficients_(coefficients),
        domain_(domain),
        upper_(zone(upperCount())),
        equatorMean_(meanOverEquator()) {}

  std::string_view name() const override { return "dct"; }
  int coefficients() const override { return coefficients_; }
  LightDomain domain() const override { return domain_; }

  // Below the horizon of the hemisphere the paper's extension, as in a table.
  void evaluate(Direction d, std::span<double> values) const override {
    if (domain_ == LightDomain::Sphere || d.z() >= 0) {
      evaluateOnChart(chartFromDirection(d), values);
      return;
    }
    evaluateOnEquator(d.phiRadians(), values);
    const double share = 2 * d.thetaRadians() / std::numbers::pi - 1;
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = (1 - share) * values[k] + share * equatorMean_[k];
    }
  }

  void evaluateOnChart(ChartPoint p, std::span<double> values) const override {
    assert(values.size() == static_cast<std::size_t>(coefficients_));
    for (double& value : values) value = 0;
    const std::size_t upper = static_cast<std::size_t>(upperCount());
    const std::span<double> own = p.square == 0 ? values.first(upper) : values.subspan(upper);
    for (std::size_t k = 0; k < own.size(); ++k) {
      own[k] = cosine(upper_[k].i, p.x) * cosine(upper_[k].j, p.y);
    }
  }

 private:
  int upperCount() const {
    return domain_ == LightDomain::Sphere ? (coefficients_ + 1) / 2 : coefficients_;
  }
  void evaluateOnEquator(double phi, std::span<double> values) const {
    evaluateOnChart({0, 0.5 + 0.5 * std::cos(phi), 0.5 + 0.5 * std::sin(phi)}, values);
  }
  std::vector<double> meanOverEquator() const {
    constexpr int kSteps = 1024;
    std::vector<double> mean(coefficients_, 0.0), values(coefficients_);
    for (int i = 0; i < kSteps; ++i) {
      evaluateOnEquator(2 * std::numbers::pi * i / kSteps, values);
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += values[k] / kSteps;
    }
    return mean;
  }
  static double cosine(int frequency, double x) {
    return frequency == 0 ? 1 : std::numbers::sqrt2 * std::cos(std::numbers::pi * frequency * x);
  }

  int coefficients_;
  LightDomain domain_;
  std::vector<Frequency> upper_;  ///< the lower square's are a prefix of these
  std::vector<double> equatorMean_;
};

}  // namespace

std::unique_ptr<AnalyticBasis> chartCosines(int coefficients, LightDomain domain) {
  return std::make_unique<ChartCosines>(coefficients, domain);
}

}  // namespace illum
