#include "capture/photograph_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string>

#include "illum/error.h"

namespace illum {
namespace {

struct FormatEntry {
  PhotographFormat format;
  std::string_view reader, title;
  std::string_view endings;  // lower case, each between two spaces
};

constexpr std::array kFormats{
    FormatEntry{PhotographFormat::Jpeg, "jpeg", "JPEG", " jpg jpeg jpe jfif "},
    FormatEntry{PhotographFormat::Png, "png", "PNG", " png "},
    FormatEntry{PhotographFormat::Tiff, "tiff", "TIFF", " tif tiff "},
    FormatEntry{PhotographFormat::OpenExr, "openexr", "OpenEXR", " exr "},
    FormatEntry{PhotographFormat::Hdr, "hdr", "Radiance HDR", " hdr rgbe "},
    FormatEntry{PhotographFormat::WebP, "webp", "WebP", " webp "},
    FormatEntry{PhotographFormat::Bmp, "bmp", "BMP", " bmp dib "},
    FormatEntry{PhotographFormat::Targa, "targa", "Targa", " tga tpic "},
    FormatEntry{PhotographFormat::Pnm, "pnm", "PNM", " ppm pgm pbm pnm pfm "},
    FormatEntry{PhotographFormat::Dpx, "dpx", "DPX", " dpx "},
    FormatEntry{PhotographFormat::Jpeg2000, "jpeg2000", "JPEG 2000", " jp2 j2k j2c "},
    FormatEntry{PhotographFormat::Sgi, "sgi", "SGI", " sgi rgb rgba bw "},
    FormatEntry{PhotographFormat::Heif, "heif", "HEIF", " heic heif hif avif "},
    FormatEntry{PhotographFormat::Raw, "raw", "camera raw",
                " 3fr arw cr2 cr3 crw dcr dng erf iiq kdc mef mos mrw nef nrw orf pef raf raw rw2 "
                "rwl sr2 srf srw x3f "},
};

const FormatEntry& entryOf(PhotographFormat format) {
  return *std::ranges::find(kFormats, format, &FormatEntry::format);
}

bool has(std::span<const std::byte> head, std::size_t at, std::string_view text) {
  return head.size() >= at + text.size() &&
         std::equal(text.begin(), text.end(), head.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

std::uint32_t bigEndian(std::span<const std::byte> head, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | std::to_integer<std::uint32_t>(head[at + i]);
  }
  return value;
}

bool isPnm(std::span<const std::byte> head) {
  if (!has(head, 0, "P") || head.size() < 3) return false;
  const auto kind = static_cast<char>(head[1]);
  const bool known = (kind >= '1' && kind <= '6') || kind == 'f' || kind == 'F';
  return known && (std::isspace(std::to_integer<unsigned char>(head[2])) != 0 || has(head, 2, "#"));
}

std::optional<PhotographFormat> formatOfBytes(std::span<const std::byte> head) {
  using enum PhotographFormat;
  if (has(head, 0, "\xff\xd8\xff")) return Jpeg;
  if (has(head, 0, "\x89PNG\r\n\x1a\n")) return Png;
  if (has(head, 0, std::string_view("II*\0", 4)) || has(head, 0, std::string_view("MM\0*", 4)) ||
      has(head, 0, std::string_view("II+\0", 4)) || has(head, 0, std::string_view("MM\0+", 4))) {
    return Tiff;
  }
  if (has(head, 0, "\x76\x2f\x31\x01")) return OpenExr;
  if (has(head, 0, "#?RADIANCE") || has(head, 0, "#?RGBE")) return Hdr;
  if (has(head, 0, "RIFF") && has(head, 8, "WEBP")) return WebP;
  if (has(head, 0, "BM") && head.size() > 14) return Bmp;
  if (has(head, 0, "SDPX") || has(head, 0, "XPDS")) return Dpx;
  if (has(head, 0, std::string_view("\0\0\0\x0cjP  ", 8)) || has(head, 0, "\xff\x4f\xff\x51")) {
    return Jpeg2000;
  }
  if (has(head, 0, "\x01\xda") && head.size() > 512) return Sgi;
  if (has(head, 4, "ftyp") && !has(head, 8, "crx ")) return Heif;
  if (isPnm(head)) return Pnm;
  return std::nullopt;
}

std::optional<Size> sizeFromNumbers(std::uint32_t width, std::uint32_t height) {
  if (width > 0x7fffffff || height > 0x7fffffff) return std::nullopt;
  return Size{static_cast<int>(width), static_cast<int>(height)};
}

// ISO/IEC 15444-1: the SIZ segment comes right after the start of the code stream.
std::optional<Size> jpeg2000Size(std::span<const std::byte> head) {
  for (std::size_t at = 0; at + 24 <= head.size(); ++at) {
    if (!has(head, at, "\xff\x4f\xff\x51")) continue;
    const std::uint32_t right = bigEndian(head, at + 8), bottom = bigEndian(head, at + 12);
    const std::uint32_t left = bigEndian(head, at + 16), top = bigEndian(head, at + 20);
    if (left >= right || top >= bottom) return std::nullopt;
    return sizeFromNumbers(right - left, bottom - top);
  }
  return std::nullopt;
}

// ISO/IEC 23008-12: every item that is a picture, tile or whole, has an `ispe` property; the
// largest is the picture's own.
std::optional<Size> heifSize(std::span<const std::byte> head) {
  std::optional<Size> largest;
  for (std::size_t at = 0; at + 16 <= head.size(); ++at) {
    if (!has(head, at, "ispe")) continue;
    const auto size = sizeFromNumbers(bigEndian(head, at + 8), bigEndian(head, at + 12));
    if (size && (!largest || size->pixels() > largest->pixels())) largest = size;
  }
  return largest;
}

}  // namespace

std::string_view readerNameOf(PhotographFormat format) {
  return entryOf(format).reader;
}

std::string_view titleOf(PhotographFormat format) {
  return entryOf(format).title;
}

bool decodesWhenOpened(PhotographFormat format) {
  return format == PhotographFormat::Jpeg2000 || format == PhotographFormat::Heif ||
         format == PhotographFormat::Pnm;
}

std::optional<PhotographFormat> formatOfName(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  if (ending.size() < 2 || ending.find(' ') != std::string::npos) return std::nullopt;
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string wanted = " " + ending.substr(1) + " ";
  const auto entry = std::ranges::find_if(
      kFormats, [&](const FormatEntry& f) { return f.endings.find(wanted) != std::string::npos; });
  if (entry == kFormats.end()) return std::nullopt;
  return entry->format;
}

PhotographFormat formatOfFile(const std::filesystem::path& file, std::span<const std::byte> head) {
  if (head.empty()) throw inputError(file, "a photograph", "an empty file");
  const auto byName = formatOfName(file), byContent = formatOfBytes(head);
  // Most camera raw formats are TIFF files inside.
  if (byName == PhotographFormat::Raw) return *byName;
  // Targa has no mark of its own.
  if (byName == PhotographFormat::Targa && !byContent) return *byName;
  if (!byContent) {
    throw inputError(file,
                     byName ? "a " + std::string(titleOf(*byName)) + " picture" : "a photograph",
                     "something else");
  }
  if (byName && byName != byContent) {
    throw inputError(file, "a " + std::string(titleOf(*byName)) + " picture as its name says",
                     "a " + std::string(titleOf(*byContent)) + " picture");
  }
  return *byContent;
}

std::optional<Size> declaredSize(const std::filesystem::path& file, PhotographFormat format,
                                 std::span<const std::byte> head) {
  std::optional<Size> size;
  switch (format) {
    case PhotographFormat::Jpeg2000:
      size = jpeg2000Size(head);
      break;
    case PhotographFormat::Heif:
      size = heifSize(head);
      break;
    default:
      return std::nullopt;
  }
  if (!size || size->width < 1 || size->height < 1) {
    throw inputError(file, "a " + std::string(titleOf(format)) + " picture that tells its size",
                     "none in its header");
  }
  return size;
}

}  // namespace illum
