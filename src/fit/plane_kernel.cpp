#include "fit/plane_kernel.h"

#include <algorithm>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fit/plane_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Planes whose sums stay in registers while all samples of a few pixels pass: with two vectors of
// pixels 12 sums, which leaves room for the samples and a weight in 16 registers.
constexpr std::size_t kPlanes = 6;

// kCount planes of the two vectors of pixels in `panel`, into rows of `out` that are `stride`
// apart. Each pixel's sum takes its samples in their order.
template <std::size_t kCount, class D>
HWY_INLINE void sumPanel(D d, const PlaneProduct& product, std::size_t plane,
                         const float* HWY_RESTRICT panel, float* HWY_RESTRICT out,
                         std::size_t stride) {
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<D> left[kCount], right[kCount];
  for (std::size_t k = 0; k < kCount; ++k) {
    left[k] = right[k] = hn::Set(d, product.offset[plane + k]);
  }
  const float* weights = product.matrix + plane * product.inner;
  for (std::size_t i = 0; i < product.inner; ++i, panel += 2 * lanes) {
    const auto first = hn::LoadU(d, panel), second = hn::LoadU(d, panel + lanes);
    for (std::size_t k = 0; k < kCount; ++k) {
      const auto weight = hn::Set(d, weights[k * product.inner + i]);
      left[k] = hn::MulAdd(weight, first, left[k]);
      right[k] = hn::MulAdd(weight, second, right[k]);
    }
  }
  for (std::size_t k = 0; k < kCount; ++k) {
    hn::StoreU(left[k], d, out + (plane + k) * stride);
    hn::StoreU(right[k], d, out + (plane + k) * stride + lanes);
  }
}

// The same for `count` planes, at most kCount.
template <std::size_t kCount, class D>
HWY_INLINE void sumGroup(D d, const PlaneProduct& product, std::size_t plane, std::size_t count,
                         const float* panel, float* out, std::size_t stride) {
  if constexpr (kCount > 1) {
    if (count < kCount) return sumGroup<kCount - 1>(d, product, plane, count, panel, out, stride);
  }
  sumPanel<kCount>(d, product, plane, panel, out, stride);
}

// Planes in groups of nearly the same size: the sums of a small rest alone would wait for
// themselves, for an addition takes several times as long as it takes to begin the next one.
template <class D>
HWY_INLINE void allPlanes(D d, const PlaneProduct& product, const float* panel, float* out,
                          std::size_t stride) {
  std::size_t plane = 0;
  for (std::size_t groups = (product.planes + kPlanes - 1) / kPlanes; groups > 0; --groups) {
    const std::size_t count = (product.planes - plane + groups - 1) / groups;
    sumGroup<kPlanes>(d, product, plane, count, panel, out, stride);
    plane += count;
  }
}

// Samples of a few pixels are copied together first: rows of samples lie so far apart, often by a
// power of two, that they would drive one another out of the first-level cache. The pixels that are
// left at the end go through the same instructions, so that a pixel's value does not depend on its
// place.
void planeSums(const PlaneProduct& product, const float* HWY_RESTRICT samples, std::size_t pixels,
               float* HWY_RESTRICT out) {
  const hn::ScalableTag<float> d;
  const std::size_t width = 2 * hn::Lanes(d);
  std::vector<float> panel(product.inner * width), sums;
  for (std::size_t p = 0; p < pixels; p += width) {
    const std::size_t count = std::min(width, pixels - p);
    if (count == width) {
      for (std::size_t i = 0; i < product.inner; ++i) {
        const float* from = samples + i * pixels + p;
        float* to = panel.data() + i * width;
        hn::StoreU(hn::LoadU(d, from), d, to);
        hn::StoreU(hn::LoadU(d, from + width / 2), d, to + width / 2);
      }
      allPlanes(d, product, panel.data(), out + p, pixels);
      continue;
    }
    for (std::size_t i = 0; i < product.inner; ++i)
      std::copy_n(samples + i * pixels + p, count, panel.data() + i * width);
    sums.resize(product.planes * width);
    allPlanes(d, product, panel.data(), sums.data(), width);
    for (std::size_t k = 0; k < product.planes; ++k)
      std::copy_n(sums.data() + k * width, count, out + k * pixels + p);
  }
}

}  // namespace illum::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace illum {

HWY_EXPORT(planeSums);

void sumPlanes(const PlaneProduct& product, const float* samples, std::size_t pixels, float* out) {
  HWY_DYNAMIC_DISPATCH(planeSums)(product, samples, pixels, out);
}

}  // namespace illum
#endif  // HWY_ONCE
