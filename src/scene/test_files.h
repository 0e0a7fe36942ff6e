// Files that exist while a test runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "illum/progress.h"

namespace illum {

/// A folder that is removed with all its files.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view text) const;
  std::filesystem::path write(const std::string& name, std::span<const std::byte> bytes) const;
  std::filesystem::path path(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Keeps what it is told.
class RememberedRemarks final : public Progress {
 public:
  void remark(std::string_view sentence) override { all.emplace_back(sentence); }
  std::vector<std::string> all;
};

/// A glTF 2 file of one triangle (0,0,0) (1,0,0) (0,1,0), its buffer inside; `more` is added to the
/// top level ("\"animations\": [{}]"), `primitive` to its primitive, `node` to its node.
std::string triangleGltf(const std::string& more = "", const std::string& primitive = "",
                         const std::string& node = "");

/// The same as a binary glTF file.
std::vector<std::byte> glbOf(const std::string& gltf);

}  // namespace illum
