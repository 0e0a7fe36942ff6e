// Which entries of a partial folder are finished, and what their bytes were: so that a run that
// goes on never packs a file that was damaged meanwhile.
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>

namespace illum {

/// A text file of a line for each entry, appended when the entry is on the disk. A line that was
/// cut short by a crash counts for nothing. Thread safe.
class EntryJournal {
 public:
  EntryJournal() = default;
  explicit EntryJournal(std::filesystem::path file) : file_(std::move(file)) {}

  /// Throws Error (Fault::Machine).
  void note(const std::string& entry, std::span<const std::byte> bytes);

  /// Removes the files below `entries` that the journal does not know or that have other bytes
  /// than it says.
  void removeDoubtful(const std::filesystem::path& entries) const;

 private:
  std::filesystem::path file_;
  std::mutex mutex_;
};

}  // namespace illum
