// Which file of a folder says where the lights are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace illum {

struct FoundLightFile {
  std::filesystem::path file;
  std::string remark;  ///< why this one, where there were others; empty otherwise
};

/// The one *.lp file; else the one text file with a name that is usual for light directions
/// (lights, dirs, light_directions, … with .txt or .csv); else the one *.csv. Of several, lights.lp
/// and dirs.lp are clearly meant (or lights.* and dirs.*). Throws Error that names the candidates
/// if that leaves a choice, or says what was looked for if there is none.
FoundLightFile findLightFile(const std::filesystem::path& folder);

/// The regular files of a folder by name, sorted, without hidden ones. Throws Error.
std::vector<std::string> filesIn(const std::filesystem::path& folder);

}  // namespace illum
