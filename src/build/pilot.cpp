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
constexpr std::size_t kMaxPixels = 250000;
constexpr double kMaxMomentOperations = 1e11;  // about two seconds of one core

// Of the pixels that are rendered, so many are rendered once more beforehand: enough to choose by,
// and little beside the rest. Small captures still give as many as choosing needs.
constexpr double kRenderedShare = 1.0 / 12;
constexpr double kLeastRendered = 16384;

struct Block {
  int group = 0;
  Rectangle pixels;
};

// The blocks of one row of blocks that belong to the pilot; `turn` counts such rows over all
// pictures.
void addBlocksOfRow(Size size, int group, int blockRow, int turn, int stride,
                    std::vector<Block>& blocks) {
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
std::vector<std::vector<Block>> rowsOfBlocks(const Capture& capture, std::span<const int> groups,
                                             int stride) {
  // Rows of small pictures hold too few blocks for many threads; where order does not matter,
  // several are read at once.
  constexpr std::size_t kTogether = 64;
  std::vector<std::vector<Block>> rows;
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
  // Products are summed in float over a slice and the slices in double, so that small eigenvalues
  // of the moments survive.
  constexpr std::size_t kSlice = 2048;
  const std::size_t rows = 3 * static_cast<std::size_t>(pilot.lights);
  Moments moments{std::vector<double>(rows), std::vector<double>(rows * rows)};
  std::vector<float> partial(rows * rows);
  const auto ld = static_cast<int>(pilot.pixels);
  for (; begin < end; begin += kSlice) {
    const std::size_t count = std::min(kSlice, end - begin);
    cblas_ssyrk(CblasRowMajor, CblasUpper, CblasNoTrans, static_cast<int>(rows),
                static_cast<int>(count), 1.0f, pilot.samples.data() + begin, ld, 0.0f,
                partial.data(), static_cast<int>(rows));
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = i; j < rows; ++j) {
        moments.products[i * rows + j] += static_cast<double>(partial[i * rows + j]);
      }
      const float* row = pilot.samples.data() + i * pilot.pixels + begin;
      for (std::size_t p = 0; p < count; ++p) moments.sum[i] += static_cast<double>(row[p]);
    }
  }
  return moments;
}

struct BlockSamples {
  std::size_t pixels = 0;
  std::vector<float> samples;  // rows x pixels
};

BlockSamples readBlock(const Capture& capture, const Block& block, std::span<const int> lights) {
  const std::size_t rows = 3 * lights.size(), pixels = block.pixels.pixels();
  BlockSamples out{pixels, std::vector<float>(rows * pixels)};
  capture.read(block.group, block.pixels, lights, out.samples);
  if (!capture.hasMask()) return out;

  // What is rendered is the mean over the covered part, however small; photographs are mixed with
  // what lies behind.
  const float least = capture.isRendered() ? std::numeric_limits<float>::min() : 0.5f;
  std::vector<float> coverage(pixels);
  capture.readMask(block.group, block.pixels, coverage);
  std::size_t kept = 0;
  std::vector<std::size_t> source;
  for (std::size_t p = 0; p < pixels; ++p) {
    if (coverage[p] >= least) source.push_back(p), ++kept;
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t p = 0; p < kept; ++p) {
      out.samples[row * kept + p] = out.samples[row * pixels + source[p]];
    }
  }
  out.pixels = kept;
  out.samples.resize(rows * kept);
  return out;
}

}  // namespace

std::size_t pilotPixels(const Capture& capture, std::uint64_t allPixels, int lights,
                        std::uint64_t memoryBytes) {
  const double rows = 3.0 * lights;
  const double byCost = kMaxMomentOperations / (rows * rows);
  // The samples stand in memory twice while blocks are put together.
  const double byMemory = static_cast<double>(memoryBytes) / (4.0 * sizeof(float) * rows);
  double pixels = std::min({static_cast<double>(kMaxPixels), byCost, byMemory});
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
  std::vector<BlockSamples> parts;
  for (const std::vector<Block>& blocks : rowsOfPilot) {
    const std::size_t first = parts.size();
    parts.resize(first + blocks.size());
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      parts[first + i] = readBlock(capture, blocks[i], lights);
    });
    progress.advance();
  }
  progress.end();

  Pilot pilot;
  pilot.lights = static_cast<int>(lights.size());
  pilot.complete = stride == 1;
  for (const auto& part : parts) pilot.pixels += part.pixels;
  if (pilot.pixels == 0) {
    // Between the blocks there may be something.
    if (stride > 1) return drawPilot(capture, groups, lights, 4 * maxPixels, progress);
    throw Error(Fault::Input, capture.isRendered()
                                  ? "the views show nothing: expected something of the scene in "
                                    "at least one pixel, found none"
                                  : "the mask leaves no pixel of the photographs: expected "
                                    "coverage of at least one half somewhere, found none");
  }
  const std::size_t rows = 3 * lights.size();
  pilot.samples.resize(rows * pilot.pixels);
  std::size_t at = 0;
  for (auto& part : parts) {
    for (std::size_t row = 0; row < rows; ++row) {
      std::copy_n(part.samples.data() + row * part.pixels, part.pixels,
                  pilot.samples.data() + row * pilot.pixels + at);
    }
    at += part.pixels;
    part = {};
  }
  return pilot;
}

SampleStatistics statisticsOf(const Pilot& pilot) {
  const std::size_t rows = 3 * static_cast<std::size_t>(pilot.lights);
  // A fixed number of parts, added up in their order: the sum does not depend on the threads.
  std::vector<Moments> parts(kMomentParts);
  tbb::parallel_for(std::size_t{0}, kMomentParts, [&](std::size_t part) {
    const std::size_t begin = pilot.pixels * part / kMomentParts;
    const std::size_t end = pilot.pixels * (part + 1) / kMomentParts;
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
