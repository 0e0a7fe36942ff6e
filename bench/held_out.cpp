#include "held_out.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "illum/error.h"
#include "illum/evaluate.h"
#include "illum/picture_io.h"

namespace illum::bench {
namespace {

// Over black, where premultiplied colours are what they are.
Picture withoutCoverage(const Picture& picture) {
  Picture rgb(picture.size(), 3);
  const auto channels = static_cast<std::size_t>(picture.channels());
  for (std::size_t i = 0; i < picture.size().pixels(); ++i) {
    std::copy_n(&picture.samples()[channels * i], 3, &rgb.samples()[3 * i]);
  }
  return rgb;
}

}  // namespace

Picture pictureOf(const Capture& capture, int view, int light) {
  const Size size = capture.size(view);
  Picture picture(size, 4);
  tbb::parallel_for(0, size.height, [&](int y) {
    const Rectangle row{0, y, size.width, 1};
    std::vector<float> samples(3 * row.pixels()), coverage(row.pixels(), 1.0F);
    capture.read(view, row, std::span(&light, 1), samples);
    if (capture.hasMask()) capture.readMask(view, row, coverage);
    for (std::size_t x = 0; x < row.pixels(); ++x) {
      float* rgba = &picture.row(y)[4 * x];
      for (std::size_t c = 0; c < 3; ++c) rgba[c] = coverage[x] * samples[c * row.pixels() + x];
      rgba[3] = coverage[x];
    }
  });
  return picture;
}

Picture depthOf(const Capture& capture, int view) {
  const Size size = capture.size(view);
  Picture depth(size, 1);
  tbb::parallel_for(0, size.height, [&](int y) {
    capture.readDepth(view, {0, y, size.width, 1}, depth.row(y));
  });
  return depth;
}

void Score::add(const Picture& found, const Picture& truth) {
  sum_ +=
      comparePictures(displayBytes(withoutCoverage(found)), displayBytes(withoutCoverage(truth)))
          .psnrDecibels;
  ++count_;
}

double coverageShare(const Picture& found, const Picture& truth) {
  double covered = 0, all = 0;
  for (std::size_t i = 3; i < truth.samples().size(); i += 4) {
    all += truth.samples()[i];
    covered += std::min(found.samples()[i], truth.samples()[i]);
  }
  return all > 0 ? covered / all : 1;
}

void writeSheet(const std::filesystem::path& file, const std::vector<Picture>& pictures) {
  const Size one = pictures.front().size();
  Picture sheet({one.width * static_cast<int>(pictures.size()), one.height}, 3);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture rgb = withoutCoverage(pictures[i]);
    for (int y = 0; y < one.height; ++y) {
      std::ranges::copy(
          rgb.row(y), sheet.row(y).begin() + static_cast<std::ptrdiff_t>(3 * i * rgb.size().width));
    }
  }
  writePicture(file, sheet);
}

}  // namespace illum::bench
