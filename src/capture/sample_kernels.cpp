#include "capture/sample_kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/sample_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kWhiteByte = 255, kWhiteWord = 65535;

// n / white, correctly rounded: one Newton step corrects the product with the rounded reciprocal
// (Markstein 1990, "Computation of elementary functions on the IBM RISC System/6000", theorem 8.2).
// Without a fused multiply-add the step itself would be rounded, so there we divide.
template <class D, class V>
HWY_INLINE V quotient(D d, V n, float white) {
#if HWY_NATIVE_FMA
  const auto reciprocal = hn::Set(d, 1 / white);
  const auto q = hn::Mul(n, reciprocal);
  return hn::MulAdd(hn::NegMulAdd(q, hn::Set(d, white), n), reciprocal, q);
#else
  return hn::Div(n, hn::Set(d, white));
#endif
}

template <class D>
HWY_INLINE auto floats(D d, hn::Vec<hn::Rebind<std::uint8_t, D>> samples) {
  const hn::RebindToSigned<D> integers;
  return quotient(d, hn::ConvertTo(d, hn::PromoteTo(integers, samples)), kWhiteByte);
}
template <class D>
HWY_INLINE auto floats(D d, hn::Vec<hn::Rebind<std::uint16_t, D>> samples) {
  const hn::RebindToSigned<D> integers;
  return quotient(d, hn::ConvertTo(d, hn::PromoteTo(integers, samples)), kWhiteWord);
}
template <class D>
HWY_INLINE hn::Vec<D> floats(D, hn::Vec<D> samples) {
  return samples;
}

inline float oneFloat(std::uint8_t sample) {
  return static_cast<float>(sample) / kWhiteByte;
}
inline float oneFloat(std::uint16_t sample) {
  return static_cast<float>(sample) / kWhiteWord;
}
inline float oneFloat(float sample) {
  return sample;
}

template <typename T>
void planar(const T* HWY_RESTRICT samples, int channels, std::size_t count, float* HWY_RESTRICT r,
            float* HWY_RESTRICT g, float* HWY_RESTRICT b) {
  const hn::ScalableTag<float> d;
  const hn::Rebind<T, decltype(d)> stored;
  const std::size_t lanes = hn::Lanes(d);
  const auto stride = static_cast<std::size_t>(channels);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    auto first = hn::Zero(stored), second = first, third = first, fourth = first;
    if (channels == 1) {
      first = second = third = hn::LoadU(stored, samples + i);
    } else if (channels == 3) {
      hn::LoadInterleaved3(stored, samples + i * stride, first, second, third);
    } else {
      hn::LoadInterleaved4(stored, samples + i * stride, first, second, third, fourth);
    }
    hn::StoreU(floats(d, first), d, r + i);
    hn::StoreU(floats(d, second), d, g + i);
    hn::StoreU(floats(d, third), d, b + i);
  }
  for (; i < count; ++i) {
    const T* pixel = samples + i * stride;
    r[i] = oneFloat(pixel[0]);
    g[i] = oneFloat(pixel[channels == 1 ? 0 : 1]);
    b[i] = oneFloat(pixel[channels == 1 ? 0 : 2]);
  }
}

void planarBytes(const std::uint8_t* samples, int channels, std::size_t count, float* r, float* g,
                 float* b) {
  planar(samples, channels, count, r, g, b);
}
void planarWords(const std::uint16_t* samples, int channels, std::size_t count, float* r, float* g,
                 float* b) {
  planar(samples, channels, count, r, g, b);
}
void planarFloats(const float* samples, int channels, std::size_t count, float* r, float* g,
                  float* b) {
  planar(samples, channels, count, r, g, b);
}

}  // namespace illum::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace illum {

HWY_EXPORT(planarBytes);
HWY_EXPORT(planarWords);
HWY_EXPORT(planarFloats);

void planarFromBytes(const std::uint8_t* samples, int channels, std::size_t count, float* r,
                     float* g, float* b) {
  HWY_DYNAMIC_DISPATCH(planarBytes)(samples, channels, count, r, g, b);
}

void planarFromWords(const std::uint16_t* samples, int channels, std::size_t count, float* r,
                     float* g, float* b) {
  HWY_DYNAMIC_DISPATCH(planarWords)(samples, channels, count, r, g, b);
}

void planarFromFloats(const float* samples, int channels, std::size_t count, float* r, float* g,
                      float* b) {
  HWY_DYNAMIC_DISPATCH(planarFloats)(samples, channels, count, r, g, b);
}

// All bits of the exponent set means infinite or not a number. Compilers vectorise this by
// themselves.
bool allFinite(const float* samples, std::size_t count) {
  constexpr std::uint32_t kExponent = 0x7f800000;
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, samples + i, sizeof bits);
    bad |= static_cast<std::uint32_t>((bits & kExponent) == kExponent);
  }
  return bad == 0;
}

}  // namespace illum
#endif  // HWY_ONCE
