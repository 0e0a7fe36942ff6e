#include "relight/bound_kernels.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "relight/bound_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Codes and picture in equal steps, a thousandth of each at a time.
float streamed(const std::uint8_t* HWY_RESTRICT codes, std::size_t bytes, float* HWY_RESTRICT out,
               std::size_t floats) {
  const hn::ScalableTag<std::uint8_t> d8;
  const hn::ScalableTag<float> d;
  constexpr std::size_t kParts = 1024;
  auto a = hn::Zero(d8), b = a, c = a, e = a;
  const std::size_t step = hn::Lanes(d8), part = bytes / kParts, drawn = floats / kParts;
  for (std::size_t p = 0; p < kParts; ++p) {
    const std::uint8_t* from = codes + p * part;
    for (std::size_t i = 0; i + 4 * step <= part; i += 4 * step) {
      a = hn::Or(a, hn::LoadU(d8, from + i));
      b = hn::Or(b, hn::LoadU(d8, from + i + step));
      c = hn::Or(c, hn::LoadU(d8, from + i + 2 * step));
      e = hn::Or(e, hn::LoadU(d8, from + i + 3 * step));
    }
    float* to = out + p * drawn;
    for (std::size_t i = 0; i + hn::Lanes(d) <= drawn; i += hn::Lanes(d))
      hn::StoreU(hn::Set(d, 1.0F), d, to + i);
  }
  return static_cast<float>(hn::GetLane(hn::Or(hn::Or(a, b), hn::Or(c, e))));
}

// Twelve sums: more than any processor's latency times its units leaves waiting. They begin
// differently, so that no compiler sees that one would do.
float multiplied(std::size_t count) {
  const hn::ScalableTag<float> d;
  const auto w = hn::Set(d, 0.999F), v = hn::Set(d, 1e-3F);
  const auto start = [&](int i) { return hn::Set(d, static_cast<float>(i)); };
  auto a = start(1), b = start(2), c = start(3), e = start(4), f = start(5), g = start(6);
  auto h = start(7), i = start(8), j = start(9), k = start(10), l = start(11), m = start(12);
  for (std::size_t done = 0; done < count; done += 12 * hn::Lanes(d)) {
    a = hn::MulAdd(a, w, v), b = hn::MulAdd(b, w, v), c = hn::MulAdd(c, w, v);
    e = hn::MulAdd(e, w, v), f = hn::MulAdd(f, w, v), g = hn::MulAdd(g, w, v);
    h = hn::MulAdd(h, w, v), i = hn::MulAdd(i, w, v), j = hn::MulAdd(j, w, v);
    k = hn::MulAdd(k, w, v), l = hn::MulAdd(l, w, v), m = hn::MulAdd(m, w, v);
  }
  const auto first = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(f, g));
  const auto second = hn::Add(hn::Add(hn::Add(h, i), hn::Add(j, k)), hn::Add(l, m));
  return hn::GetLane(hn::Add(first, second));
}

}  // namespace illum::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace illum {

HWY_EXPORT(streamed);
HWY_EXPORT(multiplied);

float readAndWrite(const void* codes, std::size_t bytes, std::span<float> picture) {
  return HWY_DYNAMIC_DISPATCH(streamed)(static_cast<const std::uint8_t*>(codes), bytes,
                                        picture.data(), picture.size());
}

float multiplyAndAdd(std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(multiplied)(count);
}

}  // namespace illum
#endif  // HWY_ONCE
