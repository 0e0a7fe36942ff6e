#include <fmt/format.h>

#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include "codec/tile_decoders.h"
#include "illum/error.h"

namespace illum {
namespace {

/// libjpeg reports errors by a call that must not return; see PngReader for how the jump is kept
/// harmless. A damaged stream that libjpeg would only warn of counts as an error.
class JpegReader {
 public:
  explicit JpegReader(std::span<const std::byte> file) : file_(file) {
    decoder_.err = jpeg_std_error(&errors_);
    errors_.error_exit = onError;
    errors_.emit_message = onMessage;
    decoder_.client_data = this;
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&decoder_); }

  bool readHeader() {
    if (setjmp(mark_) != 0) return false;
    jpeg_create_decompress(&decoder_);
    jpeg_mem_src(&decoder_, reinterpret_cast<const unsigned char*>(file_.data()),
                 static_cast<unsigned long>(file_.size()));
    jpeg_read_header(&decoder_, TRUE);
    return true;
  }

  /// Baseline or extended Huffman, RGB by an Adobe marker, no subsampling.
  bool isPlainRgb() const {
    if (decoder_.num_components != 3 || decoder_.jpeg_color_space != JCS_RGB ||
        decoder_.saw_Adobe_marker == FALSE || decoder_.progressive_mode != FALSE ||
        decoder_.arith_code != FALSE || decoder_.data_precision != 8)
      return false;
    for (int c = 0; c < 3; ++c)
      if (decoder_.comp_info[c].h_samp_factor != 1 || decoder_.comp_info[c].v_samp_factor != 1)
        return false;
    return true;
  }

  bool readRows(std::uint8_t* samples) {
    if (setjmp(mark_) != 0) return false;
    decoder_.out_color_space = JCS_RGB;
    decoder_.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&decoder_);
    while (decoder_.output_scanline < decoder_.output_height) {
      JSAMPROW row = samples + std::size_t{3} * decoder_.output_width * decoder_.output_scanline;
      jpeg_read_scanlines(&decoder_, &row, 1);
    }
    jpeg_finish_decompress(&decoder_);
    return true;
  }

  std::uint64_t width() const { return decoder_.image_width; }
  std::uint64_t height() const { return decoder_.image_height; }
  const char* message() const { return message_; }

 private:
  static void onError(j_common_ptr common) {
    auto* self = static_cast<JpegReader*>(common->client_data);
    common->err->format_message(common, self->message_);
    std::longjmp(self->mark_, 1);
  }
  static void onMessage(j_common_ptr common, int level) {
    if (level < 0) onError(common);
  }

  std::span<const std::byte> file_;
  jpeg_decompress_struct decoder_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf mark_{};
  char message_[JMSG_LENGTH_MAX] = {};
};

}  // namespace

std::vector<std::uint8_t> decodeJpegSamples(std::span<const std::byte> file, Size size,
                                            const std::string& source) {
  JpegReader reader(file);
  if (!reader.readHeader())
    throw Error(Fault::Input, fmt::format("{}: expected a JPEG of {}x{}, found a damaged one ({})",
                                          source, size.width, size.height, reader.message()));
  if (reader.width() != static_cast<std::uint64_t>(size.width) ||
      reader.height() != static_cast<std::uint64_t>(size.height) || !reader.isPlainRgb())
    throw Error(Fault::Input,
                fmt::format("{}: expected a JPEG of {}x{} that stores RGB at full resolution, "
                            "found {}x{} or another kind",
                            source, size.width, size.height, reader.width(), reader.height()));
  std::vector<std::uint8_t> samples(3 * size.pixels());
  if (!reader.readRows(samples.data()))
    throw Error(Fault::Input,
                fmt::format("{}: the JPEG is damaged ({})", source, reader.message()));
  return samples;
}

}  // namespace illum
