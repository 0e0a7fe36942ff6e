#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "codec/tile_decoders.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr png_alloc_size_t kMaxChunkBytes = 1 << 20;  // of anything but pixels

/// libpng reports errors by longjmp. So that no destructor is jumped over, the functions that set
/// the mark hold no objects, and everything that must be freed belongs to this class.
class PngReader {
 public:
  explicit PngReader(std::span<const std::byte> file) : rest_(file) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw Error(Fault::Machine, "out of memory for a PNG decoder");
    }
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool readHeader(Size limit) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, onRead);
    png_set_user_limits(png_, static_cast<png_uint_32>(limit.width),
                        static_cast<png_uint_32>(limit.height));
    png_set_chunk_malloc_max(png_, kMaxChunkBytes);
    png_read_info(png_, info_);
    return true;
  }

  bool readRows(png_bytep samples, std::size_t rowBytes, int height) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    for (int y = 0; y < height; ++y)
      png_read_row(png_, samples + static_cast<std::size_t>(y) * rowBytes, nullptr);
    png_read_end(png_, nullptr);
    return true;
  }

  Size size() const {
    return {static_cast<int>(png_get_image_width(png_, info_)),
            static_cast<int>(png_get_image_height(png_, info_))};
  }
  int channels() const { return png_get_channels(png_, info_); }
  bool isPlain() const {
    const int type = png_get_color_type(png_, info_);
    return (type == PNG_COLOR_TYPE_GRAY || type == PNG_COLOR_TYPE_RGB) &&
           png_get_bit_depth(png_, info_) == 8 &&
           png_get_interlace_type(png_, info_) == PNG_INTERLACE_NONE &&
           png_get_valid(png_, info_, PNG_INFO_tRNS) == 0;
  }
  const char* message() const { return message_; }

 private:
  static void onError(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(self->message_, message, sizeof self->message_ - 1);
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void onRead(png_structp png, png_bytep out, std::size_t count) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self->rest_.size()) png_error(png, "the file ends too early");
    std::memcpy(out, self->rest_.data(), count);
    self->rest_ = self->rest_.subspan(count);
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::span<const std::byte> rest_;
  char message_[128] = {};
};

}  // namespace

std::vector<std::uint8_t> decodePngSamples(std::span<const std::byte> file, Size size, int channels,
                                           const std::string& source) {
  PngReader reader(file);
  if (!reader.readHeader(size))
    throw Error(Fault::Input, fmt::format("{}: expected a PNG of {}x{}, found a damaged one ({})",
                                          source, size.width, size.height, reader.message()));
  if (reader.size() != size || !reader.isPlain() || reader.channels() != channels)
    throw Error(Fault::Input,
                fmt::format("{}: expected a PNG of {}x{} with {} plain 8-bit channels, found {}x{} "
                            "with {} channels or another kind",
                            source, size.width, size.height, channels, reader.size().width,
                            reader.size().height, reader.channels()));
  const std::size_t rowBytes =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels);
  std::vector<std::uint8_t> samples(rowBytes * static_cast<std::size_t>(size.height));
  if (!reader.readRows(samples.data(), rowBytes, size.height))
    throw Error(Fault::Input, fmt::format("{}: the PNG is damaged ({})", source, reader.message()));
  return samples;
}

}  // namespace illum
