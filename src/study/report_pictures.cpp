#include "study/report_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <vector>

#include "illum/colour.h"

namespace illum {
namespace {

int reduction(Size size) {
  const int longer = std::max(size.width, size.height);
  return (longer + kReportPictureSide - 1) / kReportPictureSide;
}

/// Averages boxes of factor x factor values while rows arrive from the top; the last ones may be
/// smaller.
class BoxReducer {
 public:
  BoxReducer(Size size, int factor)
      : factor_(factor),
        size_(size),
        sums_({(size.width + factor - 1) / factor, (size.height + factor - 1) / factor}, 3) {}

  void addRow(int y, std::span<const float> rgb) {
    const auto sums = sums_.row(y / factor_);
    for (int x = 0; x < size_.width; ++x) {
      const auto from = 3 * static_cast<std::size_t>(x);
      const auto to = 3 * static_cast<std::size_t>(x / factor_);
      for (std::size_t c = 0; c < 3; ++c) sums[to + c] += rgb[from + c];
    }
  }

  Picture means() const {
    Picture means = sums_;
    for (int y = 0; y < means.height(); ++y) {
      const int rows = std::min(factor_, size_.height - y * factor_);
      for (int x = 0; x < means.width(); ++x) {
        const int columns = std::min(factor_, size_.width - x * factor_);
        for (int c = 0; c < 3; ++c) means.at(x, y, c) /= static_cast<float>(rows * columns);
      }
    }
    return means;
  }

 private:
  int factor_;
  Size size_;
  Picture sums_;
};

std::vector<float> amplifiedDifference(std::span<const float> relit,
                                       std::span<const std::uint8_t> photograph) {
  std::vector<float> difference(relit.size());
  for (std::size_t i = 0; i < relit.size(); ++i) {
    const int bytes = int{displayByteFromLinear(relit[i])} - int{photograph[i]};
    difference[i] = static_cast<float>(kErrorGain * std::abs(bytes)) / 255;
  }
  return difference;
}

/// Values that are encoded already.
BytePicture bytesFromUnit(const Picture& units) {
  BytePicture bytes(units.size(), units.channels());
  std::transform(units.samples().begin(), units.samples().end(), bytes.samples().begin(),
                 byteFromUnit);
  return bytes;
}

}  // namespace

ReportPictures reportPictures(const Comparison& comparison, int light) {
  const Picture relit = comparison.relit(light);
  const int factor = reduction(relit.size());
  BoxReducer photograph(relit.size(), factor), picture(relit.size(), factor),
      error(relit.size(), factor);
  comparison.readPhotograph(light, [&](const PhotographBand& band) {
    for (int y = 0; y < band.rows.height; ++y) {
      const int row = band.rows.y + y;
      photograph.addRow(row, band.linear.row(y));
      picture.addRow(row, relit.row(row));
      error.addRow(row, amplifiedDifference(relit.row(row), band.bytes.row(y)));
    }
  });
  return {displayBytes(photograph.means()), displayBytes(picture.means()),
          bytesFromUnit(error.means())};
}

}  // namespace illum
