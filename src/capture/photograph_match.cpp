#include "capture/photograph_match.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unordered_map>

#include "capture/file_names.h"
#include "capture/photograph_format.h"
#include "illum/error.h"

namespace illum {
namespace {

// A name without its ending, if that is one of a photograph's: "DSC.0001" keeps its number.
std::string stemOf(const std::string& lower) {
  const std::filesystem::path name(lower);
  return formatOfName(name) ? name.stem().string() : lower;
}

class Matcher {
 public:
  Matcher(const std::filesystem::path& lightFile, const std::vector<std::string>& files)
      : lightFile_(lightFile), files_(files) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      const std::string lower = lowerCase(files[i]);
      byName_[files[i]].push_back(i);
      byLowerCase_[lower].push_back(i);
      if (formatOfName(files[i])) byStem_[stemOf(lower)].push_back(i);
    }
  }

  PhotographMatch match(const LightFile& lights) {
    std::vector<const LightFileEntry*> missing;
    for (const LightFileEntry& entry : lights.entries) {
      if (!take(entry)) missing.push_back(&entry);
    }
    if (!missing.empty()) throw missingError(missing);
    remarkOnForgiven();
    remarkOnUnused();
    return std::move(result_);
  }

 private:
  using Index = std::unordered_map<std::string, std::vector<std::size_t>>;

  bool take(const LightFileEntry& entry) {
    const std::string lower = lowerCase(entry.name);
    if (claim(entry, byName_, entry.name)) return true;
    if (claim(entry, byLowerCase_, lower)) {
      otherCase_.push_back(&entry);
      return true;
    }
    if (claim(entry, byStem_, stemOf(lower))) {
      otherEnding_.push_back(&entry);
      return true;
    }
    return false;
  }

  bool claim(const LightFileEntry& entry, const Index& index, const std::string& key) {
    const auto found = index.find(key);
    if (found == index.end()) return false;
    if (found->second.size() > 1) {
      std::vector<std::string> names;
      for (const std::size_t i : found->second) names.push_back(files_[i]);
      throw inputError(lightFile_,
                       fmt::format("one photograph for \"{}\" in line {}", entry.name, entry.line),
                       fmt::format("{}", fmt::join(names, ", ")));
    }
    const std::size_t file = found->second.front();
    const auto [other, isFirst] = claimed_.try_emplace(file, &entry);
    if (!isFirst) {
      throw inputError(lightFile_, "a photograph for each line",
                       fmt::format("{} meant by lines {} and {}", files_[file], other->second->line,
                                   entry.line));
    }
    result_.names.push_back(files_[file]);
    return true;
  }

  Error missingError(const std::vector<const LightFileEntry*>& missing) const {
    const std::string more =
        missing.size() > 1 ? fmt::format(" and {} others", missing.size() - 1) : std::string();
    return inputError(lightFile_,
                      fmt::format("the photograph \"{}\" of line {}{} in the folder",
                                  missing.front()->name, missing.front()->line, more),
                      "no such file");
  }

  void remarkOnForgiven() {
    const auto remark = [this](const std::vector<const LightFileEntry*>& forgiven,
                               const char* what) {
      if (forgiven.empty()) return;
      result_.remarks.push_back(fmt::format(
          "{}: {} of {} names are those of files but for {}, \"{}\" the first", lightFile_.string(),
          forgiven.size(), claimed_.size(), what, forgiven.front()->name));
    };
    remark(otherCase_, "upper and lower case");
    remark(otherEnding_, "the ending");
  }

  void remarkOnUnused() {
    std::vector<std::string> unused;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (formatOfName(files_[i]) && !claimed_.contains(i)) unused.push_back(files_[i]);
    }
    if (unused.empty()) return;
    result_.remarks.push_back(fmt::format(
        "{}: {} {} in the folder {} no line and {} left out, {} the first", lightFile_.string(),
        unused.size(), unused.size() == 1 ? "photograph" : "photographs",
        unused.size() == 1 ? "has" : "have", unused.size() == 1 ? "is" : "are", unused.front()));
  }

  const std::filesystem::path& lightFile_;
  const std::vector<std::string>& files_;
  Index byName_, byLowerCase_, byStem_;
  std::unordered_map<std::size_t, const LightFileEntry*> claimed_;
  std::vector<const LightFileEntry*> otherCase_, otherEnding_;
  PhotographMatch result_;
};

}  // namespace

PhotographMatch matchPhotographs(const LightFile& lights, const std::filesystem::path& lightFile,
                                 const std::vector<std::string>& files) {
  return Matcher(lightFile, files).match(lights);
}

}  // namespace illum
