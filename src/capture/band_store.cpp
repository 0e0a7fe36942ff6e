#include "capture/band_store.h"

#include <fmt/format.h>
#include <tbb/collaborative_call_once.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "capture/lanes.h"
#include "capture/progress_stage.h"
#include "capture/scratch_stack.h"
#include "core/page_buffer.h"

namespace illum {
namespace {

constexpr std::size_t kSlotAlignment = 64;

std::size_t aligned(std::size_t bytes) {
  return (bytes + kSlotAlignment - 1) / kSlotAlignment * kSlotAlignment;
}

// Where a photograph's rows lie in the buffer, and how.
struct Slot {
  std::size_t offset = 0;
  std::size_t pixelBytes = 0, rowBytes = 0;
  Orientation::Map map;       // from upright to positions in the slot
  bool startsAtBand = false;  // the slot's row 0 is the band's first row, not the photograph's
};

// A photograph that is read band by band.
struct OpenDecoder {
  std::unique_ptr<PhotographReader> reader;
  int nextRow = 0;  // stored row
};

// One band while somebody wants it.
struct Resident {
  int band = -1;
  tbb::collaborative_once_flag decoded;
};

}  // namespace

struct BandStore::State {
  FilePool& pool;
  std::vector<Photograph> photographs;
  int top, rows;
  BandPlan plan;
  std::filesystem::path scratchFolder;
  Progress& progress;

  std::vector<Slot> slots;
  std::size_t bufferBytes = 0;
  PageBuffer buffer;
  std::vector<OpenDecoder> decoders;
  std::unique_ptr<ScratchStack> scratch;

  std::mutex mutex;
  std::condition_variable released;
  int users = 0;
  std::unique_ptr<Resident> resident;

  void layOut();
  void acquire(int band);
  void release();
  void load(int band);
  void loadWhole();
  void loadBand(int band);
  void loadRows(std::size_t i, int firstRow, int count);
  void fillScratch();
  int firstRowOf(int band) const { return band * plan.rows; }
  int endRowOf(int band) const { return std::min(firstRowOf(band) + plan.rows, rows); }
};

void BandStore::State::layOut() {
  for (const Photograph& photograph : photographs) {
    const PhotographHeader& header = photograph.header;
    const bool upright = !plan.whole && needsScratch(photograph);
    Slot slot;
    slot.offset = bufferBytes;
    slot.pixelBytes = photograph.pixelBytes();
    slot.rowBytes = upright ? uprightRowBytes(photograph) : photograph.rowBytes();
    if (!upright) slot.map = header.orientation.storedFromUpright(header.stored);
    slot.startsAtBand = !plan.whole;
    slots.push_back(slot);
    bufferBytes += aligned(slot.rowBytes *
                           static_cast<std::size_t>(plan.whole ? header.stored.height : plan.rows));
  }
  decoders.resize(photographs.size());
}

// Only the last one who leaves a band makes room for another. Nobody keeps a band while waiting
// here, so waiting always ends.
void BandStore::State::acquire(int band) {
  Resident* wanted = nullptr;
  {
    std::unique_lock lock(mutex);
    released.wait(lock, [&] { return users == 0 || (resident && resident->band == band); });
    if (!resident || resident->band != band) {
      resident = std::make_unique<Resident>();
      resident->band = band;
    }
    wanted = resident.get();
    ++users;
  }
  try {
    // Threads that come while it is decoded join in: blocking them would leave the decoding to one.
    tbb::collaborative_call_once(wanted->decoded, [&] { load(band); });
  } catch (...) {
    release();
    throw;
  }
}

void BandStore::State::release() {
  const std::lock_guard lock(mutex);
  if (--users == 0) released.notify_all();
}

void BandStore::State::load(int band) {
  if (buffer.bytes() == 0) {
    if (plan.scratchBytes > 0) fillScratch();
    buffer = PageBuffer(bufferBytes);
  }
  try {
    plan.whole ? loadWhole() : loadBand(band);
  } catch (...) {
    // A decoder that failed is of no use, and another attempt must fail in the same way.
    std::ranges::for_each(decoders, [](OpenDecoder& decoder) { decoder = {}; });
    throw;
  }
}

void BandStore::State::loadWhole() {
  const ProgressStage stage(progress, fmt::format("decoding {} photographs", photographs.size()),
                            photographs.size());
  forEachInLanes(photographs.size(), plan.lanes, [this](std::size_t i) {
    openPhotograph(pool, photographs[i])
        ->read(photographs[i].header.stored.height, buffer.data() + slots[i].offset);
    progress.advance();
  });
}

void BandStore::State::loadBand(int band) {
  const int firstRow = firstRowOf(band), count = endRowOf(band) - firstRow;
  forEachInLanes(photographs.size(), availableThreads(), [&](std::size_t i) {
    if (!needsScratch(photographs[i])) return loadRows(i, firstRow, count);
    scratch->read(i, firstRow, count, buffer.data() + slots[i].offset);
  });
}

void BandStore::State::loadRows(std::size_t i, int firstRow, int count) {
  OpenDecoder& decoder = decoders[i];
  if (!decoder.reader || decoder.nextRow > top + firstRow) {
    decoder = {openPhotograph(pool, photographs[i]), 0};
  }
  std::byte* samples = buffer.data() + slots[i].offset;
  // Rows that are passed over are decoded to where the band's will be.
  while (decoder.nextRow < top + firstRow) {
    const int skipped = std::min(top + firstRow - decoder.nextRow, count);
    decoder.reader->read(skipped, samples);
    decoder.nextRow += skipped;
  }
  decoder.reader->read(count, samples);
  decoder.nextRow += count;
}

void BandStore::State::fillScratch() {
  auto stack = std::make_unique<ScratchStack>(scratchFolder, photographs, rows, plan);
  const ProgressStage stage(
      progress, fmt::format("decoding {} photographs into a scratch file", stack->count()),
      stack->count());
  forEachInLanes(photographs.size(), plan.lanes, [&](std::size_t i) {
    if (!needsScratch(photographs[i])) return;
    stack->fill(i, pool, photographs[i], top);
    progress.advance();
  });
  scratch = std::move(stack);
}

BandStore::BandStore(FilePool& pool, std::vector<Photograph> photographs, int top, int rows,
                     const BandPlan& plan, std::filesystem::path scratch, Progress& progress)
    : state_(new State{pool,
                       std::move(photographs),
                       top,
                       rows,
                       plan,
                       std::move(scratch),
                       progress,
                       {},
                       0,
                       {},
                       {},
                       {},
                       {},
                       {},
                       0,
                       {}}) {
  state_->layOut();
}

BandStore::~BandStore() = default;

const std::vector<Photograph>& BandStore::photographs() const {
  return state_->photographs;
}

BandStore::Pin BandStore::pin(int row) const {
  return {*this, row / state_->plan.rows};
}

BandStore::Pin::Pin(const BandStore& store, int band)
    : store_(store),
      firstRow_(store.state_->firstRowOf(band)),
      endRow_(store.state_->endRowOf(band)) {
  store.state_->acquire(band);
}

BandStore::Pin::~Pin() {
  store_.state_->release();
}

PixelRun BandStore::Pin::at(std::size_t photograph, int x, int y) const {
  const State& state = *store_.state_;
  const Slot& slot = state.slots[photograph];
  const Orientation::Map& map = slot.map;
  const int row = slot.startsAtBand ? y - firstRow_ : state.top + y;
  const auto storedX = static_cast<std::size_t>(map.x0 + map.xx * x + map.xy * row);
  const auto storedY = static_cast<std::size_t>(map.y0 + map.yx * x + map.yy * row);
  return {state.buffer.data() + slot.offset + storedY * slot.rowBytes + storedX * slot.pixelBytes,
          map.xx * static_cast<std::ptrdiff_t>(slot.pixelBytes) +
              map.yx * static_cast<std::ptrdiff_t>(slot.rowBytes)};
}

}  // namespace illum
