#include "fit/byte_kernel.h"

#include <algorithm>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fit/byte_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// As in plane_kernel.cpp.
constexpr std::size_t kPlanes = 6;

// Adds both products of each pair of 16-bit integers.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V addProducts([[maybe_unused]] D d, V sum, V pairs, V weights) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  // Everywhere else the library may add the products to other lanes.
  const hn::Repartition<std::int16_t, D> halves;
  auto unused = hn::Zero(d);
  return hn::ReorderWidenMulAccumulate(d, hn::BitCast(halves, pairs), hn::BitCast(halves, weights),
                                       sum, unused);
#else
  const auto lower = [](V v) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(v)); };
  sum = hn::Add(sum, hn::Mul(lower(pairs), lower(weights)));
  return hn::Add(sum, hn::Mul(hn::ShiftRight<16>(pairs), hn::ShiftRight<16>(weights)));
#endif
}

// kCount planes of the two vectors of pixels in `panel`, into rows of `out` that are `stride`
// apart.
template <std::size_t kCount, class D>
HWY_INLINE void sumPanel(D d, const ByteProduct& product, std::size_t plane,
                         const std::int32_t* HWY_RESTRICT panel, float* HWY_RESTRICT out,
                         std::size_t stride) {
  const hn::RebindToFloat<D> floats;
  const std::size_t lanes = hn::Lanes(d), pairs = (product.inner + 1) / 2;
  hn::Vec<D> left[kCount], right[kCount];
  for (std::size_t k = 0; k < kCount; ++k) left[k] = right[k] = hn::Zero(d);
  const std::int32_t* weights = product.weights + plane * pairs;
  for (std::size_t i = 0; i < pairs; ++i, panel += 2 * lanes) {
    const auto first = hn::LoadU(d, panel), second = hn::LoadU(d, panel + lanes);
    for (std::size_t k = 0; k < kCount; ++k) {
      const auto weight = hn::Set(d, weights[k * pairs + i]);
      left[k] = addProducts(d, left[k], first, weight);
      right[k] = addProducts(d, right[k], second, weight);
    }
  }
  for (std::size_t k = 0; k < kCount; ++k) {
    const auto scale = hn::Set(floats, product.scale[plane + k]);
    const auto offset = hn::Set(floats, product.offset[plane + k]);
    float* row = out + (plane + k) * stride;
    hn::StoreU(hn::Add(offset, hn::Mul(scale, hn::ConvertTo(floats, left[k]))), floats, row);
    hn::StoreU(hn::Add(offset, hn::Mul(scale, hn::ConvertTo(floats, right[k]))), floats,
               row + lanes);
  }
}

// The same for `count` planes, at most kCount.
template <std::size_t kCount, class D>
HWY_INLINE void sumGroup(D d, const ByteProduct& product, std::size_t plane, std::size_t count,
                         const std::int32_t* panel, float* out, std::size_t stride) {
  if constexpr (kCount > 1) {
    if (count < kCount) return sumGroup<kCount - 1>(d, product, plane, count, panel, out, stride);
  }
  sumPanel<kCount>(d, product, plane, panel, out, stride);
}

template <class D>
HWY_INLINE void allPlanes(D d, const ByteProduct& product, const std::int32_t* panel, float* out,
                          std::size_t stride) {
  std::size_t plane = 0;
  for (std::size_t groups = (product.planes + kPlanes - 1) / kPlanes; groups > 0; --groups) {
    const std::size_t count = (product.planes - plane + groups - 1) / groups;
    sumGroup<kPlanes>(d, product, plane, count, panel, out, stride);
    plane += count;
  }
}

// Two bytes of each of `width` pixels, a number of vectors, as the halves of 32 bits.
template <class D>
HWY_INLINE void packPair(D d, const std::uint8_t* first, const std::uint8_t* second,
                         std::size_t width, std::int32_t* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  for (std::size_t at = 0; at < width; at += hn::Lanes(d)) {
    const auto lower = hn::PromoteTo(d, hn::LoadU(bytes, first + at));
    const auto upper = hn::PromoteTo(d, hn::LoadU(bytes, second + at));
    hn::StoreU(hn::Or(lower, hn::ShiftLeft<16>(upper)), d, to + at);
  }
}

void byteSums(const ByteProduct& product, const std::uint8_t* HWY_RESTRICT samples,
              std::size_t pixels, float* HWY_RESTRICT out) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t width = 2 * hn::Lanes(d), inner = product.inner;
  const std::size_t last =
      inner - 1;  // stands in for the second one of an odd pair, whose weight is 0
  std::vector<std::int32_t> panel((inner + 1) / 2 * width);
  std::vector<float> sums;
  std::vector<std::uint8_t> rest;
  for (std::size_t p = 0; p < pixels; p += width) {
    const std::size_t count = std::min(width, pixels - p);
    if (count == width) {
      for (std::size_t i = 0; i < inner; i += 2)
        packPair(d, samples + i * pixels + p, samples + std::min(i + 1, last) * pixels + p, width,
                 panel.data() + i / 2 * width);
      allPlanes(d, product, panel.data(), out + p, pixels);
      continue;
    }
    rest.assign(2 * width, 0);
    for (std::size_t i = 0; i < inner; i += 2) {
      std::copy_n(samples + i * pixels + p, count, rest.data());
      std::copy_n(samples + std::min(i + 1, last) * pixels + p, count, rest.data() + width);
      packPair(d, rest.data(), rest.data() + width, width, panel.data() + i / 2 * width);
    }
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

HWY_EXPORT(byteSums);

void sumPlanesOfBytes(const ByteProduct& product, const std::uint8_t* samples, std::size_t pixels,
                      float* out) {
  HWY_DYNAMIC_DISPATCH(byteSums)(product, samples, pixels, out);
}

}  // namespace illum
#endif  // HWY_ONCE
