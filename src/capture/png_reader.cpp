#include "capture/png_reader.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

#include "capture/exif_orientation.h"
#include "core/page_buffer.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kSignatureBytes = 8, kChunkHeadBytes = 8, kChunkFrameBytes = 12;
constexpr png_uint_32 kLongestSide = 1 << 20;
// Profiles and Exif blocks of cameras stay far below.
constexpr png_alloc_size_t kLargestChunkBytes = png_alloc_size_t{16} << 20;
constexpr int kMostChunks = 1000;
// zlib's window and state, libpng's own structures and its buffer.
constexpr std::uint64_t kDecoderBytes = 96 * 1024;

std::uint32_t bigEndian(const std::byte* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

// Follows the chain of chunks (ISO/IEC 15948) to its end, so that a file that was cut off is
// noticed before anything is decoded.
void checkChunks(FilePool& pool, std::size_t file) {
  std::array<std::byte, kChunkHeadBytes> chunk{};
  std::uint64_t at = kSignatureBytes;
  while (pool.read(file, at, chunk) == chunk.size()) {
    at += kChunkFrameBytes + bigEndian(chunk.data());
    if (at > pool.bytes(file)) break;
    if (std::memcmp(chunk.data() + 4, "IEND", 4) == 0) return;
  }
  throw inputError(pool.path(file), "an undamaged PNG picture", "its end too early");
}

// A libpng decoder that reads from the pool. libpng reports faults by our longjmp: guarded() is the
// only way in, and nothing with a destructor lives between it and the library.
class PngDecoder {
 public:
  PngDecoder(FilePool& pool, std::size_t file) : pool_(pool), file_(file) {
    guarded([this] {
      png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
      if (png_ == nullptr) throw std::bad_alloc();
      info_ = png_create_info_struct(png_);
      if (info_ == nullptr) throw std::bad_alloc();
      png_set_read_fn(png_, this, onRead);
      png_set_user_limits(png_, kLongestSide, kLongestSide);
      png_set_chunk_malloc_max(png_, kLargestChunkBytes);
      png_set_chunk_cache_max(png_, kMostChunks);
      png_read_info(png_, info_);
    });
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

  template <typename Calls>
  void guarded(Calls calls) {
    if (setjmp(jump_) != 0) throwFault();
    calls();
  }

 private:
  static void onError(png_structp png, png_const_charp message) {
    auto& self = *static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::strncpy(self.message_.data(), message, self.message_.size() - 1);
    std::longjmp(self.jump_, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void onRead(png_structp png, png_bytep data, png_size_t length) {
    auto& self = *static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (!self.take({reinterpret_cast<std::byte*>(data), length})) {
      png_error(png, "its end too early");
    }
  }

  bool take(std::span<std::byte> bytes) {
    try {
      const std::size_t got = pool_.read(file_, offset_, bytes);
      offset_ += got;
      return got == bytes.size();
    } catch (...) {
      readFault_ = std::current_exception();
      return false;
    }
  }

  [[noreturn]] void throwFault() {
    png_destroy_read_struct(&png_, &info_, nullptr);
    if (readFault_) std::rethrow_exception(std::exchange(readFault_, nullptr));
    throw inputError(pool_.path(file_), "an undamaged PNG picture",
                     "a fault: " + std::string(message_.data()));
  }

  FilePool& pool_;
  std::size_t file_;
  std::uint64_t offset_ = 0;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::exception_ptr readFault_;
  std::jmp_buf jump_;
  std::array<char, 160> message_{};
};

// ISO/IEC 15948, 4.2: iCCP goes before sRGB, sRGB before gAMA. 1/2.2, as most programs write it,
// means sRGB.
void readTransfer(PngDecoder& decoder, PhotographHeader& header) {
  png_charp name = nullptr;
  png_bytep profile = nullptr;
  png_uint_32 length = 0;
  int method = 0, intent = 0;
  double fileGamma = 0;
  bool hasSrgb = false, hasGamma = false;
  decoder.guarded([&] {
    png_get_iCCP(decoder.png(), decoder.info(), &name, &method, &profile, &length);
    hasSrgb = png_get_sRGB(decoder.png(), decoder.info(), &intent) != 0;
    hasGamma = png_get_gAMA(decoder.png(), decoder.info(), &fileGamma) != 0;
  });
  if (profile != nullptr && length > 0) {
    const auto bytes = std::as_bytes(std::span(profile, length));
    header.profile.assign(bytes.begin(), bytes.end());
    return;
  }
  if (hasSrgb || !hasGamma || !(fileGamma > 0.05 && fileGamma < 20)) return;
  const double gamma = 1 / fileGamma;
  if (std::abs(gamma - 1) < 0.01) {
    header.transfer = Transfer::Linear;
  } else if (std::abs(gamma - 2.2) > 0.05) {
    header.gamma = gamma;
  }
}

Orientation orientationOf(PngDecoder& decoder) {
  png_bytep exif = nullptr;
  png_uint_32 length = 0;
  decoder.guarded([&] { png_get_eXIf_1(decoder.png(), decoder.info(), &length, &exif); });
  if (exif == nullptr) return {};
  return orientationFromExif(std::as_bytes(std::span(exif, length)));
}

// Everything becomes 8 or 16 bits a channel, grey or RGB, alpha or none.
void setTransforms(png_structp png, png_infop info) {
  png_set_expand(png);
  if (png_get_bit_depth(png, info) == 16 && std::endian::native == std::endian::little) {
    png_set_swap(png);
  }
}

class PngReader final : public PhotographReader {
 public:
  PngReader(FilePool& pool, std::size_t file, const PhotographHeader& header)
      : decoder_(pool, file), rowBytes_(header.rowBytes()), height_(header.stored.height) {
    const bool interlaced = !header.sequential;
    bool same = false;
    decoder_.guarded([&] {
      png_structp png = decoder_.png();
      setTransforms(png, decoder_.info());
      png_set_interlace_handling(png);
      png_read_update_info(png, decoder_.info());
      same = png_get_rowbytes(png, decoder_.info()) == rowBytes_ &&
             png_get_image_height(png, decoder_.info()) == static_cast<png_uint_32>(height_);
    });
    if (!same) {
      throw inputError(pool.path(file), "the photograph that was there at the beginning",
                       "another");
    }
    if (interlaced) readWhole();
  }

  void read(int rows, std::byte* samples) override {
    if (whole_.data() != nullptr) {
      std::memcpy(samples, whole_.data() + rowBytes_ * static_cast<std::size_t>(row_),
                  rowBytes_ * static_cast<std::size_t>(rows));
    } else {
      decoder_.guarded([&] {
        for (int i = 0; i < rows; ++i) {
          auto* row = reinterpret_cast<png_bytep>(samples) + rowBytes_ * static_cast<unsigned>(i);
          png_read_row(decoder_.png(), row, nullptr);
        }
        if (row_ + rows == height_) png_read_end(decoder_.png(), nullptr);
      });
    }
    row_ += rows;
  }

 private:
  // Adam7: seven passes over all rows, each of which fills in a part of the pixels.
  void readWhole() {
    whole_ = PageBuffer(rowBytes_ * static_cast<std::size_t>(height_));
    decoder_.guarded([&] {
      for (int pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES; ++pass) {
        for (int y = 0; y < height_; ++y) {
          auto* row =
              reinterpret_cast<png_bytep>(whole_.data()) + rowBytes_ * static_cast<std::size_t>(y);
          png_read_row(decoder_.png(), row, nullptr);
        }
      }
      png_read_end(decoder_.png(), nullptr);
    });
  }

  PngDecoder decoder_;
  std::size_t rowBytes_;
  int height_, row_ = 0;
  PageBuffer whole_;
};

}  // namespace

PhotographHeader readPngHeader(FilePool& pool, std::size_t file) {
  checkChunks(pool, file);
  PngDecoder decoder(pool, file);
  PhotographHeader header;
  header.format = PhotographFormat::Png;
  int channels = 0, depth = 0;
  decoder.guarded([&] {
    png_structp png = decoder.png();
    png_infop info = decoder.info();
    header.stored = {static_cast<int>(png_get_image_width(png, info)),
                     static_cast<int>(png_get_image_height(png, info))};
    header.sequential = png_get_interlace_type(png, info) == PNG_INTERLACE_NONE;
  });
  header.orientation = orientationOf(decoder);
  readTransfer(decoder, header);
  decoder.guarded([&] {
    setTransforms(decoder.png(), decoder.info());
    png_read_update_info(decoder.png(), decoder.info());
    channels = png_get_channels(decoder.png(), decoder.info());
    depth = png_get_bit_depth(decoder.png(), decoder.info());
  });
  header.alpha = channels % 2 == 0;
  header.colours = channels >= 3 ? 3 : 1;
  header.type = depth == 16 ? SampleType::Word : SampleType::Byte;
  header.decoderBytes = kDecoderBytes + 4 * header.rowBytes() + header.profile.size();
  if (!header.sequential) {
    header.decoderBytes += header.rowBytes() * static_cast<std::uint64_t>(header.stored.height);
  }
  return header;
}

std::unique_ptr<PhotographReader> openPngReader(FilePool& pool, std::size_t file,
                                                const PhotographHeader& header) {
  return std::make_unique<PngReader>(pool, file, header);
}

}  // namespace illum
