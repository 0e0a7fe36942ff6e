// What studies of held-out views share: rendering for comparison, scores, sheets of pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "illum/capture.h"
#include "illum/picture.h"

namespace illum::bench {

/// RGBA, premultiplied, of one view of a capture under one of its lights. Rendered in parallel.
Picture pictureOf(const Capture& capture, int view, int light);
/// One channel, as Capture::readDepth.
Picture depthOf(const Capture& capture, int view);

/// PSNR in decibels over 8-bit sRGB at exposure 0, over black (docs/quality.md). Mean of pictures.
class Score {
 public:
  void add(const Picture& found, const Picture& truth);
  double decibels() const { return sum_ / count_; }
  int pictures() const { return count_; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

/// The share of what the truth covers that the picture covers too.
double coverageShare(const Picture& found, const Picture& truth);

/// Pictures of one size beside each other, as a PNG.
void writeSheet(const std::filesystem::path& file, const std::vector<Picture>& pictures);

}  // namespace illum::bench
