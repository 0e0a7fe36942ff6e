// Any number of lights as one: the sum over lights of intensity times basis.
#pragma once

#include <cstddef>
#include <vector>

#include "illum/basis_table.h"
#include "illum/colour.h"

namespace illum {

/// Adds lights up on a table's own samples: interpolation is linear, so what sixteen samples give a
/// light is what the light gives to sixteen samples. A light then costs the same whatever the
/// number of columns, and the columns cost the same whatever the number of lights. An exact basis'
/// samples are the corners of its mesh.
class LightSum {
 public:
  /// For bases whose tables have this shape.
  LightSum(LightDomain domain, int resolution);
  /// For `basis`, which must outlive the sum.
  explicit LightSum(const LightBasis& basis);
  /// Another sum of the same shape, with nothing in it.
  LightSum emptyCopy() const;

  void add(Direction toLight, LinearRgb intensity);
  /// What was added to `other`; of the same shape.
  void add(const LightSum& other);

  /// As LightBasis::evaluate gives them, each channel summed over the lights with its intensity.
  /// `basis` has the shape of the sum.
  std::vector<double> weights(const LightBasis& basis) const;

 private:
  struct Rgb {
    double r = 0, g = 0, b = 0;
    void add(double weight, LinearRgb light);
    void addScaled(double weight, const Rgb& other);
    bool isZero() const { return r == 0 && g == 0 && b == 0; }
  };
  void spread(ChartPoint p, double share, LinearRgb intensity);
  static std::vector<double> arranged(const BasisColour& colour, const std::vector<Rgb>& columns);

  std::vector<Rgb> columnSums(const BasisTable& table) const;

  const LightMesh* mesh_ = nullptr;
  LightDomain domain_;
  int resolution_ = 0;
  std::vector<Rgb>
      samples_;  // of a column: square by square, rows of resolution + 2; or the lights
  Rgb southPole_;
};

}  // namespace illum
