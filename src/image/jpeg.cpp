// jpeglib.h needs both.
#include <cstddef>
#include <cstdio>

#include <jerror.h>
#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <cstdlib>
#include <string>

#include "illum/error.h"
#include "illum/picture_io.h"
#include "image/formats.h"

namespace illum {
namespace {

/// Every block of 64 samples takes at least one bit, the shortest Huffman code of its first
/// coefficient.
constexpr double kSamplesPerByte = 8 * 64;
/// More than any encoder writes; a few bytes a scan could otherwise keep a reader busy for hours.
constexpr int kMaxScans = 500;

struct JumpingErrors {
  jpeg_error_mgr base{};
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> text{};
};

[[noreturn]] void jumpOnError(j_common_ptr codec) {
  auto* errors = reinterpret_cast<JumpingErrors*>(codec->err);
  codec->err->format_message(codec, errors->text.data());
  std::longjmp(errors->jump, 1);
}

/// libjpeg fills what a damaged file lacks with grey and only warns. We refuse, except where the
/// pixels are whole.
void jumpOnWarning(j_common_ptr codec, int level) {
  if (level >= 0) return;  // a trace
  switch (codec->err->msg_code) {
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_ADOBE_XFORM:
    case JWRN_JFIF_MAJOR:
      return;
    default:
      jumpOnError(codec);
  }
}

void printNothing(j_common_ptr) {}

jpeg_error_mgr* jumpingErrors(JumpingErrors& errors) {
  jpeg_std_error(&errors.base);
  errors.base.error_exit = jumpOnError;
  errors.base.emit_message = jumpOnWarning;
  errors.base.output_message = printNothing;
  return &errors.base;
}

/// Runs calls of libjpeg and tells whether they came through. libjpeg leaves errors by longjmp, so
/// `step` must hold no object that has a destructor.
template <typename Step>
bool cameThrough(JumpingErrors& errors, Step step) {
  if (setjmp(errors.jump) != 0) return false;
  step();
  return true;
}

void limitScans(j_common_ptr codec) {
  if (!codec->is_decompressor) return;
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number > kMaxScans)
    ERREXIT(codec, JERR_BAD_PROGRESSION);
}

class JpegReader {
 public:
  JpegReader(std::span<const std::byte> bytes, const std::filesystem::path& source)
      : bytes_(bytes), source_(source) {
    codec_.err = jumpingErrors(errors_);
    guarded([this] { jpeg_create_decompress(&codec_); });
    monitor_.progress_monitor = limitScans;
    codec_.progress = &monitor_;
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&codec_); }

  StoredPicture read() {
    readHeader();
    const Size size{static_cast<int>(codec_.output_width), static_cast<int>(codec_.output_height)};
    StoredPicture picture{BytePicture(size, codec_.output_components), {}, false};
    readRows(picture.bytes.samples().data(), picture.bytes.row(0).size());
    return picture;
  }

 private:
  template <typename Step>
  void guarded(Step step) {
    if (!cameThrough(errors_, step)) throw inputError(source_, "a sound JPEG", errors_.text.data());
  }

  void readHeader() {
    guarded([this] {
      const auto* data = reinterpret_cast<const unsigned char*>(bytes_.data());
      jpeg_mem_src(&codec_, data, static_cast<unsigned long>(bytes_.size()));
      jpeg_read_header(&codec_, TRUE);
    });
    chooseColour();
    if (codec_.arith_code != 0)
      throw inputError(source_, "a JPEG with Huffman coding", "arithmetic coding");
    checkPictureSize(source_, codec_.image_width, codec_.image_height, 1, bytes_.size(),
                     kSamplesPerByte);
    guarded([this] {
      codec_.dct_method = JDCT_ISLOW;
      jpeg_calc_output_dimensions(&codec_);
    });
  }

  void chooseColour() {
    switch (codec_.jpeg_color_space) {
      case JCS_GRAYSCALE:
        codec_.out_color_space = JCS_GRAYSCALE;
        return;
      case JCS_RGB:
      case JCS_YCbCr:
        codec_.out_color_space = JCS_RGB;
        return;
      case JCS_CMYK:
      case JCS_YCCK:
        throw inputError(source_, "a grey or RGB JPEG", "CMYK");
      default:
        throw inputError(source_, "a grey or RGB JPEG",
                         std::to_string(codec_.num_components) + " channels of an unknown kind");
    }
  }

  void readRows(JSAMPLE* samples, std::size_t rowSamples) {
    guarded([&] {
      jpeg_start_decompress(&codec_);
      while (codec_.output_scanline < codec_.output_height) {
        JSAMPROW row = samples + codec_.output_scanline * rowSamples;
        jpeg_read_scanlines(&codec_, &row, 1);
      }
      jpeg_finish_decompress(&codec_);
    });
  }

  std::span<const std::byte> bytes_;
  const std::filesystem::path& source_;
  JumpingErrors errors_;
  jpeg_progress_mgr monitor_{};
  jpeg_decompress_struct codec_{};
};

class JpegWriter {
 public:
  JpegWriter() {
    codec_.err = jumpingErrors(errors_);
    guarded([this] { jpeg_create_compress(&codec_); });
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;
  ~JpegWriter() {
    jpeg_destroy_compress(&codec_);
    std::free(buffer_);
  }

  std::vector<std::byte> write(const BytePicture& picture, int quality) {
    const std::uint8_t* const samples = picture.samples().data();
    const auto rowSamples =
        static_cast<std::size_t>(picture.width()) * static_cast<std::size_t>(picture.channels());
    guarded([&] {
      jpeg_mem_dest(&codec_, &buffer_, &length_);
      describe(picture, quality);
      jpeg_start_compress(&codec_, TRUE);
      while (codec_.next_scanline < codec_.image_height) {
        auto* row = const_cast<JSAMPROW>(samples + codec_.next_scanline * rowSamples);
        jpeg_write_scanlines(&codec_, &row, 1);
      }
      jpeg_finish_compress(&codec_);
    });
    const auto* first = reinterpret_cast<const std::byte*>(buffer_);
    return {first, first + length_};
  }

 private:
  template <typename Step>
  void guarded(Step step) {
    if (!cameThrough(errors_, step))
      throw Error(Fault::Machine, std::string("cannot encode JPEG: ") + errors_.text.data());
  }

  void describe(const BytePicture& picture, int quality) {
    codec_.image_width = static_cast<JDIMENSION>(picture.width());
    codec_.image_height = static_cast<JDIMENSION>(picture.height());
    codec_.input_components = picture.channels();
    codec_.in_color_space = picture.channels() == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&codec_);
    jpeg_set_quality(&codec_, quality, TRUE);
    codec_.dct_method = JDCT_ISLOW;
    codec_.optimize_coding = TRUE;
    for (int c = 0; c < codec_.num_components; ++c) {
      codec_.comp_info[c].h_samp_factor = 1;
      codec_.comp_info[c].v_samp_factor = 1;
    }
  }

  JumpingErrors errors_;
  jpeg_compress_struct codec_{};
  unsigned char* buffer_ = nullptr;  ///< jpeg_mem_dest allocates it with malloc
  unsigned long length_ = 0;
};

}  // namespace

StoredPicture decodeJpeg(std::span<const std::byte> bytes, const std::filesystem::path& source) {
  return JpegReader(bytes, source).read();
}

std::vector<std::byte> encodeJpeg(const BytePicture& picture, int quality) {
  if (picture.channels() != 1 && picture.channels() != 3)
    throw Error(Fault::Usage, "expected a picture of 1 or 3 channels for JPEG, found " +
                                  std::to_string(picture.channels()));
  return JpegWriter().write(picture, quality);
}

}  // namespace illum
