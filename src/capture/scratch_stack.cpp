#include "capture/scratch_stack.h"

#include <algorithm>
#include <cstring>

#include "core/page_buffer.h"

namespace illum {
namespace {

constexpr int kRowsPerCall = 16;

}  // namespace

ScratchStack::ScratchStack(const std::filesystem::path& folder,
                           const std::vector<Photograph>& photographs, int rows,
                           const BandPlan& plan)
    : rows_(rows), bandRows_(plan.rows), file_(folder, plan.scratchBytes) {
  std::uint64_t rowOfAll = 0;
  for (const Photograph& photograph : photographs) {
    const bool here = needsScratch(photograph);
    offsetOfRow_.push_back(rowOfAll);
    rowBytes_.push_back(here ? uprightRowBytes(photograph) : 0);
    rowOfAll += rowBytes_.back();
    count_ += here ? 1 : 0;
  }
  bandBytes_ = rowOfAll * static_cast<unsigned>(bandRows_);
}

std::uint64_t ScratchStack::placeOf(std::size_t i, int row) const {
  const auto band = static_cast<std::uint64_t>(row / bandRows_);
  const auto rowInBand = static_cast<std::uint64_t>(row % bandRows_);
  return band * bandBytes_ + offsetOfRow_[i] * static_cast<unsigned>(bandRows_) +
         rowInBand * rowBytes_[i];
}

void ScratchStack::read(std::size_t i, int firstRow, int count, std::byte* samples) const {
  file_.read(placeOf(i, firstRow), {samples, rowBytes_[i] * static_cast<std::size_t>(count)});
}

void ScratchStack::writeRows(std::size_t i, int firstRow, int count, const std::byte* samples) {
  for (int done = 0; done < count;) {
    const int row = firstRow + done;
    const int inBand = std::min(count - done, bandRows_ - row % bandRows_);
    const std::byte* from = samples + rowBytes_[i] * static_cast<std::size_t>(done);
    file_.write(placeOf(i, row), {from, rowBytes_[i] * static_cast<std::size_t>(inBand)});
    done += inBand;
  }
}

void ScratchStack::fill(std::size_t i, FilePool& pool, const Photograph& photograph, int top) {
  const std::unique_ptr<PhotographReader> reader = openPhotograph(pool, photograph);
  if (photograph.header.orientation.keepsRowOrder()) {
    fillInOrder(i, *reader, top);
  } else {
    fillTurned(i, *reader, photograph, top);
  }
}

void ScratchStack::fillInOrder(std::size_t i, PhotographReader& reader, int top) {
  std::vector<std::byte> samples(rowBytes_[i] * kRowsPerCall);
  for (int row = -top; row < rows_;) {
    const int count = std::min(kRowsPerCall, (row < 0 ? 0 : rows_) - row);
    reader.read(count, samples.data());
    if (row >= 0) writeRows(i, row, count, samples.data());
    row += count;
  }
}

// Sixteen upright rows are sixteen neighbouring columns of the file where axes are exchanged: the
// inner loop goes along them, so that each stored row is touched once for all.
void ScratchStack::fillTurned(std::size_t i, PhotographReader& reader, const Photograph& photograph,
                              int top) {
  const Size stored = photograph.header.stored;
  const PageBuffer whole(photograph.bytes());
  reader.read(stored.height, whole.data());
  const Orientation::Map map = photograph.header.orientation.storedFromUpright(stored);
  const std::size_t pixelBytes = photograph.pixelBytes();
  std::vector<std::byte> samples(rowBytes_[i] * kRowsPerCall);
  for (int row = 0; row < rows_; row += kRowsPerCall) {
    const int count = std::min(kRowsPerCall, rows_ - row);
    for (int x = 0; x < photograph.header.upright().width; ++x) {
      for (int k = 0; k < count; ++k) {
        const int y = top + row + k;
        const auto storedX = static_cast<std::size_t>(map.x0 + map.xx * x + map.xy * y);
        const auto storedY = static_cast<std::size_t>(map.y0 + map.yx * x + map.yy * y);
        std::memcpy(samples.data() + rowBytes_[i] * static_cast<std::size_t>(k) +
                        pixelBytes * static_cast<std::size_t>(x),
                    whole.data() + storedY * photograph.rowBytes() + storedX * pixelBytes,
                    pixelBytes);
      }
    }
    writeRows(i, row, count, samples.data());
  }
}

}  // namespace illum
