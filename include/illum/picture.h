// Pictures in memory: interleaved samples, row 0 at the top, pixel centres at half integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace illum {

struct Size {
  int width = 0, height = 0;
  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  friend bool operator==(const Size&, const Size&) = default;
};

/// Half-open: x … x+width-1, y … y+height-1. y counts rows from the top.
struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
  Size size() const { return {width, height}; }
  std::size_t pixels() const { return size().pixels(); }
  int right() const { return x + width; }    ///< one past the last column
  int bottom() const { return y + height; }  ///< one past the last row
  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// A width x height x channels array, channels fastest. T says what the samples are:
/// float = linear light, unbounded; uint8_t = display-referred sRGB.
template <typename T>
class PictureOf {
 public:
  PictureOf() = default;
  PictureOf(Size size, int channels)
      : size_(size),
        channels_(channels),
        samples_(size.pixels() * static_cast<std::size_t>(channels)) {}

  Size size() const { return size_; }
  int width() const { return size_.width; }
  int height() const { return size_.height; }
  int channels() const { return channels_; }
  bool empty() const { return samples_.empty(); }

  std::span<T> row(int y) { return {samples_.data() + offset(0, y), rowLength()}; }
  std::span<const T> row(int y) const { return {samples_.data() + offset(0, y), rowLength()}; }
  T& at(int x, int y, int channel) {
    return samples_[offset(x, y) + static_cast<std::size_t>(channel)];
  }
  const T& at(int x, int y, int channel) const {
    return samples_[offset(x, y) + static_cast<std::size_t>(channel)];
  }
  std::span<T> samples() { return samples_; }
  std::span<const T> samples() const { return samples_; }

  friend bool operator==(const PictureOf&, const PictureOf&) = default;

 private:
  std::size_t rowLength() const {
    return static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(channels_);
  }
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
            static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels_);
  }

  Size size_;
  int channels_ = 0;
  std::vector<T> samples_;
};

/// Linear light. 1 channel grey, 3 RGB, 4 RGB premultiplied by the alpha in channel 3.
using Picture = PictureOf<float>;

/// Display-referred sRGB. 1 grey, 3 RGB, 4 RGB with straight (not premultiplied) alpha.
using BytePicture = PictureOf<std::uint8_t>;

/// What a screen shows: linear * 2^exposureStops, clamped, sRGB-encoded, rounded; no tone mapping.
/// Alpha becomes straight.
BytePicture displayBytes(const Picture& linear, double exposureStops = 0);

}  // namespace illum
