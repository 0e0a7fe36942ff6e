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

void fillMoments(const BytePicture& picture, const BytePicture& truth, int y, MomentRows& rows) {
  auto& [a, b, squares, product] = rows;
  lumaRow(picture, y, a);
  lumaRow(truth, y, b);
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

/// Goes down both pictures once, keeping the last window's rows.
class WindowScan {
 public:
  WindowScan(const BytePicture& picture, const BytePicture& truth)
      : picture_(picture),
        truth_(truth),
        across_(ssimWeights(truth.width())),
        down_(ssimWeights(truth.height())),
        ring_(down_.size(), momentRowsOf(truth.width())),
        column_(momentRowsOf(truth.width())),
        window_(momentRowsOf(outputs())) {}

  int outputs() const { return truth_.width() - side(across_) + 1; }
  int outputRows() const { return truth_.height() - side(down_) + 1; }
  int marginX() const { return side(across_) / 2; }
  int marginY() const { return side(down_) / 2; }

  /// The similarities of the windows whose top row is `top`; tops come in order from 0.
  void nextRow(int top, std::span<float> out) {
    const int end = top + side(down_);
    for (int y = top == 0 ? 0 : end - 1; y < end; ++y) fillMoments(picture_, truth_, y, slot(y));
    for (std::size_t m = 0; m < kMoments; ++m) {
      std::array<const float*, kSsimWindow> rows{};
      for (int t = 0; t < side(down_); ++t)
        rows[static_cast<std::size_t>(t)] = slot(top + t)[m].data();
      averageRows({rows.data(), down_.size()}, down_, column_[m]);
      for (std::size_t t = 0; t < across_.size(); ++t) rows[t] = column_[m].data() + t;
      averageRows({rows.data(), across_.size()}, across_, window_[m]);
    }
    for (std::size_t x = 0; x < out.size(); ++x)
      out[x] = similarity(window_[0][x], window_[1][x], window_[2][x], window_[3][x]);
  }

 private:
  static int side(const std::vector<float>& weights) { return static_cast<int>(weights.size()); }
  MomentRows& slot(int y) { return ring_[static_cast<std::size_t>(y) % ring_.size()]; }

  const BytePicture& picture_;
  const BytePicture& truth_;
  std::vector<float> across_, down_;
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

Ssim structuralSimilarity(const BytePicture& picture, const BytePicture& truth,
                          std::span<const std::uint8_t> inside) {
  WindowScan scan(picture, truth);
  std::vector<float> row(static_cast<std::size_t>(scan.outputs()));
  double sum = 0, insideSum = 0;
  std::size_t count = 0, insideCount = 0;
  for (int top = 0; top < scan.outputRows(); ++top) {
    scan.nextRow(top, row);
    const std::size_t centre =
        static_cast<std::size_t>(top + scan.marginY()) * static_cast<std::size_t>(truth.width()) +
        static_cast<std::size_t>(scan.marginX());
    for (std::size_t x = 0; x < row.size(); ++x) {
      sum += row[x];
      if (inside.empty() || inside[centre + x] == 0) continue;
      insideSum += row[x];
      ++insideCount;
    }
    count += row.size();
  }
  const double all = ratio(sum, count);
  return {all, inside.empty() ? all : ratio(insideSum, insideCount)};
}

}  // namespace illum
