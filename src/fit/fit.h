// From samples to planes: planes = F * samples, F computed once per object (DESIGN §3).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "illum/basis_table.h"
#include "illum/capture.h"
#include "illum/progress.h"

namespace illum {

enum class BasisFamily { SphericalHarmonics, HemisphericalHarmonics, Cosine, Learned, Exact };

struct FitOptions {
  BasisFamily family = BasisFamily::Learned;
  int coefficients = 0;                   ///< per channel (separable); 0: chosen
  int planes = 0;                         ///< scalar planes (learned); 0: chosen
  std::optional<bool> solidAngleWeights;  ///< unset: by leave-one-out
  std::optional<bool> extension;  ///< the paper's step across the equator; unset: by leave-one-out
  /// Unset: by leave-one-out. Separable: lambda of ridge regression, relative to the mean of the
  /// normal matrix's diagonal. Learned: the noise's variance relative to the covariance's (the
  /// nugget).
  std::optional<double> regularizer;
  bool projection = false;  ///< quadrature of the integral in section 4.1 instead of least squares
  bool displayReferred = false;  ///< the samples are sRGB-encoded, not proportional to light
};

/// Second moments of the samples over (a fair selection of) pixels: everything that choosing needs.
struct SampleStatistics {
  int lights = 0;
  std::size_t pixels = 0;
  std::vector<double> mean;  ///< 3*lights, row 3l+c
  std::vector<double> gram;  ///< (3*lights)^2, E[s s^T] not centred
};

/// planes (K x pixels) = matrix (K x 3L) * samples (3L x pixels) + offset. Row-major. For separable
/// bases plane 3j+c is coefficient j of rotated colour c (BasisColour), and the offset is 0.
struct PlaneOperator {
  int planes = 0, lights = 0;
  std::vector<float> matrix;  ///< planes x (3*lights)
  std::vector<float> offset;  ///< planes
  /// Not empty: there is no matrix, plane k is row picks[k] of the samples to the last bit.
  std::vector<int> picks;
  /// `samples` as Capture::read gives them; planes[k * pixels + p]. One thread; call it from tasks.
  /// Results do not depend on the thread, nor (tested) on how pixels are cut into blocks of
  /// multiples of 16.
  void apply(std::span<const float> samples, std::size_t pixels, std::span<float> planes) const;
};

/// A fitted light basis with everything that the writer and the user want to know.
struct Fit {
  std::string basisName;
  int coefficients = 0;
  LightBasis basis;  ///< from the *encoded* table: what readers will see
  /// Mean over the lit domain of b_j(w) . b_k(w) = [j = k]: errors e_k in the planes cost sum_k
  /// e_k^2 in the picture (summed over RGB). Uncorrelated over pixels, of falling variance.
  PlaneOperator planes;
  /// coefficients x coefficients, row-major: the basis' own coefficient j of channel c is
  /// sum_k mixing[j, k] (colourMatrix * planes 3k..3k+2)_c. Empty for learned.
  std::vector<double> mixing;
  /// Estimate of the mean PSNR at an unseen light, of the samples as given. Not a number where
  /// there is but one light, which tells nothing of others.
  double leaveOneOutDecibels = 0;
  std::vector<std::string>
      choices;  ///< "regularizer 3e-4 (leave-one-out)", for the user and provenance
  std::vector<std::string> warnings;
};

/// Chooses and computes. `lights`: those of the statistics' rows.
Fit fitBasis(const std::vector<DirectionalLight>& lights, const SampleStatistics& statistics,
             const FitOptions& options);

}  // namespace illum
