// Which kinds of picture file are read as photographs, and how a file's kind is told.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "illum/picture.h"

namespace illum {

enum class PhotographFormat {
  Jpeg,
  Png,
  Tiff,
  OpenExr,
  Hdr,
  WebP,
  Bmp,
  Targa,
  Pnm,
  Dpx,
  Jpeg2000,
  Sgi,
  Heif,
  Raw
};

/// What OpenImageIO calls its reader: the white list, for no other reader is ever asked.
std::string_view readerNameOf(PhotographFormat format);

/// "JPEG", "camera raw": for people.
std::string_view titleOf(PhotographFormat format);

/// Whether its reader decodes all of a picture as soon as it is opened, even for its header.
bool decodesWhenOpened(PhotographFormat format);

/// By the name's ending (any case); nothing if it is not a photograph's.
std::optional<PhotographFormat> formatOfName(const std::filesystem::path& file);

/// Bytes at the beginning of a file that formatOfFile and declaredSize look at.
inline constexpr std::size_t kHeadBytes = 65536;

/// The kind of a file whose first bytes are `head`. Name and content must agree where both tell.
/// Untrusted input is safe. Throws Error for empty files and for what is no photograph.
PhotographFormat formatOfFile(const std::filesystem::path& file, std::span<const std::byte> head);

/// Formats whose reader decodes the whole picture as soon as it is opened say their size in `head`,
/// so that memory can be checked before. Nothing for other formats. Throws Error naming `file` if
/// such a format does not tell.
std::optional<Size> declaredSize(const std::filesystem::path& file, PhotographFormat format,
                                 std::span<const std::byte> head);

}  // namespace illum
