#include <algorithm>
#include <cmath>

#include "core/files.h"
#include "illum/error.h"
#include "illum/normals.h"
#include "illum/picture_io.h"
#include "image/formats.h"

namespace illum {
namespace {

using WordPicture = PictureOf<std::uint16_t>;

std::uint16_t wordOf(double unit) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(unit, 0.0, 1.0)));
}

PictureFormat shapeFormat(const std::filesystem::path& file) {
  const PictureFormat format = pictureFormat(file);
  if (format == PictureFormat::Jpeg) {
    throw Error(Fault::Usage,
                file.string() + ": expected a name that ends in .png or .exr, found a JPEG's");
  }
  return format;
}

}  // namespace

void writeNormals(const std::filesystem::path& file, const Picture& normals) {
  const bool words = shapeFormat(file) == PictureFormat::Png;
  Picture floats(words ? Size() : normals.size(), 4);
  WordPicture stored(words ? normals.size() : Size(), 4);
  for (std::size_t i = 0; i < normals.size().pixels(); ++i) {
    const float* n = normals.samples().data() + 3 * i;
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      if (words)
        stored.samples()[4 * i + c] = wordOf((n[c] + 1.0) / 2);
      else
        floats.samples()[4 * i + c] = n[c];
    }
    if (words)
      stored.samples()[4 * i + 3] = 65535;
    else
      floats.samples()[4 * i + 3] = 1;
  }
  if (words)
    writeFileAtomically(file, encodePng(stored, PngTransfer::Unsaid));
  else
    writePicture(file, floats);
}

HeightRange writeHeights(const std::filesystem::path& file, const Picture& heights) {
  const bool words = shapeFormat(file) == PictureFormat::Png;
  const auto samples = heights.samples();
  const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end());
  const HeightRange range{*lowest, *highest};
  if (!words) {
    writePicture(file, heights);
    return range;
  }
  WordPicture stored(heights.size(), 1);
  const double span = std::max(range.highest - range.lowest, 1e-12);
  for (std::size_t i = 0; i < samples.size(); ++i)
    stored.samples()[i] = wordOf((samples[i] - range.lowest) / span);
  writeFileAtomically(file, encodePng(stored, PngTransfer::Linear));
  return range;
}

}  // namespace illum
