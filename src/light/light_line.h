// One line of a light file: a photograph's name and some numbers, however they are set apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "illum/colour.h"
#include "illum/error.h"

namespace illum {

constexpr std::uint64_t kMaxLightFileBytes = 64ULL << 20;
constexpr std::size_t kMaxLightFileEntries = 1'000'000;

/// The lines of a text that say something: without byte-order mark, line ends (LF, CRLF or CR),
/// surrounding blanks, trailing commas and semicolons, blank lines, and lines that begin with # or
/// //. Throws Error for text that is UTF-16 or binary, or for a line longer than 4096 bytes.
class LightLines {
 public:
  LightLines(std::string_view text, const std::filesystem::path& source);

  /// False at the end.
  bool next();
  std::string_view text() const { return line_; }
  int number() const { return number_; }  ///< counted from 1, of all lines

  /// "SOURCE:NUMBER: expected EXPECTED, found FOUND"
  Error error(std::string_view expected, std::string_view found) const;
  /// The same; finds the line itself.
  Error error(std::string_view expected) const;

 private:
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
  const std::filesystem::path& source_;
};

struct NamedNumbers {
  std::string name;  ///< as written, folders included, quotes removed; empty if there is none
  std::vector<double> numbers;  ///< may be NaN or infinite: the file may say so
  bool decimalCommas = false;
};

/// Reads a line as a name followed by numbers, or numbers followed by a name; `counts` says how
/// many numbers there may be. Nothing if it cannot be read so. A name may hold blanks, commas and
/// numbers; a line of numbers alone begins with a name if it has one number too many, and has none
/// if their count is allowed and `mayLackName`. What follows a complete line after # or // is a
/// comment.
std::optional<NamedNumbers> readNamedNumbers(std::string_view line,
                                             std::initializer_list<std::size_t> counts,
                                             bool mayLackName = false);

/// Whether no field of the line is empty or a number: it may be a header.
bool hasNoNumbers(std::string_view line);

/// One number for all channels, or three. Throws Error, about the line that was read last, unless
/// all are positive and finite also in single precision.
LinearRgb intensityIn(std::span<const double> numbers, const LightLines& lines);

/// The name alone: "C:\photos\a b.jpg" and "photos/a b.jpg" give "a b.jpg".
std::string withoutFolders(std::string_view name);

/// For messages: at most 60 bytes, no control characters.
std::string shown(std::string_view text);

}  // namespace illum
