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

enum class BasisFamily { SphericalHarmonics, HemisphericalHarmonics, Cosine, Learned };

struct FitOptions {
  BasisFamily family = BasisFamily::Learned;
  int coefficients = 0;                      ///< per channel (separable); 0: chosen
  int planes = 0;                            ///< scalar planes (learned); 0: chosen
  std::optional<bool> solidAngleWeights;     ///< unset: by leave-one-out
  std::optional<bool> extension;             ///< the paper's step across the equator; unset: by leave-one-out
  std::optional<double> regularizer;         ///< relative strength lambda; unset: by leave-one-out
  bool projection = false;                   ///< quadrature of the integral in section 4.1 instead of least squares
};

/// Second moments of the samples over (a fair selection of) pixels: everything that choosing needs.
struct SampleStatistics {
  int lights = 0;
  std::size_t pixels = 0;
  std::vector<double> mean;  ///< 3*lights, row 3l+c
  std::vector<double> gram;  ///< (3*lights)^2, E[s s^T] not centred
};

/// planes (K x pixels) = matrix (K x 3L) * samples (3L x pixels) + offset. Row-major. For separable bases
/// the matrix is block-structured and `separable` holds the small block: coefficient x light, applied
/// per channel, then the colour matrix's inverse.
struct PlaneOperator {
  int planes = 0, lights = 0;
  std::vector<float> matrix;  ///< planes x (3*lights)
  std::vector<float> offset;  ///< planes
  /// `samples` as Capture::read gives them; planes[k * pixels + p]. One thread; call it from tasks.
  void apply(std::span<const float> samples, std::size_t pixels, std::span<float> planes) const;
};

/// A fitted light basis with everything that the writer and the user want to know.
struct Fit {
  std::string basisName;
  int coefficients = 0;
  LightBasis basis;                 ///< from the *encoded* table: what readers will see
  PlaneOperator planes;             ///< consistent with that table; planes orthonormal over the lit domain
  std::vector<double> mixing;       ///< named coefficients = mixing * planes; empty for learned
  double leaveOneOutDecibels = 0;   ///< estimate of the mean PSNR at an unseen light
  std::vector<std::string> choices; ///< "regularizer 3e-4 (leave-one-out)", for the user and provenance
  std::vector<std::string> warnings;
};

/// Chooses and computes. `lights`: those of the statistics' rows.
Fit fitBasis(const std::vector<DirectionalLight>& lights, const SampleStatistics& statistics,
             const FitOptions& options);

}  // namespace illum
