#include <png.h>

#include <array>
#include <bit>
#include <cstring>

#include "illum/error.h"
#include "illum/picture_io.h"
#include "image/formats.h"

namespace illum {
namespace {

/// Deflate's densest code: a match of 258 bytes in 2 bits.
constexpr double kDeflateBytesPerByte = 1032;

struct PngMessage {
  std::array<char, 128> text{};
};

[[noreturn]] void jumpOnError(png_structp png, png_const_charp message) {
  auto* kept = static_cast<PngMessage*>(png_get_error_ptr(png));
  std::strncpy(kept->text.data(), message, kept->text.size() - 1);
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// Runs calls of libpng and tells whether they came through. libpng leaves errors by longjmp, so
/// `step` must hold no object that has a destructor.
template <typename Step>
bool cameThrough(png_structp png, Step step) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  step();
  return true;
}

class PngReader {
 public:
  PngReader(std::span<const std::byte> bytes, const std::filesystem::path& source)
      : fileBytes_(bytes.size()), rest_(bytes), source_(source) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, jumpOnError, ignoreWarning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &rest_, &PngReader::takeBytes);
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  StoredPicture read() {
    readHeader();
    const Size size{static_cast<int>(png_get_image_width(png_, info_)),
                    static_cast<int>(png_get_image_height(png_, info_))};
    const int channels = png_get_channels(png_, info_);
    StoredPicture picture;
    picture.linear = isLinear();
    if (png_get_bit_depth(png_, info_) == 16) {
      picture.words = PictureOf<std::uint16_t>(size, channels);
      readRows(picture.words);
    } else {
      picture.bytes = BytePicture(size, channels);
      readRows(picture.bytes);
    }
    return picture;
  }

 private:
  static void takeBytes(png_structp png, png_bytep data, std::size_t length) {
    auto* rest = static_cast<std::span<const std::byte>*>(png_get_io_ptr(png));
    if (rest->size() < length) png_error(png, "the file ends early");
    std::memcpy(data, rest->data(), length);
    *rest = rest->subspan(length);
  }

  template <typename Step>
  void guarded(Step step) {
    if (!cameThrough(png_, step)) throw inputError(source_, "a sound PNG", message_.text.data());
  }

  void readHeader() {
    guarded([this] {
      png_set_user_limits(png_, kMaxPictureSide, kMaxPictureSide);
      ignoreOtherChunks();
      png_read_info(png_, info_);
    });
    // A packed sample is an eighth of a byte at least; filter bytes are left out: the bound is
    // loose.
    checkPictureSize(source_, png_get_image_width(png_, info_), png_get_image_height(png_, info_),
                     png_get_channels(png_, info_), fileBytes_,
                     kDeflateBytesPerByte * 8 / png_get_bit_depth(png_, info_));
    guarded([this] {
      png_set_expand(png_);
      const bool alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                         png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
      if (alpha) png_set_gray_to_rgb(png_);
      if (std::endian::native == std::endian::little) png_set_swap(png_);
      passes_ = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
  }

  /// Texts, profiles and the like are passed over unread, so that none can unpack into much memory.
  void ignoreOtherChunks() {
    static constexpr png_byte kUnused[] =
        "bKGD\0cHRM\0eXIf\0hIST\0iCCP\0iTXt\0oFFs\0pCAL\0pHYs\0sBIT\0sCAL\0sPLT\0tEXt\0tIME\0zTXt";
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, kUnused, sizeof(kUnused) / 5);
  }

  /// gAMA holds 100000 times the exponent of the encoding; sRGB overrides it.
  bool isLinear() {
    png_fixed_point gamma = 0;
    return png_get_valid(png_, info_, PNG_INFO_sRGB) == 0 &&
           png_get_gAMA_fixed(png_, info_, &gamma) != 0 && gamma == PNG_FP_1;
  }

  template <typename T>
  void readRows(PictureOf<T>& picture) {
    T* const samples = picture.samples().data();
    const auto rowSamples =
        static_cast<std::size_t>(picture.width()) * static_cast<std::size_t>(picture.channels());
    const int height = picture.height();
    if (png_get_rowbytes(png_, info_) != rowSamples * sizeof(T))
      throw inputError(source_, "a PNG of a known kind", "another");
    guarded([&] {
      for (int pass = 0; pass < passes_; ++pass)
        for (int y = 0; y < height; ++y)
          png_read_row(
              png_, reinterpret_cast<png_bytep>(samples + static_cast<std::size_t>(y) * rowSamples),
              nullptr);
      png_read_end(png_, nullptr);
    });
  }

  std::uint64_t fileBytes_;
  std::span<const std::byte> rest_;
  const std::filesystem::path& source_;
  PngMessage message_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

class PngWriter {
 public:
  PngWriter() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, jumpOnError, ignoreWarning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, &bytes_, &PngWriter::keepBytes, nullptr);
  }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }

  std::vector<std::byte> write(const BytePicture& picture) {
    return write(picture,
                 [this] { png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL); });
  }

  std::vector<std::byte> write(const PictureOf<std::uint16_t>& picture, PngTransfer transfer) {
    return write(picture, [this, transfer] {
      if (transfer == PngTransfer::Linear) png_set_gAMA_fixed(png_, info_, PNG_FP_1);
    });
  }

 private:
  template <typename T, typename SetTransfer>
  std::vector<std::byte> write(const PictureOf<T>& picture, SetTransfer setTransfer) {
    const auto rowSamples =
        static_cast<std::size_t>(picture.width()) * static_cast<std::size_t>(picture.channels());
    const T* const samples = picture.samples().data();
    const int colour = colourType(picture.channels());
    const bool written = cameThrough(png_, [&] {
      png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.width()),
                   static_cast<png_uint_32>(picture.height()), 8 * sizeof(T), colour,
                   PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      setTransfer();
      png_set_compression_level(png_, kCompressionLevel);
      png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
      png_write_info(png_, info_);
      if (sizeof(T) == 2 && std::endian::native == std::endian::little) png_set_swap(png_);
      for (int y = 0; y < picture.height(); ++y)
        png_write_row(png_, reinterpret_cast<png_const_bytep>(
                                samples + static_cast<std::size_t>(y) * rowSamples));
      png_write_end(png_, nullptr);
    });
    if (!written)
      throw Error(Fault::Machine, std::string("cannot encode PNG: ") + message_.text.data());
    return std::move(bytes_);
  }

  /// On photographs 2.5 times as fast as zlib's default of 6, and within 8 % of its size either
  /// way; level 9 is 8 to 20 times as slow for 3 to 12 % less.
  static constexpr int kCompressionLevel = 3;

  static int colourType(int channels) {
    if (channels == 1) return PNG_COLOR_TYPE_GRAY;
    return channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
  }

  static void keepBytes(png_structp png, png_bytep data, std::size_t length) {
    if (!append(*static_cast<std::vector<std::byte>*>(png_get_io_ptr(png)), data, length))
      png_error(png, "out of memory");
  }

  /// Apart, because no exception may pass through libpng.
  static bool append(std::vector<std::byte>& bytes, const png_byte* data,
                     std::size_t length) noexcept {
    try {
      const auto* first = reinterpret_cast<const std::byte*>(data);
      bytes.insert(bytes.end(), first, first + length);
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  PngMessage message_;
  std::vector<std::byte> bytes_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

StoredPicture decodePng(std::span<const std::byte> bytes, const std::filesystem::path& source) {
  return PngReader(bytes, source).read();
}

std::vector<std::byte> encodePng(const BytePicture& picture) {
  return PngWriter().write(picture);
}

std::vector<std::byte> encodePng(const PictureOf<std::uint16_t>& picture, PngTransfer transfer) {
  return PngWriter().write(picture, transfer);
}

}  // namespace illum
