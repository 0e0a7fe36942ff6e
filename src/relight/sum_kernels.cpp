#include "relight/sum_kernels.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "relight/sum_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
// After it, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace illum::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;

// Planes that pass by while sums wait in registers: enough that loading and storing the sums costs
// little, few enough that the processor fetches all of them ahead.
constexpr std::size_t kPlanesAtOnce = 8;
// Vectors of texels: 4 x 3 sums, a value and the weights fill the sixteen registers of AVX2.
constexpr std::size_t kVectors = 4;

struct Number {
  template <typename Code>
  HWY_INLINE hn::Vec<Floats> operator()(const Code* codes, float /*offset*/) const {
    const Floats d;
    const hn::Rebind<Code, Floats> stored;
    const hn::RebindToSigned<Floats> integers;
    return hn::ConvertTo(d, hn::PromoteTo(integers, hn::LoadU(stored, codes)));
  }
};

struct SignedSqrt {
  float step;
  template <typename Code>
  HWY_INLINE hn::Vec<Floats> operator()(const Code* codes, float offset) const {
    const Floats d;
    const auto s = hn::MulAdd(hn::Set(d, step), Number()(codes, 0), hn::Set(d, offset));
    return hn::Mul(s, hn::Abs(s));
  }
};

struct Half {
  HWY_INLINE hn::Vec<Floats> operator()(const std::uint16_t* codes, float /*offset*/) const {
    const hn::Rebind<hwy::float16_t, Floats> stored;
    const hn::Rebind<std::uint16_t, Floats> bits;
    return hn::PromoteTo(Floats(), hn::BitCast(stored, hn::LoadU(bits, codes)));
  }
};

// A step's texels of one sum: four vectors, by names, for arrays of vectors are no C++ where their
// size is not known before the program runs.
struct StepSum {
  hn::Vec<Floats> v0, v1, v2, v3;

  static HWY_INLINE StepSum of(float start) {
    const auto v = hn::Set(Floats(), start);
    return {v, v, v, v};
  }
  static HWY_INLINE StepSum load(const float* sum) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    return {hn::Load(d, sum), hn::Load(d, sum + lanes), hn::Load(d, sum + 2 * lanes),
            hn::Load(d, sum + 3 * lanes)};
  }
  HWY_INLINE void store(float* sum) const {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    hn::Store(v0, d, sum), hn::Store(v1, d, sum + lanes);
    hn::Store(v2, d, sum + 2 * lanes), hn::Store(v3, d, sum + 3 * lanes);
  }
};

// A step's texels of all planes of one batch, added to the sums. `at(p)`: the codes of plane p.
template <class Value, class At>
HWY_INLINE void addStep(std::span<const WeightedPlane<1>> planes, const Value& value, const At& at,
                        std::array<StepSum, 1>& sums) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  StepSum a = sums[0];
  for (const WeightedPlane<1>& plane : planes) {
    const auto* codes = at(plane);
    const auto w = hn::Set(d, plane.weight[0]);
    a.v0 = hn::MulAdd(w, value(codes, plane.offset), a.v0);
    a.v1 = hn::MulAdd(w, value(codes + lanes, plane.offset), a.v1);
    a.v2 = hn::MulAdd(w, value(codes + 2 * lanes, plane.offset), a.v2);
    a.v3 = hn::MulAdd(w, value(codes + 3 * lanes, plane.offset), a.v3);
  }
  sums[0] = a;
}

template <class Value, class At>
HWY_INLINE void addStep(std::span<const WeightedPlane<3>> planes, const Value& value, const At& at,
                        std::array<StepSum, 3>& sums) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  StepSum a = sums[0], b = sums[1], c = sums[2];
  for (const WeightedPlane<3>& plane : planes) {
    const auto* codes = at(plane);
    // Three weights, one value and twelve sums: one value after the other, or registers run out.
    const auto wa = hn::Set(d, plane.weight[0]), wb = hn::Set(d, plane.weight[1]);
    const auto wc = hn::Set(d, plane.weight[2]);
    auto v = value(codes, plane.offset);
    a.v0 = hn::MulAdd(wa, v, a.v0), b.v0 = hn::MulAdd(wb, v, b.v0);
    c.v0 = hn::MulAdd(wc, v, c.v0);
    v = value(codes + lanes, plane.offset);
    a.v1 = hn::MulAdd(wa, v, a.v1), b.v1 = hn::MulAdd(wb, v, b.v1);
    c.v1 = hn::MulAdd(wc, v, c.v1);
    v = value(codes + 2 * lanes, plane.offset);
    a.v2 = hn::MulAdd(wa, v, a.v2), b.v2 = hn::MulAdd(wb, v, b.v2);
    c.v2 = hn::MulAdd(wc, v, c.v2);
    v = value(codes + 3 * lanes, plane.offset);
    a.v3 = hn::MulAdd(wa, v, a.v3), b.v3 = hn::MulAdd(wb, v, b.v3);
    c.v3 = hn::MulAdd(wc, v, c.v3);
  }
  sums[0] = a, sums[1] = b, sums[2] = c;
}

template <std::size_t Sums, typename Code, class Value>
void sumPlanes(const Code* HWY_RESTRICT codes, std::size_t stride, const Value& value,
               std::span<const WeightedPlane<Sums>> planes, std::size_t count,
               const std::array<float, Sums>& start, const std::array<float*, Sums>& sums) {
  const std::size_t step = kVectors * hn::Lanes(Floats());
  static_assert(kSumBlock % (kVectors * HWY_MAX_BYTES / sizeof(float)) == 0);
  // The last texels, with room behind them for whole vectors.
  HWY_ALIGN Code rest[kPlanesAtOnce][kVectors * HWY_MAX_BYTES / sizeof(float)];
  std::size_t begin = 0;
  do {
    const auto batch = planes.subspan(begin, std::min(kPlanesAtOnce, planes.size() - begin));
    const auto add = [&](std::size_t i, const auto& at) {
      std::array<StepSum, Sums> sum;
      for (std::size_t c = 0; c < Sums; ++c)
        sum[c] = begin == 0 ? StepSum::of(start[c]) : StepSum::load(sums[c] + i);
      addStep(batch, value, at, sum);
      for (std::size_t c = 0; c < Sums; ++c) sum[c].store(sums[c] + i);
    };
    std::size_t i = 0;
    for (; i + step <= count; i += step)
      add(i, [&](const auto& p) { return codes + p.plane * stride + i; });
    if (i < count) {
      for (std::size_t p = 0; p < batch.size(); ++p) {
        std::memset(rest[p], 0, sizeof rest[p]);
        std::memcpy(rest[p], codes + batch[p].plane * stride + i, (count - i) * sizeof(Code));
      }
      add(i, [&](const auto& p) { return rest[&p - batch.data()]; });
    }
    begin += kPlanesAtOnce;
  } while (begin < planes.size());
}

template <std::size_t Sums>
void sumCodes(const CodeRows& codes, std::span<const WeightedPlane<Sums>> planes, std::size_t count,
              const std::array<float, Sums>& start, const std::array<float*, Sums>& sums) {
  const auto each = [&](const auto* first, const auto& value) {
    sumPlanes<Sums>(first, codes.stride, value, planes, count, start, sums);
  };
  const bool square = codes.meaning == CodeMeaning::SignedSqrt;
  if (codes.bytes != nullptr) {
    square ? each(codes.bytes, SignedSqrt{codes.step}) : each(codes.bytes, Number());
  } else if (codes.meaning == CodeMeaning::Half) {
    each(codes.words, Half());
  } else {
    square ? each(codes.words, SignedSqrt{codes.step}) : each(codes.words, Number());
  }
}

void sumOne(const CodeRows& codes, std::span<const WeightedPlane<1>> planes, std::size_t count,
            const std::array<float, 1>& start, const std::array<float*, 1>& sums) {
  sumCodes<1>(codes, planes, count, start, sums);
}

void sumThree(const CodeRows& codes, std::span<const WeightedPlane<3>> planes, std::size_t count,
              const std::array<float, 3>& start, const std::array<float*, 3>& sums) {
  sumCodes<3>(codes, planes, count, start, sums);
}

template <class Colour>
HWY_INLINE void store(const std::array<float*, 3>& sums, std::size_t count, float* HWY_RESTRICT rgb,
                      const Colour& colour) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN float rest[3 * HWY_MAX_BYTES / sizeof(float)];
  for (std::size_t i = 0; i < count; i += lanes) {
    const auto a = hn::Load(d, sums[0] + i), b = hn::Load(d, sums[1] + i);
    const auto c = hn::Load(d, sums[2] + i);
    const bool whole = i + lanes <= count;
    float* out = whole ? rgb + 3 * i : rest;
    hn::StoreInterleaved3(colour(0, a, b, c), colour(1, a, b, c), colour(2, a, b, c), d, out);
    if (!whole) std::memcpy(rgb + 3 * i, rest, 3 * (count - i) * sizeof(float));
  }
}

void storePlain(const std::array<float*, 3>& sums, std::size_t count, float* rgb) {
  store(sums, count, rgb, [](int channel, auto a, auto b, auto c) {
    return channel == 0 ? a : channel == 1 ? b : c;
  });
}

// colours[k][c] of sum k in channel c. Each sum its own channel is a case of its own: what is not a
// number in one channel is none of the others'.
void storeColoured(const std::array<float*, 3>& sums,
                   const std::array<std::array<float, 3>, 3>& colours,
                   const std::array<float, 3>& constant, std::size_t count, float* rgb) {
  const Floats d;
  bool apart = true;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) apart = apart && (k == c || colours[k][c] == 0);
  const auto set = [&](std::size_t k, int channel) {
    return hn::Set(d, colours[k][static_cast<std::size_t>(channel)]);
  };
  const auto base = [&](int channel) {
    return hn::Set(d, constant[static_cast<std::size_t>(channel)]);
  };
  if (apart) {
    store(sums, count, rgb, [&](int channel, auto a, auto b, auto c) {
      const auto own = channel == 0 ? a : channel == 1 ? b : c;
      return hn::MulAdd(set(static_cast<std::size_t>(channel), channel), own, base(channel));
    });
    return;
  }
  store(sums, count, rgb, [&](int channel, auto a, auto b, auto c) {
    const auto red = hn::MulAdd(set(0, channel), a, base(channel));
    return hn::MulAdd(set(2, channel), c, hn::MulAdd(set(1, channel), b, red));
  });
}

}  // namespace illum::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace illum {
namespace {

std::array<float*, 3> rowsOf(const std::array<SumBlock*, 3>& sums) {
  return {sums[0]->data(), sums[1]->data(), sums[2]->data()};
}

}  // namespace

HWY_EXPORT(sumOne);
HWY_EXPORT(sumThree);
HWY_EXPORT(storePlain);
HWY_EXPORT(storeColoured);

void sumWeighted(const CodeRows& codes, std::span<const WeightedPlane<3>> planes, std::size_t count,
                 const std::array<float, 3>& start, const std::array<SumBlock*, 3>& sums) {
  HWY_DYNAMIC_DISPATCH(sumThree)(codes, planes, count, start, rowsOf(sums));
}

void sumWeighted(const CodeRows& codes, std::span<const WeightedPlane<1>> planes, std::size_t count,
                 float start, SumBlock& sum) {
  HWY_DYNAMIC_DISPATCH(sumOne)(codes, planes, count, {start}, {sum.data()});
}

void interleave(const std::array<SumBlock*, 3>& sums, std::size_t count, float* rgb) {
  HWY_DYNAMIC_DISPATCH(storePlain)(rowsOf(sums), count, rgb);
}

void interleaveColoured(const std::array<SumBlock*, 3>& sums,
                        const std::array<std::array<float, 3>, 3>& colours,
                        const std::array<float, 3>& constant, std::size_t count, float* rgb) {
  HWY_DYNAMIC_DISPATCH(storeColoured)(rowsOf(sums), colours, constant, count, rgb);
}

}  // namespace illum
#endif  // HWY_ONCE
