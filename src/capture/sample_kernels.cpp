#include "capture/sample_kernels.h"

#include <array>
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

// n / white, correctly rounded for every n that there is (sample_rows_test tries them all): the
// reciprocal in two parts, as one float alone would be a unit off in the last place for half the
// bytes. Without a fused multiply-add the sum itself would be rounded twice, so there we divide.
template <class D, class V>
HWY_INLINE V quotient(D d, V n, float white) {
#if HWY_NATIVE_FMA
  const float high = 1 / white;
  const auto low = static_cast<float>(1 / static_cast<double>(white) - static_cast<double>(high));
  return hn::MulAdd(n, hn::Set(d, high), hn::Mul(n, hn::Set(d, low)));
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

// One vector of each colour.
template <class D, typename T, class V = hn::Vec<D>>
HWY_INLINE void loadColours(D d, const T* samples, int channels, V& r, V& g, V& b) {
  if (channels == 1) {
    r = g = b = hn::LoadU(d, samples);
  } else if (channels == 3) {
    hn::LoadInterleaved3(d, samples, r, g, b);
  } else {
    auto fourth = hn::Zero(d);
    hn::LoadInterleaved4(d, samples, r, g, b, fourth);
  }
}

// Whole vectors of samples are taken apart, for that costs the same however short they are; then
// each becomes several vectors of floats.
template <typename T>
void planar(const T* HWY_RESTRICT samples, int channels, std::size_t count, float* HWY_RESTRICT r,
            float* HWY_RESTRICT g, float* HWY_RESTRICT b) {
  const hn::ScalableTag<float> d;
  const hn::ScalableTag<T> whole;
  const hn::Rebind<T, decltype(d)> part;
  const std::size_t lanes = hn::Lanes(d), run = hn::Lanes(whole);
  const auto stride = static_cast<std::size_t>(channels);
  HWY_ALIGN std::array<std::array<T, HWY_MAX_BYTES / sizeof(T)>, 3> apart;
  const std::array<float*, 3> out{r, g, b};
  std::size_t i = 0;
  for (; i + run <= count; i += run) {
    auto first = hn::Zero(whole), second = first, third = first;
    loadColours(whole, samples + i * stride, channels, first, second, third);
    hn::Store(first, whole, apart[0].data());
    hn::Store(second, whole, apart[1].data());
    hn::Store(third, whole, apart[2].data());
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t at = 0; at < run; at += lanes)
        hn::StoreU(floats(d, hn::LoadU(part, apart[c].data() + at)), d, out[c] + i + at);
    }
  }
  for (; i < count; ++i) {
    const T* pixel = samples + i * stride;
    r[i] = oneFloat(pixel[0]);
    g[i] = oneFloat(pixel[channels == 1 ? 0 : 1]);
    b[i] = oneFloat(pixel[channels == 1 ? 0 : 2]);
  }
}

void apartBytes(const std::uint8_t* HWY_RESTRICT samples, int channels, std::size_t count,
                std::uint8_t* HWY_RESTRICT r, std::uint8_t* HWY_RESTRICT g,
                std::uint8_t* HWY_RESTRICT b) {
  const hn::ScalableTag<std::uint8_t> d;
  const auto stride = static_cast<std::size_t>(channels);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    auto first = hn::Zero(d), second = first, third = first;
    loadColours(d, samples + i * stride, channels, first, second, third);
    hn::StoreU(first, d, r + i);
    hn::StoreU(second, d, g + i);
    hn::StoreU(third, d, b + i);
  }
  for (; i < count; ++i) {
    const std::uint8_t* pixel = samples + i * stride;
    r[i] = pixel[0];
    g[i] = pixel[channels == 1 ? 0 : 1];
    b[i] = pixel[channels == 1 ? 0 : 2];
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
HWY_EXPORT(apartBytes);
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

void separateBytes(const std::uint8_t* samples, int channels, std::size_t count, std::uint8_t* r,
                   std::uint8_t* g, std::uint8_t* b) {
  HWY_DYNAMIC_DISPATCH(apartBytes)(samples, channels, count, r, g, b);
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
