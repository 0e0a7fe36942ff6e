#include "capture/oiio_reader.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <vector>

#include "capture/oiio_picture.h"
#include "illum/error.h"

namespace illum {
namespace {

class OiioReader final : public PhotographReader {
 public:
  OiioReader(FilePool& pool, std::size_t file, const PhotographHeader& header)
      : header_(header), path_(pool.path(file)), picture_(pool, file, header.format) {
    const OIIO::ImageSpec& spec = picture_.spec();
    choice_ = chooseChannels(spec, header.format, path_);
    if (spec.width != header.stored.width || spec.height != header.stored.height ||
        sampleTypeOf(spec) != header.type || choice_.colours != header.colours ||
        choice_.alpha != header.alpha) {
      throw inputError(path_, "the photograph that was there at the beginning", "another");
    }
    const auto [low, high] = std::ranges::minmax(choice_.channels);
    firstChannel_ = low;
    channelsRead_ = high + 1 - low;
    const bool premultiplies =
        header.format == PhotographFormat::OpenExr || header.format == PhotographFormat::Tiff;
    premultiplied_ =
        header.alpha && premultiplies && spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
    rowsPerChunk_ = std::max(rowsTogether(spec, header.format), 1);
    if (rowsPerChunk_ == 1) rowsPerChunk_ = kOiioRowsPerCall;
  }

  void read(int rows, std::byte* samples) override {
    const std::size_t rowBytes = header_.rowBytes();
    for (int done = 0; done < rows;) {
      if (row_ == chunkEnd_) readChunk();
      const int count = std::min(rows - done, chunkEnd_ - row_);
      for (int i = 0; i < count; ++i) {
        takeRow(row_ + i, samples + static_cast<std::size_t>(done + i) * rowBytes);
      }
      row_ += count;
      done += count;
    }
  }

 private:
  std::size_t chunkRowBytes() const {
    return static_cast<std::size_t>(header_.stored.width) *
           static_cast<std::size_t>(channelsRead_) * bytesOf(header_.type);
  }

  void readChunk() {
    chunkBegin_ = chunkEnd_;
    chunkEnd_ = std::min(chunkBegin_ + rowsPerChunk_, header_.stored.height);
    chunk_.resize(chunkRowBytes() * static_cast<std::size_t>(chunkEnd_ - chunkBegin_));
    const OIIO::ImageSpec& spec = picture_.spec();
    if (spec.tile_width > 0) {
      readTiles();
    } else if (spec.channelformats.empty()) {
      readNative();
    } else {
      picture_.check(picture_.input().read_scanlines(
          0, 0, spec.y + chunkBegin_, spec.y + chunkEnd_, spec.z, firstChannel_,
          firstChannel_ + channelsRead_, typeDescOf(header_.type), chunk_.data()));
    }
  }

  void readTiles() {
    const OIIO::ImageSpec& spec = picture_.spec();
    picture_.check(picture_.input().read_tiles(
        0, 0, spec.x, spec.x + spec.width, spec.y + chunkBegin_, spec.y + chunkEnd_, spec.z,
        spec.z + 1, firstChannel_, firstChannel_ + channelsRead_, typeDescOf(header_.type),
        chunk_.data()));
  }

  // read_scanlines allocates 64 MiB to convert types in; with the native call we do that ourselves.
  void readNative() {
    const OIIO::ImageSpec& spec = picture_.spec();
    const OIIO::TypeDesc type = typeDescOf(header_.type);
    const std::size_t samples = chunk_.size() / type.size();
    const bool sameType = spec.format == type;
    if (!sameType) native_.resize(samples * spec.format.size());
    std::byte* into = sameType ? chunk_.data() : native_.data();
    picture_.check(picture_.input().read_native_scanlines(0, 0, spec.y + chunkBegin_,
                                                          spec.y + chunkEnd_, spec.z, firstChannel_,
                                                          firstChannel_ + channelsRead_, into));
    if (sameType) return;
    picture_.check(OIIO::convert_pixel_values(spec.format, native_.data(), type, chunk_.data(),
                                              static_cast<int>(samples)));
  }

  void takeRow(int row, std::byte* samples) const {
    const std::byte* stored =
        chunk_.data() + static_cast<std::size_t>(row - chunkBegin_) * chunkRowBytes();
    switch (header_.type) {
      case SampleType::Byte:
        return takeSamples<std::uint8_t>(stored, samples);
      case SampleType::Word:
        return takeSamples<std::uint16_t>(stored, samples);
      case SampleType::Float:
        return takeSamples<float>(stored, samples);
    }
  }

  template <typename T>
  void takeSamples(const std::byte* storedBytes, std::byte* sampleBytes) const {
    const int channels = header_.channels();
    if (channels == channelsRead_ && std::ranges::is_sorted(choice_.channels)) {
      std::memcpy(sampleBytes, storedBytes, header_.rowBytes());
    } else {
      for (int x = 0; x < header_.stored.width; ++x) {
        for (int c = 0; c < channels; ++c) {
          const int from =
              x * channelsRead_ + choice_.channels[static_cast<std::size_t>(c)] - firstChannel_;
          std::memcpy(sampleBytes + static_cast<std::size_t>(x * channels + c) * sizeof(T),
                      storedBytes + static_cast<std::size_t>(from) * sizeof(T), sizeof(T));
        }
      }
    }
    if (premultiplied_) divideByAlpha<T>(sampleBytes);
  }

  template <typename T>
  void divideByAlpha(std::byte* sampleBytes) const {
    T* samples = reinterpret_cast<T*>(sampleBytes);
    const int channels = header_.channels();
    constexpr float kWhite = std::is_integral_v<T> ? static_cast<float>(static_cast<T>(~0u)) : 1.0f;
    for (int x = 0; x < header_.stored.width; ++x, samples += channels) {
      const auto alpha = static_cast<float>(samples[channels - 1]);
      if (!(alpha > 0)) continue;
      for (int c = 0; c + 1 < channels; ++c) {
        const float straight = static_cast<float>(samples[c]) * (kWhite / alpha);
        if constexpr (std::is_integral_v<T>) {
          samples[c] = static_cast<T>(std::min(straight, kWhite) + 0.5f);
        } else {
          samples[c] = straight;
        }
      }
    }
  }

  PhotographHeader header_;
  std::filesystem::path path_;
  OiioPicture picture_;
  OiioChannels choice_;
  int firstChannel_ = 0, channelsRead_ = 0, rowsPerChunk_ = 1;
  bool premultiplied_ = false;
  std::vector<std::byte> chunk_, native_;
  int row_ = 0, chunkBegin_ = 0, chunkEnd_ = 0;
};

}  // namespace

std::unique_ptr<PhotographReader> openOiioReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header) {
  return std::make_unique<OiioReader>(pool, file, header);
}

}  // namespace illum
