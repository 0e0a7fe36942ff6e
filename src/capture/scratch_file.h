// A file without a name, for what does not fit into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "illum/error.h"

namespace illum {

/// Removed from its folder before it is written to, so that nothing remains however the program
/// ends. Reading and writing different parts is thread safe.
class ScratchFile {
 public:
  ScratchFile() = default;
  /// Reserves the space. Throws Error (Fault::Machine) that names the size and the folder when
  /// there is not enough of it or nothing can be written there.
  ScratchFile(const std::filesystem::path& folder, std::uint64_t bytes);
  ~ScratchFile();
  ScratchFile(ScratchFile&& other) noexcept;
  ScratchFile& operator=(ScratchFile&& other) noexcept;

  bool isOpen() const { return descriptor_ >= 0; }
  /// Both throw Error (Fault::Machine).
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  Error fault(const char* what, int errnoValue) const;

  std::filesystem::path folder_;
  std::uint64_t bytes_ = 0;
  int descriptor_ = -1;
};

}  // namespace illum
