// Which photograph each entry of a light file means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "illum/light_file.h"

namespace illum {

struct PhotographMatch {
  std::vector<std::string> names;    ///< one for each entry: the file's name in the folder
  std::vector<std::string> remarks;  ///< what was forgiven, what was left over
};

/// An entry means the file of its name; else the one whose name differs only in case; else the only
/// photograph whose name differs only in the ending. `files`: names in the folder; `lightFile`
/// names the light file in sentences. Throws Error: an entry without a photograph (names the first
/// and counts them), with several, or two entries that mean the same one.
PhotographMatch matchPhotographs(const LightFile& lights, const std::filesystem::path& lightFile,
                                 const std::vector<std::string>& files);

}  // namespace illum
