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

std::vector<float> amplifiedDifference(std::span<const std::uint8_t> relit,
                                       std::span<const std::uint8_t> photograph) {
  std::vector<float> difference(relit.size());
  for (std::size_t i = 0; i < relit.size(); ++i) {
    const int bytes = kErrorGain * std::abs(int{relit[i]} - int{photograph[i]});
    difference[i] = static_cast<float>(bytes) / 255;
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

/// The three pictures of one view and light while they grow.
struct Growing {
  BoxReducer photograph, relit, error;

  Growing(Size size, int factor)
      : photograph(size, factor), relit(size, factor), error(size, factor) {}

  void add(const ComparedBand& band) {
    for (int y = 0; y < band.photograph.rows.height; ++y) {
      const int row = band.photograph.rows.y + y;
      photograph.addRow(row, band.photograph.linear.row(y));
      relit.addRow(row, band.relit.row(y));
      error.addRow(row, amplifiedDifference(band.relitBytes.row(y), band.photograph.bytes.row(y)));
    }
  }

  ReportPictures finished() const {
    return {displayBytes(photograph.means()), displayBytes(relit.means()),
            bytesFromUnit(error.means())};
  }
};

}  // namespace

std::vector<ReportPictures> reportPictures(const Comparison& comparison,
                                           std::span<const int> lights) {
  const Size size = comparison.size();
  std::vector<Growing> growing(lights.size(), Growing(size, reduction(size)));
  const std::uint64_t kept =
      lights.size() * 3 * 3 * sizeof(float) * Size{kReportPictureSide, kReportPictureSide}.pixels();
  Progress silent;
  comparison.forEachBand(lights, kept, silent,
                         [&](std::size_t i, const ComparedBand& band) { growing[i].add(band); });
  std::vector<ReportPictures> pictures;
  for (const Growing& light : growing) pictures.push_back(light.finished());
  return pictures;
}

}  // namespace illum
