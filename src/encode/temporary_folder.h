// A folder that lives as long as a test.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace illum {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Without flushing, which tests of thousands of files cannot wait for.
void writeUnflushed(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace illum
