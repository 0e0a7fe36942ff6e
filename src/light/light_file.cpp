#include "illum/light_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>

#include "core/files.h"
#include "illum/error.h"
#include "light/light_line.h"

namespace illum {
namespace {

constexpr const char* kEntryForm = "a photograph's name and 3, 4 or 6 numbers";

/// A line that is one whole number. Beyond 2^64 it is wrong in any case and gives the largest.
std::optional<std::uint64_t> countIn(std::string_view line) {
  if (line.find_first_not_of("0123456789") != line.npos) return std::nullopt;
  std::uint64_t count = 0;
  const auto result = std::from_chars(line.data(), line.data() + line.size(), count);
  return result.ec == std::errc() ? count : std::numeric_limits<std::uint64_t>::max();
}

/// Parses line by line; what is remarkable is counted and said once, at the end.
class LightFileParser {
 public:
  LightFileParser(std::string_view text, const std::filesystem::path& source)
      : source_(source), lines_(text, source) {}

  LightFile parse() {
    while (lines_.next()) {
      if (!takePreamble()) takeEntry();
    }
    checkCount();
    remarkOnLengths();
    remarkOnDuplicates();
    remarkOnSides();
    if (decimalCommas_) remark("numbers are written with decimal commas and were read so");
    return std::move(result_);
  }

 private:
  /// A count and a header, in any order, each at most once, before the first entry.
  bool takePreamble() {
    if (entryLines_ > 0) return false;
    if (!count_ && (count_ = countIn(lines_.text()))) {
      countLine_ = lines_.number();
      return true;
    }
    const bool isHeader =
        !header_ && hasNoNumbers(lines_.text()) && fieldsAtLeastFour(lines_.text());
    header_ = header_ || isHeader;
    return isHeader;
  }

  /// A header names the photograph and three coordinates.
  static bool fieldsAtLeastFour(std::string_view line) {
    std::size_t fields = 0, at = 0;
    while ((at = line.find_first_not_of(" \t,;", at)) != line.npos) {
      ++fields;
      at = std::min(line.find_first_of(" \t,;", at), line.size());
    }
    return fields >= 4;
  }

  void takeEntry() {
    const auto read = readNamedNumbers(lines_.text(), {3, 4, 6});
    if (!read) throw lines_.error(kEntryForm);
    ++entryLines_;
    if (entryLines_ > kMaxLightFileEntries)
      throw lines_.error(fmt::format("at most {} entries", kMaxLightFileEntries), "more");
    decimalCommas_ = decimalCommas_ || read->decimalCommas;
    add({checkedName(read->name),
         {direction(read->numbers), intensity(read->numbers)},
         lines_.number()});
  }

  std::string checkedName(std::string_view written) const {
    std::string name = withoutFolders(written);
    if (name.empty() || name == "." || name == "..") throw lines_.error("a photograph's name");
    return name;
  }

  Direction direction(const std::vector<double>& numbers) {
    const Vector3 vector{numbers[0], numbers[1], numbers[2]};
    if (!std::isfinite(vector.x) || !std::isfinite(vector.y) || !std::isfinite(vector.z))
      throw lines_.error("three finite coordinates");
    if (vector == Vector3{}) throw lines_.error("a direction", "the zero vector");
    const double norm = length(vector);
    shortest_ = std::min(shortest_, norm);
    longest_ = std::max(longest_, norm);
    if (std::abs(norm - 1) > 1e-3) ++nonUnit_;
    return Direction::fromVector(vector);
  }

  LinearRgb intensity(const std::vector<double>& numbers) const {
    if (numbers.size() == 3) return {1, 1, 1};
    return intensityIn(std::span(numbers).subspan(3), lines_);
  }

  void add(LightFileEntry entry) {
    const auto [found, isNew] = byName_.try_emplace(entry.name, result_.entries.size());
    if (isNew) {
      result_.entries.push_back(std::move(entry));
      return;
    }
    const LightFileEntry& earlier = result_.entries[found->second];
    const bool same = earlier.light.toLight == entry.light.toLight &&
                      earlier.light.intensity == entry.light.intensity;
    if (!same)
      throw lines_.error(
          fmt::format("one light for '{}', as in line {}", shown(entry.name), earlier.line),
          "another");
    if (duplicates_++ == 0)
      firstDuplicate_ = fmt::format("line {} repeats line {}", entry.line, earlier.line);
  }

  void checkCount() const {
    if (entryLines_ == 0) throw inputError(source_, kEntryForm, "no entry at all");
    // Some writers count the photographs, some the lines.
    if (count_ && *count_ != entryLines_ && *count_ != result_.entries.size())
      throw inputError(source_, fmt::format("{} entries, as line {} says", *count_, countLine_),
                       std::to_string(entryLines_));
  }

  void remark(const std::string& sentence) {
    result_.remarks.push_back(source_.string() + ": " + sentence);
  }

  void remarkOnLengths() {
    if (nonUnit_ == 0) return;
    const bool positions = shortest_ > 1.5;
    remark(fmt::format(
        "{} of {} vectors are not of unit length ({:.4g} to {:.4g}) and were {}", nonUnit_,
        entryLines_, shortest_, longest_,
        positions ? "taken as positions of lights around the object at the origin" : "normalised"));
  }

  void remarkOnDuplicates() {
    if (duplicates_ == 0) return;
    remark(fmt::format("{} repeated {} merged ({})", duplicates_,
                       duplicates_ == 1 ? "entry was" : "entries were", firstDuplicate_));
  }

  void remarkOnSides() {
    const auto behind = [](const LightFileEntry& entry) { return entry.light.toLight.z() < 0; };
    if (std::all_of(result_.entries.begin(), result_.entries.end(), behind))
      remark("every light is behind the object; z should point toward the camera");
  }

  const std::filesystem::path& source_;
  LightLines lines_;
  LightFile result_;
  std::unordered_map<std::string, std::size_t> byName_;
  std::optional<std::uint64_t> count_;
  int countLine_ = 0;
  bool header_ = false, decimalCommas_ = false;
  std::size_t entryLines_ = 0, nonUnit_ = 0, duplicates_ = 0;
  double shortest_ = std::numeric_limits<double>::infinity(), longest_ = 0;
  std::string firstDuplicate_;
};

}  // namespace

LightFile parseLightFile(std::string_view text, const std::filesystem::path& source) {
  return LightFileParser(text, source).parse();
}

LightFile readLightFile(const std::filesystem::path& file) {
  return parseLightFile(readTextFile(file, kMaxLightFileBytes), file);
}

}  // namespace illum
