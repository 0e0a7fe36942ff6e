#include "capture/webp_reader.h"

#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "capture/exif_orientation.h"
#include "core/page_buffer.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kRiffHeadBytes = 12, kChunkHeadBytes = 8;
// Profiles and Exif blocks of cameras stay far below.
constexpr std::uint64_t kLargestMetadataBytes = std::uint64_t{16} << 20;
// libwebp's own rows, and its picture of the lossless coding (4 bytes) or of the alpha (1 byte).
constexpr std::uint64_t kDecoderBytes = std::uint64_t{2} << 20, kDecoderBytesPerPixel = 5;

std::uint32_t littleEndian(const std::byte* bytes, int count) {
  std::uint32_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

Error damaged(const std::filesystem::path& path, std::string_view found) {
  return inputError(path, "an undamaged WebP picture", found);
}

// The chunks of a RIFF file ("WebP Container Specification"), one after another.
class Chunks {
 public:
  Chunks(FilePool& pool, std::size_t file) : pool_(pool), file_(file) {
    std::array<std::byte, kRiffHeadBytes> head{};
    if (pool.read(file, 0, head) < head.size()) throw tooShort();
    end_ = kChunkHeadBytes + littleEndian(head.data() + 4, 4);
    if (end_ > pool.bytes(file)) throw tooShort();
  }

  bool next() {
    at_ += kChunkHeadBytes + bytes_ + bytes_ % 2;
    if (!begun_) at_ = kRiffHeadBytes;
    begun_ = true;
    if (at_ + kChunkHeadBytes > end_) return false;
    std::array<std::byte, kChunkHeadBytes> head{};
    pool_.read(file_, at_, head);
    std::memcpy(name_.data(), head.data(), name_.size());
    bytes_ = littleEndian(head.data() + 4, 4);
    if (bytes_ > end_ - at_ - kChunkHeadBytes) throw tooShort();
    return true;
  }

  std::string_view name() const { return {name_.data(), name_.size()}; }

  /// At most `most` bytes of what is in the chunk.
  std::vector<std::byte> content(std::uint64_t most) const {
    std::vector<std::byte> content(std::min(most, bytes_));
    pool_.read(file_, at_ + kChunkHeadBytes, content);
    return content;
  }

 private:
  Error tooShort() const { return damaged(pool_.path(file_), "its end too early"); }

  FilePool& pool_;
  std::size_t file_;
  bool begun_ = false;
  std::uint64_t at_ = 0, bytes_ = 0, end_ = 0;
  std::array<char, 4> name_{};
};

// Exif blocks stand with or without the six bytes that JPEG files begin them with.
Orientation orientationOf(const std::vector<std::byte>& block) {
  constexpr std::array kExif{std::byte{'E'}, std::byte{'x'}, std::byte{'i'},
                             std::byte{'f'}, std::byte{0},   std::byte{0}};
  std::span<const std::byte> tiff = block;
  if (tiff.size() > kExif.size() && std::ranges::equal(tiff.first(kExif.size()), kExif)) {
    tiff = tiff.subspan(kExif.size());
  }
  return orientationFromExif(tiff);
}

class WebpReader final : public PhotographReader {
 public:
  WebpReader(FilePool& pool, std::size_t file, const PhotographHeader& header)
      : header_(header), path_(pool.path(file)) {
    const PageBuffer bytes(pool.bytes(file));
    if (pool.read(file, 0, {bytes.data(), bytes.bytes()}) < bytes.bytes()) {
      throw damaged(path_, "its end too early");
    }
    const std::size_t rowBytes = header.rowBytes();
    samples_ = PageBuffer(rowBytes * static_cast<std::size_t>(header.stored.height));
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    auto* out = reinterpret_cast<std::uint8_t*>(samples_.data());
    int width = 0, height = 0;
    const bool known = WebPGetInfo(data, bytes.bytes(), &width, &height) != 0 &&
                       Size{width, height} == header.stored;
    const auto decodeInto = header.alpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (!known || decodeInto(data, bytes.bytes(), out, samples_.bytes(),
                             static_cast<int>(rowBytes)) == nullptr) {
      throw damaged(path_, "something that cannot be decoded");
    }
  }

  void read(int rows, std::byte* samples) override {
    const std::size_t bytes = header_.rowBytes() * static_cast<std::size_t>(rows);
    std::memcpy(samples, samples_.data() + done_, bytes);
    done_ += bytes;
  }

 private:
  PhotographHeader header_;
  std::filesystem::path path_;
  PageBuffer samples_;
  std::size_t done_ = 0;
};

}  // namespace

PhotographHeader readWebpHeader(FilePool& pool, std::size_t file) {
  constexpr std::uint64_t kFrameHeadBytes = 10;
  PhotographHeader header;
  header.format = PhotographFormat::WebP;
  header.sequential = false;
  Chunks chunks(pool, file);
  while (chunks.next()) {
    if (chunks.name() == "ICCP") header.profile = chunks.content(kLargestMetadataBytes);
    if (chunks.name() == "EXIF") {
      header.orientation = orientationOf(chunks.content(kLargestMetadataBytes));
    }
    if (chunks.name() == "ANIM")
      throw inputError(pool.path(file), "a still picture", "an animation");
    if (chunks.name() == "ALPH") header.alpha = true;
    if (chunks.name() != "VP8 " && chunks.name() != "VP8L") continue;
    const std::vector<std::byte> frame = chunks.content(kFrameHeadBytes);
    if (frame.size() < kFrameHeadBytes) throw damaged(pool.path(file), "its end too early");
    if (chunks.name() == "VP8L") {
      // After a signature byte: 14 bits width - 1, 14 bits height - 1, 1 bit alpha.
      const std::uint32_t bits = littleEndian(frame.data() + 1, 4);
      header.stored = {static_cast<int>(bits & 0x3fff) + 1,
                       static_cast<int>(bits >> 14 & 0x3fff) + 1};
      header.alpha = (bits >> 28 & 1) != 0;
    } else {
      // RFC 6386, section 9.1: after three bytes and a start code of three.
      header.stored = {static_cast<int>(littleEndian(frame.data() + 6, 2) & 0x3fff),
                       static_cast<int>(littleEndian(frame.data() + 8, 2) & 0x3fff)};
    }
  }
  if (header.stored.pixels() == 0) throw damaged(pool.path(file), "no picture");
  header.decoderBytes =
      pool.bytes(file) + kDecoderBytes +
      header.stored.pixels() * (static_cast<unsigned>(header.channels()) + kDecoderBytesPerPixel);
  return header;
}

std::unique_ptr<PhotographReader> openWebpReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header) {
  return std::make_unique<WebpReader>(pool, file, header);
}

}  // namespace illum
