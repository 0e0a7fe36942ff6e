#include "build/pilot.h"

#include <cblas.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "illum/error.h"

namespace illum {
namespace {

constexpr int kBlockSide = 16;
// Small photographs are looked at whole; of large ones so many pixels tell no less.
constexpr std::size_t kWholePixels = 250000, kMaxPixels = 100000;
constexpr double kMaxMomentOperations = 1e11;  // about two seconds of one core

// Of the pixels that are rendered, so many are rendered once more beforehand: enough to choose by,
// and little beside the rest. Small captures still give as many as choosing needs.
constexpr double kRenderedShare = 1.0 / 12;
constexpr double kLeastRendered = 16384;

struct Place {
  int group = 0;
  Rectangle pixels;
};

// The blocks of one row of blocks that belong to the pilot; `turn` counts such rows over all
// pictures.
void addBlocksOfRow(Size size, int group, int blockRow, int turn, int stride,
                    std::vector<Place>& blocks) {
  const int across = (size.width + kBlockSide - 1) / kBlockSide;
  // Rows are shifted against one another by the golden section, so that no column is never seen.
  const int shift = static_cast<int>(std::fmod(0.6180339887 * turn * stride, stride));
  for (int column = shift; column < across; column += stride) {
    const int x = column * kBlockSide, y = blockRow * kBlockSide;
    blocks.push_back(
        {group,
         {x, y, std::min(kBlockSide, size.width - x), std::min(kBlockSide, size.height - y)}});
  }
}

// Every `stride`-th row of blocks, counted on from picture to picture; what is read side by side.
std::vector<std::vector<Place>> rowsOfBlocks(const Capture& capture, std::span<const int> groups,
                                             int stride) {
  // Rows of small pictures hold too few blocks for many threads; where order does not matter,
  // several are read at once.
  constexpr std::size_t kTogether = 64;
  std::vector<std::vector<Place>> rows;
  int counted = 0;
  for (const int group : groups) {
    const Size size = capture.size(group);
    const int down = (size.height + kBlockSide - 1) / kBlockSide;
    for (int blockRow = 0; blockRow < down; ++blockRow, ++counted) {
      if (counted % stride != 0) continue;
      if (rows.empty() || !capture.isRendered() || rows.back().size() >= kTogether)
        rows.emplace_back();
      addBlocksOfRow(size, group, blockRow, counted / stride, stride, rows.back());
    }
  }
  return rows;
}

constexpr std::size_t kMomentParts = 8;

// Sums over some pixels; of the products only the upper triangle.
struct Moments {
  std::vector<double> sum, products;
};

Moments momentsOf(const Pilot& pilot, std::size_t begin, std::size_t end) {
  // Products are summed in float over a block and the blocks in double, so that small eigenvalues
  // of the moments survive.
  const std::size_t rows = 3 * static_cast<std::size_t>(pilot.lights);
  Moments moments{std::vector<double>(rows), std::vector<double>(rows * rows)};
  std::vector<float> partial(rows * rows);
  for (; begin < end; ++begin) {
    const Pilot::Block& block = pilot.blocks[begin];
    if (block.pixels == 0) continue;
    const float* samples = pilot.samples(block).data();
    cblas_ssyrk(CblasRowMajor, CblasUpper, CblasNoTrans, static_cast<int>(rows),
                static_cast<int>(block.pixels), 1.0f, samples, static_cast<int>(block.pixels), 0.0f,
                partial.data(), static_cast<int>(rows));
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = i; j < rows; ++j) {
        moments.products[i * rows + j] += static_cast<double>(partial[i * rows + j]);
      }
      for (std::size_t p = 0; p < block.pixels; ++p) {
        moments.sum[i] += static_cast<double>(samples[i * block.pixels + p]);
      }
    }
  }
  return moments;
}

// Reads the samples of a block and keeps those of its unmasked pixels.
void readBlock(const Capture& capture, const Place& place, std::span<const int> lights,
               const Pilot& pilot, Pilot::Block& block) {
  const std::span<float> samples = pilot.samples(block);
  capture.read(place.group, place.pixels, lights, samples);
  if (!capture.hasMask()) return;

  // What is rendered is the mean over the covered part, however small; photographs are mixed with
  // what lies behind.
  const float least = capture.isRendered() ? std::numeric_limits<float>::min() : 0.5f;
  std::vector<float> coverage(block.pixels);
  capture.readMask(place.group, place.pixels, coverage);
  std::vector<std::size_t> kept;
  for (std::size_t p = 0; p < block.pixels; ++p) {
    if (coverage[p] >= least) kept.push_back(p);
  }
  std::size_t to = 0;
  for (std::size_t row = 0; row < samples.size(); row += block.pixels) {
    for (const std::size_t p : kept) samples[to++] = samples[row + p];
  }
  block.pixels = kept.size();
}

}  // namespace

std::size_t pilotPixels(const Capture& capture, std::uint64_t allPixels, int lights,
                        std::size_t pilots, std::uint64_t memoryBytes) {
  const double rows = 3.0 * lights;
  const double byCost = kMaxMomentOperations / (rows * rows);
  // Beside the samples stand the planes that are tried on them.
  const double byMemory = static_cast<double>(memoryBytes) / (2.0 * sizeof(float) * rows);
  const bool whole = allPixels <= kWholePixels / pilots;
  double pixels =
      std::min({static_cast<double>(whole ? kWholePixels : kMaxPixels), byCost, byMemory}) /
      static_cast<double>(pilots);
  if (capture.isRendered()) {
    const double share = kRenderedShare * static_cast<double>(allPixels);
    pixels = std::min(pixels, std::max(kLeastRendered, share));
  }
  return std::max<std::size_t>(4096, static_cast<std::size_t>(pixels));
}

Pilot drawPilot(const Capture& capture, std::span<const int> groups, std::span<const int> lights,
                std::size_t maxPixels, Progress& progress) {
  double all = 0;
  for (const int group : groups) all += static_cast<double>(capture.size(group).pixels());
  const double share = static_cast<double>(maxPixels) / all;
  const int stride = share >= 1 ? 1 : static_cast<int>(std::ceil(1 / std::sqrt(share)));
  const auto rowsOfPilot = rowsOfBlocks(capture, groups, stride);

  progress.begin(
      capture.isRendered() ? "rendering a few pixels to choose by" : "looking over the photographs",
      rowsOfPilot.size());
  Pilot pilot;
  pilot.lights = static_cast<int>(lights.size());
  pilot.complete = stride == 1;
  std::size_t floats = 0;
  for (const std::vector<Place>& row : rowsOfPilot) {
    for (const Place& place : row) {
      pilot.blocks.push_back({floats, place.pixels.pixels()});
      floats += 3 * lights.size() * place.pixels.pixels();
    }
  }
  pilot.memory = PageBuffer(floats * sizeof(float));
  std::size_t first = 0;
  for (const std::vector<Place>& row : rowsOfPilot) {
    tbb::parallel_for(std::size_t{0}, row.size(), [&](std::size_t i) {
      readBlock(capture, row[i], lights, pilot, pilot.blocks[first + i]);
    });
    first += row.size();
    progress.advance();
  }
  progress.end();
  for (const Pilot::Block& block : pilot.blocks) pilot.pixels += block.pixels;
  if (pilot.pixels == 0) {
    // Between the blocks there may be something.
    if (stride > 1) return drawPilot(capture, groups, lights, 4 * maxPixels, progress);
    throw Error(Fault::Input, capture.isRendered()
                                  ? "the views show nothing: expected something of the scene in "
                                    "at least one pixel, found none"
                                  : "the mask leaves no pixel of the photographs: expected "
                                    "coverage of at least one half somewhere, found none");
  }
  return pilot;
}

SampleStatistics statisticsOf(const Pilot& pilot) {
  const std::size_t rows = 3 * static_cast<std::size_t>(pilot.lights);
  // A fixed number of parts, added up in their order: the sum does not depend on the threads.
  std::vector<Moments> parts(kMomentParts);
  tbb::parallel_for(std::size_t{0}, kMomentParts, [&](std::size_t part) {
    const std::size_t begin = pilot.blocks.size() * part / kMomentParts;
    const std::size_t end = pilot.blocks.size() * (part + 1) / kMomentParts;
    parts[part] = momentsOf(pilot, begin, end);
  });
  SampleStatistics statistics;
  statistics.lights = pilot.lights;
  statistics.pixels = pilot.pixels;
  statistics.mean.assign(rows, 0);
  statistics.gram.assign(rows * rows, 0);
  const double scale = 1.0 / static_cast<double>(pilot.pixels);
  for (const Moments& part : parts) {
    for (std::size_t i = 0; i < rows; ++i) statistics.mean[i] += scale * part.sum[i];
    for (std::size_t i = 0; i < rows * rows; ++i) statistics.gram[i] += scale * part.products[i];
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = i; j < rows; ++j) {
      statistics.gram[j * rows + i] = statistics.gram[i * rows + j];
    }
  }
  return statistics;
}

}  // namespace illum
