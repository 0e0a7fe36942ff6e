#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <jpeglib.h>

#include "encode/tile_encoders.h"
#include "illum/error.h"

namespace illum {
namespace {

/// As in the decoder, the function that sets the mark holds no objects.
class JpegWriter {
 public:
  JpegWriter() {
    encoder_.err = jpeg_std_error(&errors_);
    errors_.error_exit = onError;
    encoder_.client_data = this;
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;
  ~JpegWriter() {
    jpeg_destroy_compress(&encoder_);
    std::free(buffer_);
  }

  bool write(const std::uint8_t* samples, Size size, int step) {
    if (setjmp(mark_) != 0) return false;
    jpeg_create_compress(&encoder_);
    jpeg_mem_dest(&encoder_, &buffer_, &length_);
    encoder_.image_width = static_cast<JDIMENSION>(size.width);
    encoder_.image_height = static_cast<JDIMENSION>(size.height);
    encoder_.input_components = 3;
    encoder_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&encoder_);
    // Also writes the Adobe marker with transform 0, by which every decoder knows RGB.
    jpeg_set_colorspace(&encoder_, JCS_RGB);
    setFlatTable(step);
    encoder_.dct_method = JDCT_ISLOW;
    encoder_.optimize_coding = TRUE;
    jpeg_start_compress(&encoder_, TRUE);
    while (encoder_.next_scanline < encoder_.image_height) {
      // libjpeg's interface lacks a const that its promise has.
      auto* row = const_cast<JSAMPROW>(samples + std::size_t{3} * encoder_.image_width *
                                                     encoder_.next_scanline);
      jpeg_write_scanlines(&encoder_, &row, 1);
    }
    jpeg_finish_compress(&encoder_);
    return true;
  }

  std::vector<std::byte> bytes() const {
    const auto* first = reinterpret_cast<const std::byte*>(buffer_);
    return {first, first + length_};
  }

 private:
  static void onError(j_common_ptr common) {
    std::longjmp(static_cast<JpegWriter*>(common->client_data)->mark_, 1);
  }
  void setFlatTable(int step) {
    unsigned table[DCTSIZE2];
    for (unsigned& entry : table) entry = static_cast<unsigned>(step);
    jpeg_add_quant_table(&encoder_, 0, table, 100, TRUE);
    for (int c = 0; c < 3; ++c) encoder_.comp_info[c].quant_tbl_no = 0;
  }

  jpeg_compress_struct encoder_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf mark_{};
  unsigned char* buffer_ = nullptr;
  unsigned long length_ = 0;
};

}  // namespace

std::vector<std::byte> encodeJpegSamples(std::span<const std::uint8_t> samples, Size size,
                                         int step) {
  JpegWriter writer;
  if (!writer.write(samples.data(), size, step))
    throw Error(Fault::Machine, "out of memory while encoding a JPEG");
  return writer.bytes();
}

}  // namespace illum
