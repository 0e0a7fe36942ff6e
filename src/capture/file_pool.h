// Many files read side by side within the limit of open files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace illum {

/// Files by number, opened when they are read and closed, least recently used first, when too many
/// are open. A reader keeps its own position, so closing costs it nothing but the next open. Thread
/// safe.
class FilePool {
 public:
  /// `limit`: files open at a time (at least 1; threads that read at the same moment may exceed
  /// it); 0 = what the process may have open, less some for everything else, after the soft limit
  /// has been raised to the hard one.
  explicit FilePool(std::size_t limit = 0);
  ~FilePool();
  FilePool(const FilePool&) = delete;
  FilePool& operator=(const FilePool&) = delete;

  /// Opens `file`, which must be a regular one. Throws Error.
  std::size_t add(const std::filesystem::path& file);

  const std::filesystem::path& path(std::size_t file) const;
  std::uint64_t bytes(std::size_t file) const;  ///< its size when it was added

  /// Bytes read into `buffer`: fewer than it holds only at the file's end. Throws Error; also when
  /// the file is no longer the one that was added.
  std::size_t read(std::size_t file, std::uint64_t offset, std::span<std::byte> buffer);

  std::size_t openFiles() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum
