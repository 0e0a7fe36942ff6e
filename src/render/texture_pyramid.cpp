#include "render/texture_pyramid.h"

#include <algorithm>
#include <cmath>

namespace illum {
namespace {

constexpr int kMostTaps = 8;

// The mean over [first, first + share) of a row or column of texels is the sum of these.
struct Overlap {
  int first = 0;
  std::vector<float> shares;
};

Overlap overlapOf(int to, int fine, int coarse) {
  const double width = static_cast<double>(fine) / coarse;
  const double low = to * width, high = (to + 1) * width;
  Overlap overlap{static_cast<int>(low), {}};
  for (int i = overlap.first; i < fine && i < high; ++i) {
    const double covered = std::min(high, i + 1.0) - std::max(low, static_cast<double>(i));
    overlap.shares.push_back(static_cast<float>(covered / width));
  }
  return overlap;
}

Picture halved(const Picture& fine) {
  const Size size{std::max(1, fine.width() / 2), std::max(1, fine.height() / 2)};
  const int channels = fine.channels();
  Picture rows({fine.width(), size.height}, channels), coarse(size, channels);
  for (int y = 0; y < size.height; ++y) {
    const Overlap overlap = overlapOf(y, fine.height(), size.height);
    for (std::size_t k = 0; k < overlap.shares.size(); ++k) {
      const auto from = fine.row(overlap.first + static_cast<int>(k));
      const auto to = rows.row(y);
      for (std::size_t i = 0; i < to.size(); ++i) to[i] += overlap.shares[k] * from[i];
    }
  }
  for (int x = 0; x < size.width; ++x) {
    const Overlap overlap = overlapOf(x, fine.width(), size.width);
    for (std::size_t k = 0; k < overlap.shares.size(); ++k) {
      for (int y = 0; y < size.height; ++y) {
        for (int c = 0; c < channels; ++c) {
          coarse.at(x, y, c) +=
              overlap.shares[k] * rows.at(overlap.first + static_cast<int>(k), y, c);
        }
      }
    }
  }
  return coarse;
}

Texel texel(const Picture& picture, int x, int y) {
  switch (picture.channels()) {
    case 1: {
      const float grey = picture.at(x, y, 0);
      return {grey, grey, grey, 1};
    }
    case 3:
      return {picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2), 1};
    default:
      return {picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2), picture.at(x, y, 3)};
  }
}

Texel mixed(const Texel& a, const Texel& b, float share) {
  Texel out;
  for (std::size_t c = 0; c < 4; ++c) out[c] = a[c] + share * (b[c] - a[c]);
  return out;
}

int wrapped(int i, int count) {
  const int rest = i % count;
  return rest < 0 ? rest + count : rest;
}

// The position in [0, count) of a coordinate that repeats; also for huge or infinite ones.
float repeated(float coordinate, int count) {
  const float fraction = coordinate - std::floor(coordinate);
  return fraction >= 0 && fraction < 1 ? fraction * static_cast<float>(count) : 0;
}

}  // namespace

TexturePyramid::TexturePyramid(const Texture& texture) {
  levels_.push_back(texture.texels);
  while (levels_.back().width() > 1 || levels_.back().height() > 1) {
    levels_.push_back(halved(levels_.back()));
  }
}

Texel TexturePyramid::bilinear(std::size_t level, TexturePoint at) const {
  const Picture& picture = levels_[level];
  const int width = picture.width(), height = picture.height();
  const float x = repeated(at.u, width) - 0.5f, y = repeated(1 - at.v, height) - 0.5f;
  const int left = static_cast<int>(std::floor(x)), above = static_cast<int>(std::floor(y));
  const int x0 = wrapped(left, width), x1 = wrapped(left + 1, width);
  const int y0 = wrapped(above, height), y1 = wrapped(above + 1, height);
  const float across = x - static_cast<float>(left), down = y - static_cast<float>(above);
  return mixed(mixed(texel(picture, x0, y0), texel(picture, x1, y0), across),
               mixed(texel(picture, x0, y1), texel(picture, x1, y1), across), down);
}

Texel TexturePyramid::trilinear(float level, TexturePoint at) const {
  const auto last = static_cast<float>(levels_.size() - 1);
  // Written so that NaN is the finest level.
  if (!(level > 0)) return bilinear(0, at);
  if (level >= last) return bilinear(levels_.size() - 1, at);
  const auto finer = static_cast<std::size_t>(level);
  return mixed(bilinear(finer, at), bilinear(finer + 1, at), level - static_cast<float>(finer));
}

Texel TexturePyramid::mean(TexturePoint at, const TextureFootprint& footprint) const {
  const auto width = static_cast<float>(levels_[0].width());
  const auto height = static_cast<float>(levels_[0].height());
  const auto texels = [&](TexturePoint axis) {
    return std::hypot(axis.u * width, axis.v * height);
  };
  TexturePoint longer = footprint.major, shorter = footprint.minor;
  if (texels(longer) < texels(shorter)) std::swap(longer, shorter);
  const float longest = texels(longer);
  const float ratio = longest / std::max(texels(shorter), 0.5f);
  const int taps = ratio < kMostTaps ? std::max(1, static_cast<int>(std::ceil(ratio))) : kMostTaps;
  // A level's texel is as wide as a tap's share of the ellipse (twice the half axis).
  const float level = std::log2(
      2 * std::max(longest / static_cast<float>(taps), std::min(texels(shorter), longest)));
  Texel sum{};
  for (int i = 0; i < taps; ++i) {
    const float along = (2 * static_cast<float>(i) + 1) / static_cast<float>(taps) - 1;
    const Texel one = trilinear(level, {at.u + along * longer.u, at.v + along * longer.v});
    for (std::size_t c = 0; c < 4; ++c) sum[c] += one[c] / static_cast<float>(taps);
  }
  return sum;
}

std::uint64_t TexturePyramid::bytes() const {
  std::uint64_t bytes = 0;
  for (const Picture& level : levels_) bytes += level.samples().size_bytes();
  return bytes;
}

}  // namespace illum
