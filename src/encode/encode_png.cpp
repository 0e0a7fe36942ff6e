#include <png.h>

#include <csetjmp>
#include <cstring>

#include "encode/tile_encoders.h"
#include "illum/error.h"

namespace illum {
namespace {

/// As in the decoder, the functions that set libpng's mark hold no objects.
class PngWriter {
 public:
  PngWriter() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw Error(Fault::Machine, "out of memory for a PNG encoder");
    }
  }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }

  bool write(const std::uint8_t* samples, Size size, int channels) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, this, onWrite, nullptr);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(size.width),
                 static_cast<png_uint_32>(size.height), 8,
                 channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png_, 6);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
    png_write_info(png_, info_);
    const std::size_t rowBytes =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels);
    for (int y = 0; y < size.height; ++y)
      png_write_row(png_, samples + static_cast<std::size_t>(y) * rowBytes);
    png_write_end(png_, nullptr);
    return true;
  }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  static void onWrite(png_structp png, png_bytep data, std::size_t count) {
    auto* self = static_cast<PngWriter*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    self->bytes_.insert(self->bytes_.end(), first, first + count);
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> encodePngSamples(std::span<const std::uint8_t> samples, Size size,
                                        int channels) {
  PngWriter writer;
  if (!writer.write(samples.data(), size, channels))
    throw Error(Fault::Machine, "out of memory while encoding a PNG");
  return std::move(writer.bytes());
}

}  // namespace illum
