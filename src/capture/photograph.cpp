#include "capture/photograph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "capture/sample_kernels.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr int kRowsPerCall = 16;

// Source rows, before the profile's conversion, go through a buffer of these many rows.
class ConvertingReader final : public PhotographReader {
 public:
  ConvertingReader(FilePool& pool, const Photograph& photograph)
      : photograph_(photograph), inner_(openReader(pool, photograph.file, photograph.header)) {
    rows_.resize(photograph.header.rowBytes() * kRowsPerCall);
  }

  void read(int rows, std::byte* samples) override {
    for (int done = 0; done < rows;) {
      const int count = std::min(rows - done, kRowsPerCall);
      inner_->read(count, rows_.data());
      for (int i = 0; i < count; ++i) {
        photograph_.colour.conversion->apply(
            rows_.data() + static_cast<std::size_t>(i) * photograph_.header.rowBytes(),
            samples + static_cast<std::size_t>(done + i) * photograph_.rowBytes(),
            photograph_.header.stored.width);
      }
      done += count;
    }
  }

 private:
  const Photograph& photograph_;
  std::unique_ptr<PhotographReader> inner_;
  std::vector<std::byte> rows_;
};

// Refuses infinities and NaNs, which no later step could do anything with.
class FiniteReader final : public PhotographReader {
 public:
  FiniteReader(std::unique_ptr<PhotographReader> inner, std::filesystem::path path,
               const Photograph& photograph)
      : inner_(std::move(inner)), path_(std::move(path)), photograph_(photograph) {}

  void read(int rows, std::byte* samples) override {
    inner_->read(rows, samples);
    const auto* values = reinterpret_cast<const float*>(samples);
    const std::size_t count =
        photograph_.rowBytes() / sizeof(float) * static_cast<std::size_t>(rows);
    if (!allFinite(values, count)) throw faultIn({values, count});
    row_ += rows;
  }

 private:
  Error faultIn(std::span<const float> values) const {
    const auto bad = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
    const auto pixel = (bad - values.begin()) / photograph_.header.channels();
    const Size stored = photograph_.header.stored;
    const auto at = photograph_.header.orientation.uprightFromStored(
        stored,
        {static_cast<int>(pixel % stored.width), row_ + static_cast<int>(pixel / stored.width)});
    return inputError(path_, "finite samples",
                      fmt::format("{} at pixel ({}, {})", *bad, at.x, at.y));
  }

  std::unique_ptr<PhotographReader> inner_;
  std::filesystem::path path_;
  const Photograph& photograph_;
  int row_ = 0;
};

}  // namespace

std::uint64_t Photograph::decoderBytes() const {
  return header.decoderBytes + (colour.conversion ? header.rowBytes() * kRowsPerCall : 0);
}

std::unique_ptr<PhotographReader> openPhotograph(FilePool& pool, const Photograph& photograph) {
  std::unique_ptr<PhotographReader> reader =
      photograph.colour.conversion ? std::make_unique<ConvertingReader>(pool, photograph)
                                   : openReader(pool, photograph.file, photograph.header);
  if (photograph.colour.type != SampleType::Float) return reader;
  return std::make_unique<FiniteReader>(std::move(reader), pool.path(photograph.file), photograph);
}

}  // namespace illum
