// Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality
// assessment: from error visibility to structural similarity", IEEE Transactions on Image
// Processing 13 (4), 2004.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "illum/picture.h"

namespace illum {

/// The side and the standard deviation of the Gaussian window, in pixels.
inline constexpr int kSsimWindow = 11;
inline constexpr double kSsimSigma = 1.5;

/// The stabilising constants (K1 L)^2 and (K2 L)^2 of equations 7 and 9, for 8-bit values: L = 255.
inline constexpr double kSsimC1 = (0.01 * 255) * (0.01 * 255);
inline constexpr double kSsimC2 = (0.03 * 255) * (0.03 * 255);

/// Means of the similarity map of equation 13.
struct Ssim {
  double all = 0;     ///< over every window that lies wholly in the picture
  double inside = 0;  ///< over those of them whose centre counts; NaN if there is none
};

/// SSIM on BT.709 luma of the encoded values (the value itself for 1 channel), of pictures that
/// arrive from the top. Only windows that lie wholly in the picture count, as in the authors' own
/// program: nothing is made up beyond the border. In a picture narrower or lower than the window,
/// that axis takes the largest odd window that fits. Time is linear in pixels; between calls ten
/// rows are kept.
class SsimScan {
 public:
  /// Of the whole picture; not empty.
  explicit SsimScan(Size size);

  /// The next rows of both, from row 0 on; equal sizes, the whole width, 1 or 3 channels. `inside`:
  /// per pixel of the *whole* picture, not 0 where it counts; empty: everywhere.
  void addRows(const BytePicture& picture, const BytePicture& truth,
               std::span<const std::uint8_t> inside);

  /// Of the windows so far.
  Ssim means() const;

 private:
  void addWindows(int top, std::span<const float> similarities,
                  std::span<const std::uint8_t> inside);

  Size size_;
  std::vector<float> across_, down_;  ///< weights
  int rows_ = 0;                      ///< seen so far
  std::vector<float> kept_;           ///< luma of the last rows of both, for windows to come
  double sum_ = 0, insideSum_ = 0;
  std::size_t count_ = 0, insideCount_ = 0;
};

/// Of whole pictures.
Ssim structuralSimilarity(const BytePicture& picture, const BytePicture& truth,
                          std::span<const std::uint8_t> inside);

/// Bytes that a scan keeps between calls.
std::uint64_t ssimScanBytes(Size size);

/// The window's weights along one axis of `length` pixels: odd, adding up to 1.
std::vector<float> ssimWeights(int length);

/// BT.709 luma of row y, in 0 ... 255.
void lumaRow(const BytePicture& picture, int y, std::span<float> luma);

}  // namespace illum
