// Light files: which photograph was taken under which light (.lp and what is found in its place).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "illum/light.h"

namespace illum {

struct LightFileEntry {
  std::string name;        ///< file name of the photograph, without folders, as written
  DirectionalLight light;  ///< intensity 1 unless the file gives one
  int line = 0;            ///< in the file, counted from 1
};

struct LightFile {
  std::vector<LightFileEntry> entries;  ///< in the order of the file, duplicates merged
  std::vector<std::string> remarks;     ///< repairs, one sentence each, for the user to read
};

/// Parses the text of a light file. A line holds a photograph's name and three numbers (direction),
/// four (and an intensity) or six (and an RGB intensity); the name stands first or last. Accepts:
/// - with or without a count line and a header line, in either order; blank lines; # and //
/// comments,
///   also behind an entry; a byte-order mark of UTF-8; LF, CRLF or CR;
/// - separators space, tab, comma, semicolon; decimal commas between blanks or semicolons, with a
/// remark;
/// - names with spaces, quotes, Windows or Unix folders;
/// - vectors of any length: normalised, with one remark when some are off by more than 0.1 %.
/// Exact duplicates are merged with a remark. The same name under two lights is an error, as are
/// NaN, infinite and zero vectors, intensities that are not positive and finite, a wrong count, no
/// entries at all, UTF-16 and binary data, lines over 4096 bytes, more than 1000000 entries.
/// `source` names the file in errors, which end its name with the line: "lights.lp:7". Untrusted
/// input is safe.
LightFile parseLightFile(std::string_view text, const std::filesystem::path& source);

/// Reads and parses. Throws Error, also for files over 64 MiB.
LightFile readLightFile(const std::filesystem::path& file);

/// Reads per-light intensities (`light_intensities.txt`) and replaces those of `lights`. One or
/// three positive numbers a line (grey or R G B); lines stand for the entries of `lights` in order,
/// or each begins with a photograph's name. As forgiving as parseLightFile about all else. Throws
/// Error, and then leaves `lights` as it was, unless every entry gets exactly one intensity.
void readLightIntensities(const std::filesystem::path& file, LightFile& lights);

}  // namespace illum
