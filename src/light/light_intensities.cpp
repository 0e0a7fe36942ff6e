#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "core/files.h"
#include "illum/error.h"
#include "illum/light_file.h"
#include "light/light_line.h"

namespace illum {
namespace {

constexpr const char* kIntensityForm =
    "one or three numbers, with or without a photograph's name before them";

struct IntensityLine {
  std::string name;  ///< empty where the line's place counts
  LinearRgb intensity;
  int line = 0;
  bool wholeNumber = false;  ///< one unnamed whole number: it may be a count
};

class IntensityReader {
 public:
  IntensityReader(std::string_view text, const std::filesystem::path& source)
      : lines_(text, source) {}

  std::vector<IntensityLine> read() {
    bool header = false;
    while (lines_.next()) {
      if (result_.empty() && !header && hasNoNumbers(lines_.text())) {
        header = true;
        continue;
      }
      take();
    }
    return std::move(result_);
  }

 private:
  void take() {
    const auto read = readNamedNumbers(lines_.text(), {1, 3}, true);
    if (!read) throw lines_.error(kIntensityForm);
    if (result_.size() > kMaxLightFileEntries)
      throw lines_.error(fmt::format("at most {} entries", kMaxLightFileEntries), "more");
    IntensityLine line{withoutFolders(read->name), intensityIn(read->numbers, lines_),
                       lines_.number()};
    line.wholeNumber = lines_.text().find_first_not_of("0123456789") == std::string_view::npos;
    const bool isFirst = result_.empty() || (result_.size() == 1 && result_[0].wholeNumber);
    if (!isFirst && line.name.empty() != result_.back().name.empty())
      throw lines_.error("names in every line or in none");
    result_.push_back(std::move(line));
  }

  LightLines lines_;
  std::vector<IntensityLine> result_;
};

/// A first line that is the number of those that follow is no intensity.
void dropCount(std::vector<IntensityLine>& lines) {
  if (lines.empty() || !lines[0].wholeNumber) return;
  const bool namesFollow = lines.size() > 1 && !lines[1].name.empty();
  if (namesFollow || lines[0].intensity.r == static_cast<float>(lines.size() - 1))
    lines.erase(lines.begin());
}

void assignByPlace(const std::filesystem::path& file, const std::vector<IntensityLine>& lines,
                   LightFile& lights) {
  if (lines.size() != lights.entries.size())
    throw inputError(file, fmt::format("{} intensities, one for each light", lights.entries.size()),
                     std::to_string(lines.size()));
  for (std::size_t i = 0; i < lines.size(); ++i)
    lights.entries[i].light.intensity = lines[i].intensity;
}

void assignByName(const std::filesystem::path& file, const std::vector<IntensityLine>& lines,
                  LightFile& lights) {
  std::unordered_map<std::string_view, const IntensityLine*> byName;
  for (const IntensityLine& line : lines) {
    const auto [found, isNew] = byName.try_emplace(line.name, &line);
    if (!isNew && !(found->second->intensity == line.intensity))
      throw inputError(file,
                       fmt::format("one intensity for '{}', as in line {}", shown(line.name),
                                   found->second->line),
                       fmt::format("another in line {}", line.line));
  }
  std::vector<LinearRgb> intensities;
  for (const LightFileEntry& entry : lights.entries) {
    const auto found = byName.find(entry.name);
    if (found == byName.end())
      throw inputError(file, fmt::format("an intensity for '{}'", shown(entry.name)), "none");
    intensities.push_back(found->second->intensity);
  }
  for (std::size_t i = 0; i < intensities.size(); ++i)
    lights.entries[i].light.intensity = intensities[i];
}

}  // namespace

void readLightIntensities(const std::filesystem::path& file, LightFile& lights) {
  const std::string text = readTextFile(file, kMaxLightFileBytes);
  std::vector<IntensityLine> lines = IntensityReader(text, file).read();
  dropCount(lines);
  const bool named = !lines.empty() && !lines.front().name.empty();
  (named ? assignByName : assignByPlace)(file, lines, lights);
}

}  // namespace illum
