#include "capture/photograph_stack.h"

#include <fmt/format.h>
#include <hwy/cache_control.h>
#include <tbb/collaborative_call_once.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "capture/band_store.h"
#include "capture/lanes.h"
#include "capture/progress_stage.h"
#include "capture/sample_rows.h"
#include "core/files.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::size_t kChecksumBytes = 1 << 18;  // read at a time

std::uint32_t checksumOf(FilePool& pool, std::size_t file) {
  std::vector<std::byte> buffer(kChecksumBytes);
  std::uint32_t crc = 0;
  for (std::uint64_t offset = 0;;) {
    const std::size_t got = pool.read(file, offset, buffer);
    if (got == 0) return crc;
    crc = crc32Of(std::span(buffer).first(got), crc);
    offset += got;
  }
}

// Asks for the bytes of a run before they are needed: every light's rows lie far from the one
// before it, so that the processor does not foresee them.
void fetch(const PixelRun& run, std::size_t pixels) {
  constexpr std::ptrdiff_t kCacheLine = 64;
  if (run.step < 0 || run.step > kCacheLine) return;
  const std::ptrdiff_t bytes = run.step * static_cast<std::ptrdiff_t>(pixels);
  for (std::ptrdiff_t at = 0; at < bytes; at += kCacheLine) hwy::Prefetch(run.first + at);
}

class PhotographStack final : public Capture, private ByteSamples {
 public:
  PhotographStack(StackParts parts, Progress& progress);

  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return transfer_; }
  const std::vector<LightFileEntry>& lights() const override { return parts_.lights; }
  bool hasMask() const override { return !parts_.mask.empty() || hasAlpha_; }
  void read(int group, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override;
  const ByteSamples* bytes() const override { return areBytes_ ? this : nullptr; }
  void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const override;
  int bandRows() const override { return parts_.plan.rows / parts_.region.shrink; }
  std::uint64_t residentBytes() const override { return parts_.plan.residentBytes; }
  std::string fingerprint() const override;

 private:
  void readBytes(int group, const Rectangle& rectangle, std::span<const int> lights,
                 std::span<std::uint8_t> samples) const override;
  // Calls `row(pin, light, y, rgb)` for each row of each light, `rgb` where its samples go.
  template <typename T, typename Row>
  void eachRow(const Rectangle& rectangle, std::span<const int> lights, std::span<T> samples,
               Row row) const;
  // Calls `rows(pin, first, end)` for each band that the rectangle touches; rows of the capture.
  template <typename Rows>
  void eachBand(const Rectangle& rectangle, Rows rows) const;
  // The run of source pixels that begins with the capture's column x, `row` of the store.
  PixelRun runAt(const BandStore::Pin& pin, std::size_t light, int x, int row) const {
    return pin.at(light, parts_.region.crop.x + x * parts_.region.shrink, row);
  }
  void readRow(const BandStore::Pin& pin, std::size_t light, int x, int y, std::size_t width,
               std::span<float* const, 3> rgb) const;
  void shrinkRow(const BandStore::Pin& pin, std::size_t light, int x, int y, std::size_t width,
                 std::span<float* const, 3> rgb) const;
  void maskRow(int x, int y, std::size_t width, float* coverage) const;
  void alphaRow(const BandStore::Pin& pin, int x, int y, std::size_t width, float* coverage) const;
  std::string describe() const;

  StackParts parts_;
  std::vector<View> views_;
  Progress& progress_;
  std::unique_ptr<BandStore> store_;
  std::vector<RowConverter> converters_;
  Transfer transfer_ = Transfer::Display;
  bool hasAlpha_ = false, areBytes_ = false;
  mutable tbb::collaborative_once_flag described_;
  mutable std::string fingerprint_;
};

PhotographStack::PhotographStack(StackParts parts, Progress& progress)
    : parts_(std::move(parts)),
      views_{{"photograph", OrthographicView{parts_.region.size()}}},
      progress_(progress) {
  transfer_ = parts_.photographs.front().colour.transfer;
  for (std::size_t i = 0; i < parts_.photographs.size(); ++i) {
    const Photograph& photograph = parts_.photographs[i];
    hasAlpha_ = hasAlpha_ || photograph.header.alpha;
    converters_.emplace_back(photograph.colour.type, photograph.header.channels(), transfer_,
                             parts_.lights[i].light.intensity);
  }
  areBytes_ =
      parts_.region.shrink == 1 && std::ranges::all_of(converters_, &RowConverter::isPlainBytes);
  store_ = std::make_unique<BandStore>(*parts_.pool, parts_.photographs, parts_.top, parts_.rows,
                                       parts_.plan, parts_.scratch, progress);
}

template <typename Rows>
void PhotographStack::eachBand(const Rectangle& rectangle, Rows rows) const {
  assert(rectangle.x >= 0 && rectangle.y >= 0 && rectangle.right() <= size().width &&
         rectangle.bottom() <= size().height);
  const int shrink = parts_.region.shrink;
  for (int y = rectangle.y; y < rectangle.bottom();) {
    const BandStore::Pin pin = store_->pin(y * shrink);
    const int end = std::min(rectangle.bottom(), pin.endRow() / shrink);
    rows(pin, y, end);
    y = end;
  }
}

template <typename T, typename Row>
void PhotographStack::eachRow(const Rectangle& rectangle, std::span<const int> lights,
                              std::span<T> samples, Row row) const {
  const std::size_t pixels = rectangle.pixels();
  assert(samples.size() >= 3 * lights.size() * pixels);
  const auto width = static_cast<std::size_t>(rectangle.width);
  eachBand(rectangle, [&](const BandStore::Pin& pin, int first, int end) {
    for (std::size_t l = 0; l < lights.size(); ++l) {
      for (int y = first; y < end; ++y) {
        if (l + 1 < lights.size()) {
          const auto next = static_cast<std::size_t>(lights[l + 1]);
          fetch(runAt(pin, next, rectangle.x, y * parts_.region.shrink),
                width * static_cast<std::size_t>(parts_.region.shrink));
        }
        T* to = samples.data() + 3 * l * pixels + static_cast<std::size_t>(y - rectangle.y) * width;
        row(pin, static_cast<std::size_t>(lights[l]), y,
            std::array<T*, 3>{to, to + pixels, to + 2 * pixels});
      }
    }
  });
}

void PhotographStack::read([[maybe_unused]] int group, const Rectangle& rectangle,
                           std::span<const int> lights, std::span<float> samples) const {
  assert(group == 0);
  const auto width = static_cast<std::size_t>(rectangle.width);
  eachRow(rectangle, lights, samples,
          [&](const BandStore::Pin& pin, std::size_t light, int y, std::array<float*, 3> rgb) {
            readRow(pin, light, rectangle.x, y, width, rgb);
          });
}

void PhotographStack::readBytes([[maybe_unused]] int group, const Rectangle& rectangle,
                                std::span<const int> lights,
                                std::span<std::uint8_t> samples) const {
  assert(group == 0 && areBytes_);
  const auto width = static_cast<std::size_t>(rectangle.width);
  eachRow(
      rectangle, lights, samples,
      [&](const BandStore::Pin& pin, std::size_t light, int y, std::array<std::uint8_t*, 3> rgb) {
        const PixelRun run = runAt(pin, light, rectangle.x, y);
        converters_[light].toBytes(run.first, run.step, width, rgb);
      });
}

void PhotographStack::readRow(const BandStore::Pin& pin, std::size_t light, int x, int y,
                              std::size_t width, std::span<float* const, 3> rgb) const {
  if (parts_.region.shrink > 1) return shrinkRow(pin, light, x, y, width, rgb);
  const PixelRun run = runAt(pin, light, x, y);
  converters_[light].toTransfer(run.first, run.step, width, rgb);
}

void PhotographStack::shrinkRow(const BandStore::Pin& pin, std::size_t light, int x, int y,
                                std::size_t width, std::span<float* const, 3> rgb) const {
  const auto shrink = static_cast<std::size_t>(parts_.region.shrink);
  const std::size_t count = width * shrink;
  std::vector<float> linear(3 * count), sums(3 * width, 0.0f);
  const std::array<float*, 3> planes{linear.data(), linear.data() + count,
                                     linear.data() + 2 * count};
  for (int k = 0; k < parts_.region.shrink; ++k) {
    const PixelRun run = runAt(pin, light, x, y * parts_.region.shrink + k);
    converters_[light].toLinear(run.first, run.step, count, planes);
    for (std::size_t i = 0; i < linear.size(); ++i) sums[i / shrink] += linear[i];
  }
  const auto box = static_cast<float>(shrink * shrink);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float mean = sums[i] / box;
    rgb[i / width][i % width] = transfer_ == Transfer::Display ? displayFromLinear(mean) : mean;
  }
}

void PhotographStack::readMask([[maybe_unused]] int group, const Rectangle& rectangle,
                               std::span<float> coverage) const {
  assert(group == 0 && coverage.size() >= rectangle.pixels());
  const auto width = static_cast<std::size_t>(rectangle.width);
  const auto rowOf = [&](int y) {
    return coverage.data() + static_cast<std::size_t>(y - rectangle.y) * width;
  };
  if (!hasMask()) {
    std::fill_n(coverage.begin(), rectangle.pixels(), 1.0f);
  } else if (!parts_.mask.empty()) {
    for (int y = rectangle.y; y < rectangle.bottom(); ++y) maskRow(rectangle.x, y, width, rowOf(y));
  } else {
    eachBand(rectangle, [&](const BandStore::Pin& pin, int first, int end) {
      for (int y = first; y < end; ++y) alphaRow(pin, rectangle.x, y, width, rowOf(y));
    });
  }
}

void PhotographStack::maskRow(int x, int y, std::size_t width, float* coverage) const {
  const int shrink = parts_.region.shrink;
  const float white = 255.0f * static_cast<float>(shrink * shrink);
  for (std::size_t i = 0; i < width; ++i) {
    const int left = parts_.region.crop.x + (x + static_cast<int>(i)) * shrink;
    int sum = 0;
    for (int k = 0; k < shrink * shrink; ++k) {
      const int row = parts_.region.crop.y + y * shrink + k / shrink;
      sum += parts_.mask.at(left + k % shrink, row, 0);
    }
    coverage[i] = static_cast<float>(sum) / white;
  }
}

// The least of the photographs' own: a pixel that one of them does not show is none of the
// object's.
void PhotographStack::alphaRow(const BandStore::Pin& pin, int x, int y, std::size_t width,
                               float* coverage) const {
  const auto shrink = static_cast<std::size_t>(parts_.region.shrink);
  const std::size_t count = width * shrink;
  std::vector<float> one(count), least(count), sums(width, 0.0f);
  for (std::size_t k = 0; k < shrink; ++k) {
    std::ranges::fill(least, 1.0f);
    for (std::size_t light = 0; light < converters_.size(); ++light) {
      if (!parts_.photographs[light].header.alpha) continue;
      const PixelRun run = runAt(pin, light, x, y * parts_.region.shrink + static_cast<int>(k));
      converters_[light].alpha(run.first, run.step, count, one.data());
      for (std::size_t i = 0; i < count; ++i) least[i] = std::min(least[i], one[i]);
    }
    for (std::size_t i = 0; i < count; ++i) sums[i / shrink] += least[i];
  }
  for (std::size_t i = 0; i < width; ++i) {
    coverage[i] = sums[i] / static_cast<float>(shrink * shrink);
  }
}

std::string PhotographStack::fingerprint() const {
  tbb::collaborative_call_once(described_, [this] { fingerprint_ = describe(); });
  return fingerprint_;
}

std::string PhotographStack::describe() const {
  const std::size_t count = parts_.photographs.size();
  std::vector<std::uint32_t> checksums(count);
  const ProgressStage stage(progress_, fmt::format("checksums of {} photographs", count), count);
  forEachInLanes(count, availableThreads(), [&](std::size_t i) {
    checksums[i] = checksumOf(*parts_.pool, parts_.photographs[i].file);
    progress_.advance();
  });
  const Rectangle& crop = parts_.region.crop;
  std::string text = fmt::format("photographs 1\ncrop {} {} {} {} shrink {} transfer {}\n", crop.x,
                                 crop.y, crop.width, crop.height, parts_.region.shrink,
                                 transfer_ == Transfer::Linear ? "linear" : "display");
  for (std::size_t i = 0; i < count; ++i) {
    const LightFileEntry& entry = parts_.lights[i];
    const Vector3 d = entry.light.toLight.vector();
    const LinearRgb& I = entry.light.intensity;
    const std::size_t file = parts_.photographs[i].file;
    text +=
        fmt::format("{} {} {:08x} {} {} {} {} {} {}\n", parts_.pool->path(file).filename().string(),
                    parts_.pool->bytes(file), checksums[i], d.x, d.y, d.z, I.r, I.g, I.b);
  }
  if (parts_.maskFile)
    text += fmt::format("mask {:08x}\n", checksumOf(*parts_.pool, *parts_.maskFile));
  return text;
}

}  // namespace

std::unique_ptr<Capture> makePhotographStack(StackParts parts, Progress& progress) {
  return std::make_unique<PhotographStack>(std::move(parts), progress);
}

}  // namespace illum
