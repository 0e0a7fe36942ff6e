// The normative sampled form of a light basis (docs/format.md, "basis.bin").
//
// Directions are charted as in Wong et al. 1997, section 4.2: a stereographic square a hemisphere,
//   upper: x = (tan(theta/2) cos(phi) + 1)/2,  y = (tan(theta/2) sin(phi) + 1)/2,
// the lower one alike with theta replaced by pi - theta. (The paper mirrors phi; our y is up.)
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "illum/vector.h"

namespace illum {

/// Which directions the light may come from. Hemisphere: z >= 0 is charted; below the horizon the
/// equator's value goes linearly in theta to a constant at the south pole (the paper's section 5).
enum class LightDomain { Hemisphere, Sphere };

/// A point of the chart: square 0 is the upper hemisphere, 1 the lower; x, y in [0, 1].
struct ChartPoint {
  int square = 0;
  double x = 0, y = 0;
};
ChartPoint chartFromDirection(Direction d);
/// Inverse; points outside the disc continue the stereographic projection past the equator.
Direction directionFromChart(ChartPoint p);

/// How much encoding may change a column, relative to its rms: -72 dB.
inline constexpr double kDefaultStoredError = 2.5e-4;

/// `columns` scalar functions of direction as N x N vertex-centred samples a square plus a guard
/// ring (so N+2 a side; sample (i, j) is at x = (i-1)/(N-1), y = (j-1)/(N-1)), interpolated by
/// Catmull-Rom.
class BasisTable {
 public:
  BasisTable() = default;
  /// resolution N >= 4, columns >= 1.
  BasisTable(LightDomain domain, int resolution, int columns);

  LightDomain domain() const { return domain_; }
  int resolution() const { return resolution_; }
  int columns() const { return columns_; }
  int squares() const { return domain_ == LightDomain::Sphere ? 2 : 1; }
  int side() const { return resolution_ + 2; }

  /// Fills every sample that interpolation can reach (the others, in the square's corners, become
  /// 0) and the south pole's constant (the mean over the equator). `f` writes `columns` values for
  /// a direction; it is asked on and up to three grid steps beyond the equator too.
  void fill(const std::function<void(Direction, std::span<double>)>& f);
  /// The same for functions that know how they continue past their own square's equator.
  void fillChart(const std::function<void(ChartPoint, std::span<double>)>& f);
  /// Sets the south pole's constants to the mean of the table's own values over the equator. fill()
  /// does it; needed again after values() were written.
  void setSouthPoleFromEquator();

  /// The columns' values for a light from `d`. `out` has columns() entries.
  void evaluate(Direction d, std::span<float> out) const;

  /// The same at a point of the chart, whose cell must touch the disc; squares as the domain has.
  void evaluate(ChartPoint p, std::span<float> out) const;

  /// values[((square * columns + column) * side + row) * side + col]; row runs with y.
  std::span<float> values() { return values_; }
  std::span<const float> values() const { return values_; }
  /// Hemisphere only: the constant at the south pole, one per column.
  std::span<float> southPole() { return southPole_; }
  std::span<const float> southPole() const { return southPole_; }

  /// What encode() may lose: the rms rounding error of column c is at most relative * (its rms over
  /// the disc), but never finer than 2^-24 of its largest value. Default kDefaultStoredError.
  void setStoredError(double relative);
  /// The same in the columns' own units, one positive number per column: for bases whose columns do
  /// not matter equally (give error of the picture / rms of the column's plane).
  void setStoredErrors(std::vector<double> absolutePerColumn);

  /// basis.bin's bytes. Rounds the table to what the file stores: *this equals decode(encode()). A
  /// table that was encoded or decoded and not changed since gives the same bytes again. Throws
  /// Error (Fault::Input) for values that are not finite or beyond 2^60.
  std::vector<std::byte> encode();
  /// Untrusted input is safe. Throws Error naming `source`.
  static BasisTable decode(std::span<const std::byte> bytes, const std::string& source);

  /// Equal shape and samples, whatever error encode() may make.
  friend bool operator==(const BasisTable& a, const BasisTable& b);

 private:
  LightDomain domain_ = LightDomain::Hemisphere;
  int resolution_ = 0, columns_ = 0;
  std::vector<float> values_, southPole_;
  double storedError_ = kDefaultStoredError;
  std::vector<std::byte> encoded_;    // of the last encode() or decode()
  std::vector<double> storedErrors_;  // empty: storedError_ holds for all
};

/// How table columns become the basis colour(x) = g(m(w) + sum_k b_k(w) P_k(x)) of DESIGN's common
/// form.
struct BasisColour {
  /// Separable: plane 3j+c has b = column j times colourMatrix column c; no mean.
  /// Full: columns 3k..3k+2 are b_k's RGB for plane k, and the last three columns are the mean m.
  /// Exact: no table but a LightMesh; plane 3l+c is channel c under light l.
  enum class Kind { Separable, Full, Exact } kind = Kind::Separable;
  /// Row-major 3x3, rgb = colourMatrix * (three planes' values). Separable only.
  std::array<double, 9> colourMatrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

class LightMesh;  // src/basis/light_mesh.h

/// The light basis of a group: b_k and m for K planes.
class LightBasis {
 public:
  LightBasis() = default;
  LightBasis(BasisTable table, BasisColour colour);
  /// The exact basis: the planes are the pictures under the mesh's lights themselves, between which
  /// is interpolated; plane 3l+c is channel c of light l.
  explicit LightBasis(std::shared_ptr<const LightMesh> mesh);

  int planes() const;
  /// Null unless the basis is exact; then there is no table.
  const LightMesh* mesh() const { return mesh_.get(); }
  const BasisTable& table() const { return table_; }
  LightDomain domain() const { return mesh_ ? LightDomain::Sphere : table_.domain(); }
  const BasisColour& colour() const { return colour_; }

  /// out[3k+c] = b_k(d)'s channel c for k < planes(); out[3*planes()+c] = m(d)'s channel c.
  void evaluate(Direction d, std::span<float> out) const;
  std::size_t evaluateSize() const { return 3 * static_cast<std::size_t>(planes()) + 3; }

  /// Its bytes in basis.bin.
  std::vector<std::byte> encode() const;

 private:
  void evaluateSeparable(Direction d, std::span<float> out) const;

  std::shared_ptr<const LightMesh> mesh_;
  BasisTable table_;
  BasisColour colour_;
};

}  // namespace illum
