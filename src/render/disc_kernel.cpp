#include "render/disc_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/disc_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most 16 lanes, so that a batch is a whole number of vectors.
using Lanes = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Lanes>;

// sin(2 pi x) for |x| <= 1/4, by Taylor's series: the first term left out is below 6e-8.
HWY_INLINE Floats sineOfTurn(Lanes d, Floats x) {
  const auto x2 = hn::Mul(x, x);
  auto sum = hn::Set(d, -15.09464258f);
  sum = hn::MulAdd(sum, x2, hn::Set(d, 42.05869394f));
  sum = hn::MulAdd(sum, x2, hn::Set(d, -76.70585975f));
  sum = hn::MulAdd(sum, x2, hn::Set(d, 81.60524928f));
  sum = hn::MulAdd(sum, x2, hn::Set(d, -41.34170224f));
  sum = hn::MulAdd(sum, x2, hn::Set(d, 6.283185307f));
  return hn::Mul(sum, x);
}

// The fraction of a sum of two numbers in [0, 1).
HWY_INLINE Floats turned(Lanes d, const float* own, float common) {
  const auto one = hn::Set(d, 1.0f);
  const auto sum = hn::Add(hn::Load(d, own), hn::Set(d, common));
  return hn::IfThenElse(hn::Ge(sum, one), hn::Sub(sum, one), sum);
}

void drawOnDiscsHere(const DiscBatch& discs, float height, std::array<float, 2> uniform,
                     std::size_t count, DirectionBatch& out) {
  const Lanes d;
  const auto half = hn::Set(d, 0.5f), quarter = hn::Set(d, 0.25f);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    // Even in the height on a spherical cap is even in its area.
    const auto drop = hn::Mul(hn::Set(d, height), turned(d, discs.turnA.data() + i, uniform[0]));
    const auto radius = hn::Sqrt(hn::Mul(drop, hn::Sub(hn::Set(d, 2.0f), drop)));
    const auto along = hn::Sub(hn::Set(d, 1.0f), drop);
    // An angle of `turn` full circles, from -1/2 to 1/2.
    const auto turn = hn::Sub(turned(d, discs.turnB.data() + i, uniform[1]), half);
    const auto size = hn::Abs(turn);
    const auto sine = sineOfTurn(d, hn::CopySign(hn::Min(size, hn::Sub(half, size)), turn));
    const auto cosine = sineOfTurn(d, hn::Sub(quarter, size));
    const auto a = hn::Mul(radius, cosine), b = hn::Mul(radius, sine);
    const auto store = [&](const float* centre, const float* across, const float* up, float* to) {
      const auto sum = hn::MulAdd(a, hn::Load(d, across + i), hn::Mul(b, hn::Load(d, up + i)));
      hn::Store(hn::MulAdd(along, hn::Load(d, centre + i), sum), d, to + i);
    };
    store(discs.centre.x.data(), discs.across.x.data(), discs.up.x.data(), out.x.data());
    store(discs.centre.y.data(), discs.across.y.data(), discs.up.y.data(), out.y.data());
    store(discs.centre.z.data(), discs.across.z.data(), discs.up.z.data(), out.z.data());
  }
}

}  // namespace illum::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace illum {

HWY_EXPORT(drawOnDiscsHere);
void drawOnDiscs(const DiscBatch& discs, float height, std::array<float, 2> uniform,
                 std::size_t count, DirectionBatch& out) {
  HWY_DYNAMIC_DISPATCH(drawOnDiscsHere)(discs, height, uniform, count, out);
}

}  // namespace illum
#endif
