#include "capture/jpeg_reader.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <utility>

// After <cstdio>, which it needs and does not include.
#include <jerror.h>
#include <jpeglib.h>

#include "capture/exif_orientation.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::size_t kBufferBytes = 16384;
// More scans than any encoder writes; each costs a walk over all coefficients.
constexpr int kMostScans = 500;
constexpr int kRowsPerCall = 16;

// A libjpeg decompressor that reads from the pool. libjpeg reports faults by longjmp: guarded() is
// the only way in, and nothing with a destructor lives between it and the library.
class Decompressor {
 public:
  Decompressor(FilePool& pool, std::size_t file);
  ~Decompressor() { jpeg_destroy_decompress(&codec_); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;

  jpeg_decompress_struct& codec() { return codec_; }

  template <typename Calls>
  void guarded(Calls calls) {
    if (setjmp(jump_) != 0) throwFault();
    calls();
  }

 private:
  static Decompressor& of(j_common_ptr codec) {
    return *static_cast<Decompressor*>(codec->client_data);
  }
  static Decompressor& of(j_decompress_ptr codec) {
    return *static_cast<Decompressor*>(codec->client_data);
  }
  static void onError(j_common_ptr codec) { std::longjmp(of(codec).jump_, 1); }
  static void onMessage(j_common_ptr codec, int level);
  static boolean onEmpty(j_decompress_ptr codec);
  static void onSkip(j_decompress_ptr codec, long bytes);
  static void onProgress(j_common_ptr codec);
  bool refill();
  [[noreturn]] void throwFault();

  FilePool& pool_;
  std::size_t file_;
  std::uint64_t offset_ = 0;  // in the file, of the byte after the buffer
  std::exception_ptr readFault_;
  jpeg_error_mgr errors_{};
  jpeg_source_mgr source_{};
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct codec_{};
  std::jmp_buf jump_;
  std::array<std::byte, kBufferBytes> buffer_;
};

Decompressor::Decompressor(FilePool& pool, std::size_t file) : pool_(pool), file_(file) {
  codec_.err = jpeg_std_error(&errors_);
  codec_.client_data = this;
  errors_.error_exit = onError;
  errors_.emit_message = onMessage;
  guarded([this] { jpeg_create_decompress(&codec_); });
  source_.init_source = [](j_decompress_ptr) {};
  source_.fill_input_buffer = onEmpty;
  source_.skip_input_data = onSkip;
  source_.resync_to_restart = jpeg_resync_to_restart;
  source_.term_source = [](j_decompress_ptr) {};
  codec_.src = &source_;
  progress_.progress_monitor = onProgress;
  codec_.progress = &progress_;
}

// libjpeg paints over what is damaged or missing and only warns. We do not.
void Decompressor::onMessage(j_common_ptr codec, int level) {
  if (level >= 0) return;
  switch (codec->err->msg_code) {
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_ADOBE_XFORM:
    case JWRN_JFIF_MAJOR:
      return;  // harmless and common
    default:
      codec->err->error_exit(codec);
  }
}

bool Decompressor::refill() {
  try {
    const std::size_t got = pool_.read(file_, offset_, buffer_);
    offset_ += got;
    source_.next_input_byte = reinterpret_cast<const JOCTET*>(buffer_.data());
    source_.bytes_in_buffer = got;
    return got > 0;
  } catch (...) {
    readFault_ = std::current_exception();
    return false;
  }
}

boolean Decompressor::onEmpty(j_decompress_ptr codec) {
  if (!of(codec).refill()) ERREXIT(codec, JERR_INPUT_EOF);
  return TRUE;
}

void Decompressor::onSkip(j_decompress_ptr codec, long bytes) {
  if (bytes <= 0) return;
  Decompressor& self = of(codec);
  const auto skipped = static_cast<std::size_t>(bytes);
  const std::size_t buffered = std::min(skipped, self.source_.bytes_in_buffer);
  self.source_.next_input_byte += buffered;
  self.source_.bytes_in_buffer -= buffered;
  self.offset_ += skipped - buffered;
}

void Decompressor::onProgress(j_common_ptr codec) {
  if (of(codec).codec_.input_scan_number > kMostScans) ERREXIT(codec, JERR_BAD_PROGRESSION);
}

void Decompressor::throwFault() {
  if (readFault_) std::rethrow_exception(std::exchange(readFault_, nullptr));
  std::array<char, JMSG_LENGTH_MAX> message{};
  const int code = errors_.msg_code;
  errors_.format_message(reinterpret_cast<j_common_ptr>(&codec_), message.data());
  const bool ended = code == JERR_INPUT_EOF || code == JWRN_JPEG_EOF;
  throw inputError(
      pool_.path(file_), "an undamaged JPEG picture",
      ended ? std::string("its end too early") : "a fault: " + std::string(message.data()));
}

std::span<const std::byte> bytesOfMarker(const jpeg_marker_struct& marker) {
  return std::as_bytes(std::span(marker.data, marker.data_length));
}

Orientation orientationOf(const jpeg_decompress_struct& codec) {
  constexpr char kExif[] = {'E', 'x', 'i', 'f', '\0', '\0'};
  for (const jpeg_marker_struct* m = codec.marker_list; m != nullptr; m = m->next) {
    const auto bytes = bytesOfMarker(*m);
    if (m->marker == JPEG_APP0 + 1 && bytes.size() > sizeof kExif &&
        std::memcmp(bytes.data(), kExif, sizeof kExif) == 0) {
      return orientationFromExif(bytes.subspan(sizeof kExif));
    }
  }
  return {};
}

std::vector<std::byte> profileOf(Decompressor& jpeg) {
  JOCTET* data = nullptr;
  unsigned length = 0;
  jpeg.guarded([&] { jpeg_read_icc_profile(&jpeg.codec(), &data, &length); });
  const std::unique_ptr<JOCTET, decltype(&std::free)> owner(data, std::free);
  const auto bytes = std::as_bytes(std::span(data, length));
  return {bytes.begin(), bytes.end()};
}

// What libjpeg-turbo allocates: rows on their way through upsampling (ten or twelve of each
// component for each row of blocks), and all coefficients where it has to read several scans before
// the first row.
std::uint64_t decoderBytesOf(const jpeg_decompress_struct& codec, bool wholeCoefficients) {
  std::uint64_t bytes = 96 * 1024 + sizeof(Decompressor);
  for (int i = 0; i < codec.num_components; ++i) {
    const jpeg_component_info& component = codec.comp_info[i];
    const auto across =
        static_cast<std::uint64_t>(component.width_in_blocks) + 2u * MAX_SAMP_FACTOR;
    const auto down = static_cast<std::uint64_t>(component.height_in_blocks) + 2u * MAX_SAMP_FACTOR;
    bytes += across * DCTSIZE * 12u * static_cast<unsigned>(component.v_samp_factor);
    if (wholeCoefficients) bytes += across * down * sizeof(JBLOCK);
  }
  const auto width = static_cast<std::uint64_t>(codec.image_width);
  return bytes + 3u * width * static_cast<unsigned>(codec.max_v_samp_factor + 1);
}

class JpegReader final : public PhotographReader {
 public:
  JpegReader(FilePool& pool, std::size_t file, const PhotographHeader& header)
      : jpeg_(pool, file), rowBytes_(header.rowBytes()), path_(pool.path(file)) {
    jpeg_.guarded([&] {
      jpeg_decompress_struct& codec = jpeg_.codec();
      jpeg_read_header(&codec, TRUE);
      codec.out_color_space = header.colours == 1 ? JCS_GRAYSCALE : JCS_RGB;
    });
    const jpeg_decompress_struct& codec = jpeg_.codec();
    if (static_cast<int>(codec.image_width) != header.stored.width ||
        static_cast<int>(codec.image_height) != header.stored.height) {
      throw inputError(path_, "the photograph that was there at the beginning", "another");
    }
  }

  void read(int rows, std::byte* samples) override {
    jpeg_.guarded([&] {
      jpeg_decompress_struct& codec = jpeg_.codec();
      if (!started_) jpeg_start_decompress(&codec);
      started_ = true;
      std::array<JSAMPROW, kRowsPerCall> pointers;
      for (int done = 0; done < rows;) {
        const int ask = std::min(rows - done, kRowsPerCall);
        for (int i = 0; i < ask; ++i) {
          pointers[static_cast<std::size_t>(i)] =
              reinterpret_cast<JSAMPROW>(samples + static_cast<std::size_t>(done + i) * rowBytes_);
        }
        done += static_cast<int>(
            jpeg_read_scanlines(&codec, pointers.data(), static_cast<JDIMENSION>(ask)));
      }
      // Reads on to the end marker, so that a file that was cut off is noticed.
      if (codec.output_scanline == codec.output_height) jpeg_finish_decompress(&codec);
    });
  }

 private:
  Decompressor jpeg_;
  std::size_t rowBytes_;
  std::filesystem::path path_;
  bool started_ = false;
};

}  // namespace

PhotographHeader readJpegHeader(FilePool& pool, std::size_t file) {
  Decompressor jpeg(pool, file);
  jpeg_decompress_struct& codec = jpeg.codec();
  bool severalScans = false;
  jpeg.guarded([&] {
    jpeg_save_markers(&codec, JPEG_APP0 + 1, 0xffff);
    jpeg_save_markers(&codec, JPEG_APP0 + 2, 0xffff);
    jpeg_read_header(&codec, TRUE);
    severalScans = jpeg_has_multiple_scans(&codec) != FALSE;
    jpeg_calc_output_dimensions(&codec);
  });
  if (codec.num_components != 1 && codec.num_components != 3) {
    throw inputError(pool.path(file), "a grey or RGB picture",
                     codec.num_components == 4
                         ? std::string("one for print (CMYK)")
                         : std::to_string(codec.num_components) + " channels");
  }
  PhotographHeader header;
  header.format = PhotographFormat::Jpeg;
  header.stored = {static_cast<int>(codec.image_width), static_cast<int>(codec.image_height)};
  header.orientation = orientationOf(codec);
  header.colours = codec.num_components;
  header.profile = profileOf(jpeg);
  header.sequential = !severalScans;
  header.decoderBytes = decoderBytesOf(codec, severalScans);
  return header;
}

std::unique_ptr<PhotographReader> openJpegReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header) {
  return std::make_unique<JpegReader>(pool, file, header);
}

}  // namespace illum
