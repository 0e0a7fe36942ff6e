#include "study/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace illum {
namespace {

/// The four local averages that equation 13 needs: of x, y, x^2 + y^2 and x y. The two variances
/// enter only as their sum, which saves a fifth. Values are taken relative to mid-grey: variances
/// do not change, and the squares lose less precision in float.
constexpr int kMoments = 4;
constexpr float kMidGrey = 128;
using MomentRows = std::array<std::vector<float>, kMoments>;

MomentRows momentRowsOf(int width) {
  MomentRows rows;
  for (auto& row : rows) row.resize(static_cast<std::size_t>(width));
  return rows;
}

/// From the first two moments, which hold the luma of both.
void fillMoments(MomentRows& rows) {
  auto& [a, b, squares, product] = rows;
  for (std::size_t x = 0; x < a.size(); ++x) {
    a[x] -= kMidGrey;
    b[x] -= kMidGrey;
    squares[x] = a[x] * a[x] + b[x] * b[x];
    product[x] = a[x] * b[x];
  }
}

/// out[x] = sum_t weights[t] rows[t][x] for weights that are symmetric about their middle. Serves
/// both axes: along a row, rows[t] is that row begun at its t-th sample.
void averageRows(std::span<const float* const> rows, std::span<const float> weights,
                 std::span<float> out) {
  const std::size_t middle = weights.size() / 2;
  for (std::size_t x = 0; x < out.size(); ++x) out[x] = weights[middle] * rows[middle][x];
  for (std::size_t t = 0; t < middle; ++t) {
    const float weight = weights[t];
    const float* const first = rows[t];
    const float* const second = rows[weights.size() - 1 - t];
    for (std::size_t x = 0; x < out.size(); ++x) out[x] += weight * (first[x] + second[x]);
  }
}

/// Equation 13 at one window.
float similarity(float meanA, float meanB, float meanSquares, float meanProduct) {
  const float variances = meanSquares - meanA * meanA - meanB * meanB;
  const float covariance = meanProduct - meanA * meanB;
  const float a = meanA + kMidGrey, b = meanB + kMidGrey;
  constexpr auto c1 = static_cast<float>(kSsimC1), c2 = static_cast<float>(kSsimC2);
  return (2 * a * b + c1) * (2 * covariance + c2) / ((a * a + b * b + c1) * (variances + c2));
}

int side(const std::vector<float>& weights) {
  return static_cast<int>(weights.size());
}

/// The last rows of a scan, as many as a window is high, and what a window's row makes of them.
class WindowRows {
 public:
  WindowRows(int width, const std::vector<float>& across, const std::vector<float>& down)
      : across_(across),
        down_(down),
        ring_(down.size(), momentRowsOf(width)),
        column_(momentRowsOf(width)),
        window_(momentRowsOf(width - side(across) + 1)) {}

  /// Where row y of the picture stands.
  MomentRows& row(int y) { return ring_[static_cast<std::size_t>(y) % ring_.size()]; }
  int outputs() const { return static_cast<int>(window_[0].size()); }

  /// The similarities of the windows whose top row is `top`.
  void similarities(int top, std::span<float> out) {
    for (std::size_t m = 0; m < kMoments; ++m) {
      std::array<const float*, kSsimWindow> rows{};
      for (int t = 0; t < side(down_); ++t)
        rows[static_cast<std::size_t>(t)] = row(top + t)[m].data();
      averageRows({rows.data(), down_.size()}, down_, column_[m]);
      for (std::size_t t = 0; t < across_.size(); ++t) rows[t] = column_[m].data() + t;
      averageRows({rows.data(), across_.size()}, across_, window_[m]);
    }
    for (std::size_t x = 0; x < out.size(); ++x)
      out[x] = similarity(window_[0][x], window_[1][x], window_[2][x], window_[3][x]);
  }

 private:
  const std::vector<float>&across_, &down_;
  std::vector<MomentRows> ring_;
  MomentRows column_, window_;
};

double ratio(double sum, std::size_t count) {
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return sum / static_cast<double>(count);
}

}  // namespace

std::vector<float> ssimWeights(int length) {
  const int fitting = std::min(kSsimWindow, length);
  const int side = fitting % 2 == 1 ? fitting : fitting - 1;
  std::vector<double> exact;
  double sum = 0;
  for (int t = 0; t < side; ++t) {
    const double distance = (t - side / 2) / kSsimSigma;
    exact.push_back(std::exp(-0.5 * distance * distance));
    sum += exact.back();
  }
  std::vector<float> weights;
  for (const double weight : exact) weights.push_back(static_cast<float>(weight / sum));
  return weights;
}

void lumaRow(const BytePicture& picture, int y, std::span<float> luma) {
  const auto row = picture.row(y);
  if (picture.channels() == 1) {
    std::copy(row.begin(), row.end(), luma.begin());
    return;
  }
  // ITU-R BT.709, item 3.2, on the encoded values.
  for (std::size_t x = 0; x < luma.size(); ++x)
    luma[x] = 0.2126f * row[3 * x] + 0.7152f * row[3 * x + 1] + 0.0722f * row[3 * x + 2];
}

SsimScan::SsimScan(Size size)
    : size_(size),
      across_(ssimWeights(size.width)),
      down_(ssimWeights(size.height)),
      kept_(2 * Size{size.width, side(down_) - 1}.pixels()) {}

void SsimScan::addRows(const BytePicture& picture, const BytePicture& truth,
                       std::span<const std::uint8_t> inside) {
  WindowRows rows(size_.width, across_, down_);
  const int before = side(down_) - 1;
  const auto width = static_cast<std::size_t>(size_.width);
  const auto kept = [&](int y, std::size_t which) {
    const auto slot = static_cast<std::size_t>(y % before);
    return std::span(kept_).subspan((2 * slot + which) * width, width);
  };
  for (int y = std::max(0, rows_ - before); y < rows_; ++y) {
    for (const std::size_t which : {0, 1})
      std::copy_n(kept(y, which).begin(), width, rows.row(y)[which].begin());
    fillMoments(rows.row(y));
  }
  std::vector<float> similarities(static_cast<std::size_t>(rows.outputs()));
  for (int i = 0; i < truth.height(); ++i, ++rows_) {
    MomentRows& row = rows.row(rows_);
    lumaRow(picture, i, row[0]);
    lumaRow(truth, i, row[1]);
    for (const std::size_t which : {0, 1})
      if (before > 0) std::copy_n(row[which].begin(), width, kept(rows_, which).begin());
    fillMoments(row);
    if (rows_ < before) continue;
    rows.similarities(rows_ - before, similarities);
    addWindows(rows_ - before, similarities, inside);
  }
}

void SsimScan::addWindows(int top, std::span<const float> similarities,
                          std::span<const std::uint8_t> inside) {
  const std::size_t centre = Size{size_.width, top + side(down_) / 2}.pixels() + across_.size() / 2;
  for (std::size_t x = 0; x < similarities.size(); ++x) {
    sum_ += similarities[x];
    if (inside.empty() || inside[centre + x] == 0) continue;
    insideSum_ += similarities[x];
    ++insideCount_;
  }
  count_ += similarities.size();
  if (!inside.empty()) return;
  insideSum_ = sum_;
  insideCount_ = count_;
}

Ssim SsimScan::means() const {
  return {ratio(sum_, count_), ratio(insideSum_, insideCount_)};
}

Ssim structuralSimilarity(const BytePicture& picture, const BytePicture& truth,
                          std::span<const std::uint8_t> inside) {
  SsimScan scan(truth.size());
  scan.addRows(picture, truth, inside);
  return scan.means();
}

std::uint64_t ssimScanBytes(Size size) {
  return 2 * sizeof(float) * Size{size.width, kSsimWindow - 1}.pixels();
}

}  // namespace illum
