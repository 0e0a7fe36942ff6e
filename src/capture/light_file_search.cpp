#include "capture/light_file_search.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "capture/file_names.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr std::array<std::string_view, 9> kUsualStems{
    "lights",          "dirs",       "light_directions", "light_dirs", "lightdirections",
    "light_positions", "directions", "light_dir",        "lp"};

bool isUsualText(const std::string& lower) {
  const std::filesystem::path name(lower);
  const std::string ending = name.extension().string();
  return (ending == ".txt" || ending == ".csv") &&
         std::ranges::find(kUsualStems, name.stem().string()) != kUsualStems.end();
}

// Of several candidates the one that is clearly meant: "lights", or else "dirs".
const std::string* clearlyMeant(const std::vector<std::string>& candidates) {
  for (const std::string_view stem : {"lights", "dirs"}) {
    const std::string* meant = nullptr;
    int count = 0;
    for (const std::string& name : candidates) {
      if (std::filesystem::path(lowerCase(name)).stem().string() != stem) continue;
      meant = &name;
      ++count;
    }
    if (count == 1) return meant;
    if (count > 1) return nullptr;
  }
  return nullptr;
}

FoundLightFile choose(const std::filesystem::path& folder,
                      const std::vector<std::string>& candidates) {
  if (candidates.size() == 1) return {folder / candidates.front(), {}};
  const std::string* meant = clearlyMeant(candidates);
  if (meant == nullptr) {
    throw inputError(folder, "one light file", fmt::format("{}", fmt::join(candidates, ", ")));
  }
  return {folder / *meant, fmt::format("{}: taken for the light file among {}",
                                       (folder / *meant).string(), fmt::join(candidates, ", "))};
}

}  // namespace

std::vector<std::string> filesIn(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  std::filesystem::directory_iterator entry(folder, error);
  if (error) throw fileError(folder, "list the folder", error.value());
  for (; entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    std::error_code unreadable;
    const std::string name = entry->path().filename().string();
    if (!name.starts_with('.') && entry->is_regular_file(unreadable)) names.push_back(name);
  }
  if (error) throw fileError(folder, "list the folder", error.value());
  std::ranges::sort(names);
  return names;
}

FoundLightFile findLightFile(const std::filesystem::path& folder) {
  // In order of preference.
  std::array<std::vector<std::string>, 3> candidates;
  for (const std::string& name : filesIn(folder)) {
    const std::string lower = lowerCase(name);
    if (lower.ends_with(".lp")) candidates[0].push_back(name);
    if (isUsualText(lower)) candidates[1].push_back(name);
    if (lower.ends_with(".csv")) candidates[2].push_back(name);
  }
  for (const std::vector<std::string>& some : candidates) {
    if (!some.empty()) return choose(folder, some);
  }
  throw inputError(folder, "a light file (*.lp, lights.txt, dirs.txt, *.csv)", "none");
}

}  // namespace illum
