// From planes to codes at one common step (DESIGN §5, docs/math/quantising.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/tile.h"
#include "fit/fit.h"
#include "object/manifest.h"

namespace illum {

struct QuantiserRequest {
  Coding coding = Coding::Avif;
  std::optional<int> bits;     ///< unset: chosen
  std::optional<Curve> curve;  ///< unset: chosen
  double targetDecibels = 50;  ///< PSNR on screen of quantisation alone, that is chosen for
};

struct QuantiserChoice {
  std::vector<CodingEntry> entries;  ///< one a basis: all alike but for offsets and functions
  double decibels = 0;               ///< reached on the pilots, the mean over the bases
};

/// What quantisers are tried on: the planes of one basis' pilot, or a part of them.
class QuantiserTrial {
 public:
  /// `planes`: (basis planes) x `pixels` values; `complete`: these are all the values there will
  /// be, so that the ranges need no margin. `trials`: how many there are beside each other, which
  /// share the memory.
  QuantiserTrial(const Fit& fit, std::span<const DirectionalLight> lights, Response response,
                 std::span<const float> planes, std::size_t pixels, bool complete,
                 std::size_t trials = 1);

  struct Range {
    double low = 0, high = 0;
    double length() const { return high - low; }
  };
  /// Of each plane, passed through the curve.
  std::vector<Range> ranges(Curve curve) const;
  /// Mean over lights of the PSNR that quantising alone reaches on a screen.
  double decibels(const CodingEntry& entry) const;

 private:
  std::vector<float> shown(const std::vector<float>& values) const;

  Response response_;
  int planeCount_;
  bool complete_;
  std::size_t lights_, pixels_ = 0;
  std::vector<float> low_, high_, values_, weights_, mean_, truth_;
};

/// Chooses bits, curve and step for all bases together, and the offsets of each.
QuantiserChoice chooseQuantiser(std::span<const QuantiserTrial> trials,
                                const QuantiserRequest& request);

/// Whether all are 8-bit values divided by 255, as photographs' samples are.
bool areWholeBytes(std::span<const float> samples);

/// For `bases` exact bases of `planes` planes: what keeps samples to the last bit. Whole `bytes`
/// stay codes of 8 bits; everything else becomes halves, which is exact for halves, and finer than
/// the 8 bits of a screen for all. Throws Error (Fault::Usage) for bits or a curve that were asked
/// for.
QuantiserChoice exactQuantiser(std::size_t bases, int planes, bool bytes,
                               const QuantiserRequest& request);

/// Quantises plane values of one tile: `planes` is (basis planes) x tile.pixels(). Values outside
/// the quantiser's range take its nearest end and are counted in `clipped`.
PlaneCodes quantise(const CodingEntry& entry, std::span<const float> planes, Size tile,
                    std::uint64_t& clipped);

/// The inverse: values of the basis planes (sums of stored planes). For tests and simulation.
std::vector<float> dequantise(const CodingEntry& entry, const PlaneCodes& codes, int basisPlanes);

}  // namespace illum
