#include "render/surface_kernel.h"

#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/surface_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most 16 lanes, so that a batch is a whole number of vectors.
using Lanes = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Lanes>;

struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Vectors broadcast(Lanes d, Float3 v) {
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
HWY_INLINE Floats dotOf(const Vectors& a, const Vectors& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vectors sumOf(const Vectors& a, const Vectors& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vectors crossOf(const Vectors& a, const Vectors& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

// Linear between the curve's entries.
HWY_INLINE Floats onCurve(Lanes d, const AlbedoCurve& curve, Floats cosine) {
  const hn::RebindToSigned<Lanes> integers;
  const auto position = hn::Mul(cosine, hn::Set(d, static_cast<float>(kAlbedoSteps)));
  const auto last = hn::Set(integers, static_cast<int>(kAlbedoSteps) - 1);
  const auto entry = hn::Min(hn::ConvertTo(integers, position), last);
  const auto share = hn::Sub(position, hn::ConvertTo(d, entry));
  const auto left = hn::GatherIndex(d, curve.data(), entry);
  const auto right = hn::GatherIndex(d, curve.data() + 1, entry);
  return hn::MulAdd(share, hn::Sub(right, left), left);
}

void evaluateLobesHere(const SurfaceLobes& lobes, const DirectionBatch& toLight, std::size_t count,
                       BsdfBatch& out) {
  const Lanes d;
  constexpr float kInversePi = std::numbers::inv_pi_v<float>;
  const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const Vectors normal = broadcast(d, lobes.normal), viewer = broadcast(d, lobes.toViewer);
  const Vectors geometric = broadcast(d, lobes.geometricNormal);
  const auto alpha2 = hn::Set(d, lobes.alphaSquared), rest = hn::Sub(one, alpha2);
  const auto viewerCosine = hn::Set(d, lobes.viewerCosine);
  const auto viewerShadowing = hn::Set(d, lobes.viewerShadowing);
  const auto grazing = hn::Set(d, lobes.grazing);
  // The density of visible normals, seen as directions of light: D / (2 (cosine + shadowing)).
  const float glossyDensity =
      lobes.glossyShare * 0.5f / (lobes.viewerCosine + lobes.viewerShadowing);
  const float mattDensity = (1 - lobes.glossyShare) * kInversePi;

  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Vectors light{hn::Load(d, toLight.x.data() + i), hn::Load(d, toLight.y.data() + i),
                        hn::Load(d, toLight.z.data() + i)};
    const auto cosine = dotOf(normal, light);
    const auto lit = hn::And(hn::Gt(cosine, zero), hn::Gt(dotOf(geometric, light), zero));
    const auto lightCosine = hn::Min(one, hn::Max(cosine, zero));

    // The half vector h, not normalised: |h| = 2 cos(h, viewer). 1 - cos^2(h, normal) is the
    // square of their cross product, which keeps narrow highlights accurate.
    const Vectors half = sumOf(light, viewer);
    const auto halfSquared = hn::Max(dotOf(half, half), hn::Set(d, 1e-12f));
    const Vectors beside = crossOf(normal, half);
    const auto inverse = hn::Div(one, halfSquared);
    const auto sine2 = hn::Mul(dotOf(beside, beside), inverse);
    const auto halfCosine = hn::Add(lightCosine, viewerCosine);
    const auto cosine2 = hn::Mul(hn::Mul(halfCosine, halfCosine), inverse);

    // D = alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2); V = 1 / (2 (n.l Lv + n.v Ll)).
    const auto spread = hn::MulAdd(alpha2, cosine2, sine2);
    const auto distribution =
        hn::Div(hn::Mul(alpha2, hn::Set(d, kInversePi)), hn::Mul(spread, spread));
    const auto lightShadowing =
        hn::Sqrt(hn::MulAdd(rest, hn::Mul(lightCosine, lightCosine), alpha2));
    const auto both =
        hn::MulAdd(lightCosine, viewerShadowing, hn::Mul(viewerCosine, lightShadowing));
    const auto facets = hn::Mul(distribution, hn::Div(hn::Set(d, 0.5f), both));

    // F = facing + (grazing - facing) (1 - cos(h, viewer))^5.
    const auto away = hn::Max(zero, hn::Sub(one, hn::Mul(hn::Set(d, 0.5f), hn::Sqrt(halfSquared))));
    const auto away2 = hn::Mul(away, away);
    const auto away5 = hn::Mul(hn::Mul(away2, away2), away);

    const auto through = onCurve(d, lobes.passes, lightCosine);
    const auto store = [&](float facing, float matt, float* to) {
      const auto f0 = hn::Set(d, facing);
      const auto fresnel = hn::MulAdd(hn::Sub(grazing, f0), away5, f0);
      const auto value = hn::MulAdd(facets, fresnel, hn::Mul(hn::Set(d, matt), through));
      hn::Store(hn::IfThenElseZero(lit, hn::Mul(value, lightCosine)), d, to + i);
    };
    store(lobes.facing.r, lobes.matt.r, out.r.data());
    store(lobes.facing.g, lobes.matt.g, out.g.data());
    store(lobes.facing.b, lobes.matt.b, out.b.data());
    const auto density = hn::MulAdd(distribution, hn::Set(d, glossyDensity),
                                    hn::Mul(lightCosine, hn::Set(d, mattDensity)));
    hn::Store(hn::IfThenElseZero(lit, density), d, out.density.data() + i);
  }
}

}  // namespace illum::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace illum {

HWY_EXPORT(evaluateLobesHere);
void evaluateLobes(const SurfaceLobes& lobes, const DirectionBatch& toLight, std::size_t count,
                   BsdfBatch& out) {
  HWY_DYNAMIC_DISPATCH(evaluateLobesHere)(lobes, toLight, count, out);
}

}  // namespace illum
#endif
