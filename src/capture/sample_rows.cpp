#include "capture/sample_rows.h"

#include <algorithm>
#include <cstring>

#include "capture/sample_kernels.h"

namespace illum {
namespace {

constexpr float kWhiteByte = 255, kWhiteWord = 65535;

float unitOf(std::uint8_t sample) {
  return static_cast<float>(sample) / kWhiteByte;
}
float unitOf(std::uint16_t sample) {
  return static_cast<float>(sample) / kWhiteWord;
}
float unitOf(float sample) {
  return sample;
}

void planarFrom(const std::uint8_t* samples, int channels, std::size_t count, float* r, float* g,
                float* b) {
  planarFromBytes(samples, channels, count, r, g, b);
}
void planarFrom(const std::uint16_t* samples, int channels, std::size_t count, float* r, float* g,
                float* b) {
  planarFromWords(samples, channels, count, r, g, b);
}
void planarFrom(const float* samples, int channels, std::size_t count, float* r, float* g,
                float* b) {
  planarFromFloats(samples, channels, count, r, g, b);
}

// linearFromDisplay of every word, for a power a sample would cost more than decoding the file.
const std::vector<float>& linearOfDisplayWord() {
  static const std::vector<float> table = [] {
    std::vector<float> values(65536);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = linearFromDisplay(static_cast<float>(i) / kWhiteWord);
    }
    return values;
  }();
  return table;
}

template <typename T>
T load(const std::byte* place) {
  T sample;
  std::memcpy(&sample, place, sizeof sample);
  return sample;
}

}  // namespace

RowConverter::RowConverter(SampleType type, int channels, Transfer transfer, LinearRgb intensity)
    : type_(type),
      channels_(channels),
      transfer_(transfer),
      intensity_{intensity.r, intensity.g, intensity.b},
      plain_(intensity == LinearRgb{1, 1, 1}) {
  if (type != SampleType::Byte) return;
  for (std::size_t c = 0; c < 3; ++c) {
    for (int byte = 0; byte < 256; ++byte) {
      const float unit = static_cast<float>(byte) / kWhiteByte;
      const float linear = linearOf(unit, c);
      linearOfByte_.push_back(linear);
      transferOfByte_.push_back(plain_                          ? unit
                                : transfer == Transfer::Display ? displayFromLinear(linear)
                                                                : linear);
    }
  }
}

float RowConverter::linearOf(float unit, std::size_t c) const {
  return (transfer_ == Transfer::Display ? linearFromDisplay(unit) : unit) / intensity_[c];
}

float RowConverter::linearOf(std::uint8_t byte, std::size_t c) const {
  return linearOfByte_[256 * c + byte];
}

float RowConverter::linearOf(std::uint16_t word, std::size_t c) const {
  return (transfer_ == Transfer::Display ? linearOfDisplayWord()[word] : unitOf(word)) /
         intensity_[c];
}

template <typename T, typename Function>
void RowConverter::each(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                        std::span<float* const, 3> rgb, Function function) const {
  const std::size_t apart = channels_ >= 3 ? sizeof(T) : 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::byte* place = first + c * apart;
    float* out = rgb[c];
    for (std::size_t i = 0; i < count; ++i, place += step) out[i] = function(load<T>(place), c);
  }
}

template <typename T>
void RowConverter::toTransferOf(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                                std::span<float* const, 3> rgb) const {
  if (!plain_) {
    each<T>(first, step, count, rgb, [this](T sample, std::size_t c) {
      const float linear = linearOf(sample, c);
      return transfer_ == Transfer::Display ? displayFromLinear(linear) : linear;
    });
  } else if (channels_ != 2 && step == static_cast<std::ptrdiff_t>(sizeof(T)) * channels_) {
    planarFrom(reinterpret_cast<const T*>(first), channels_, count, rgb[0], rgb[1], rgb[2]);
  } else {
    each<T>(first, step, count, rgb, [](T sample, std::size_t) { return unitOf(sample); });
  }
}

void RowConverter::toTransfer(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                              std::span<float* const, 3> rgb) const {
  if (type_ == SampleType::Word) {
    toTransferOf<std::uint16_t>(first, step, count, rgb);
  } else if (type_ == SampleType::Float) {
    toTransferOf<float>(first, step, count, rgb);
  } else if (plain_) {
    toTransferOf<std::uint8_t>(first, step, count, rgb);
  } else {
    each<std::uint8_t>(first, step, count, rgb, [this](std::uint8_t sample, std::size_t c) {
      return transferOfByte_[256 * c + sample];
    });
  }
}

void RowConverter::toBytes(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                           std::span<std::uint8_t* const, 3> rgb) const {
  const auto* samples = reinterpret_cast<const std::uint8_t*>(first);
  if (channels_ != 2 && step == channels_)
    return separateBytes(samples, channels_, count, rgb[0], rgb[1], rgb[2]);
  for (std::size_t i = 0; i < count; ++i, samples += step) {
    for (std::size_t c = 0; c < 3; ++c) rgb[c][i] = samples[channels_ >= 3 ? c : 0];
  }
}

void RowConverter::toLinear(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                            std::span<float* const, 3> rgb) const {
  if (type_ == SampleType::Byte) {
    each<std::uint8_t>(first, step, count, rgb, [this](std::uint8_t sample, std::size_t c) {
      return linearOfByte_[256 * c + sample];
    });
  } else if (type_ == SampleType::Word) {
    each<std::uint16_t>(first, step, count, rgb, [this](std::uint16_t sample, std::size_t c) {
      return linearOf(sample, c);
    });
  } else {
    each<float>(first, step, count, rgb,
                [this](float sample, std::size_t c) { return linearOf(sample, c); });
  }
}

void RowConverter::alpha(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                         float* coverage) const {
  if (channels_ == 1 || channels_ == 3) {
    std::fill_n(coverage, count, 1.0f);
    return;
  }
  const std::byte* place = first + static_cast<std::size_t>(channels_ - 1) * bytesOf(type_);
  for (std::size_t i = 0; i < count; ++i, place += step) {
    const float unit = type_ == SampleType::Byte   ? unitOf(load<std::uint8_t>(place))
                       : type_ == SampleType::Word ? unitOf(load<std::uint16_t>(place))
                                                   : load<float>(place);
    coverage[i] = std::clamp(unit, 0.0f, 1.0f);
  }
}

}  // namespace illum
