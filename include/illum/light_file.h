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

/// Parses the text of a light file. Accepts: with or without a count line; separators space, tab, comma,
/// semicolon; CRLF; a byte-order mark; blank lines; # and // comments; a header line; names with spaces,
/// quotes and Windows or Unix folders; three numbers (direction) or four (and an intensity) or six (and
/// an RGB intensity); vectors of any length (normalised, with a remark when they are positions).
/// Exact duplicates are merged with a remark; the same name under two directions is an error, as are
/// NaN, infinite, zero vectors, non-positive intensities, a wrong count, no entries at all.
/// `source` names the file in errors. Untrusted input is safe.
LightFile parseLightFile(std::string_view text, const std::filesystem::path& source);

/// Reads and parses. Throws Error.
LightFile readLightFile(const std::filesystem::path& file);

/// Reads per-light intensities (`light_intensities.txt`): one line per entry of `lights`, in order, with
/// one or three positive numbers, or lines that begin with the photograph's name. Replaces intensities.
void readLightIntensities(const std::filesystem::path& file, LightFile& lights);

}  // namespace illum
