// Names of an object's entries: which are safe, what they mean, in which order they stand.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace illum {

inline constexpr std::string_view kManifestEntry = "object.json";
inline constexpr std::string_view kBasisEntry = "basis.bin";
inline constexpr std::string_view kPosterEntry = "poster.jpg";
/// Of the folder form only; never an entry of an archive.
inline constexpr std::string_view kIndexFile = "index.bin";

/// A name that this version gives a meaning. Comparing keys gives the canonical order.
struct EntryKey {
  enum class Kind { Manifest, Basis, Poster, Planes, Depth, Mask } kind = Kind::Manifest;
  int group = 0, level = 0, y = 0, x = 0;  ///< of tiles
  friend auto operator<=>(const EntryKey&, const EntryKey&) = default;
};

/// What `name` means; nothing for any name that this version does not define.
std::optional<EntryKey> entryKeyOf(std::string_view name);

/// "planes/GROUP/LEVEL/X_Y.SUFFIX" or alike; `suffix` with its dot.
std::string tileEntryName(std::string_view folder, int group, int level, int x, int y,
                          std::string_view suffix);

/// Whether a name stays inside the object on every system: relative, '/' between parts, no part
/// empty,
/// "." or "..", no backslash, colon or control character, at most 255 bytes. A '/' at the end (an
/// archive's mark of a folder) is allowed.
bool isSafeEntryName(std::string_view name);

/// Canonical order: defined names by their keys, all others after them by their bytes.
bool entryNameLess(std::string_view a, std::string_view b);

/// Only these may be compressed in an archive.
bool mayBeDeflated(std::string_view name);

}  // namespace illum
