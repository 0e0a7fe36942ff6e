// Files: whole reads with a limit, atomic replacement, checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace illum {

/// The whole file, a pipe included. Throws Error if it is missing or a folder (Fault::Input),
/// unreadable (Fault::Machine), or larger than `limitBytes` (Fault::Input; of an ordinary file
/// before memory is allocated).
std::vector<std::byte> readFile(const std::filesystem::path& file, std::uint64_t limitBytes);
std::string readTextFile(const std::filesystem::path& file, std::uint64_t limitBytes);

/// A file that comes to be all at once: written beside its target under another name, flushed to
/// the disk, renamed. Until commit() has returned, the target stays as it was; without commit()
/// nothing of the temporary remains. Every failure is an Error (Fault::Machine). The target may be
/// missing or an ordinary file that its user may write, or a link to one; its permissions are kept.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// For libraries that open files by name. They must close it before commit().
  const std::filesystem::path& temporary() const { return temporary_; }
  void write(std::span<const std::byte> bytes);
  void commit();

 private:
  void createTemporary();
  [[noreturn]] void fail(int errnoValue) const;

  std::filesystem::path target_;     ///< as it was named, for messages
  std::filesystem::path resolved_;   ///< links followed
  std::filesystem::path temporary_;  ///< empty once there is nothing to remove
  int descriptor_ = -1;
};

/// Replaces `file` by `bytes` atomically (AtomicFile).
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& file, std::string_view text);

/// CRC-32 as in zip and PNG (reflected 0xEDB88320). `crc` continues a running value.
std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t crc = 0);

/// fsync of a file or folder by name; throws Error (Fault::Machine).
void syncPath(const std::filesystem::path& path);

}  // namespace illum
