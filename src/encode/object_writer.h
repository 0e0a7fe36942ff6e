// Writing an object: OUT.partial/ tile by tile, then packed and renamed (docs/format.md,
// "Writing").
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "encode/entry_journal.h"

namespace illum {

enum class ObjectForm { Archive, Folder };

/// Collects the entries of one object in `OUT.partial/` and turns them into OUT at the end.
/// Every entry is written atomically; a killed writer leaves a partial folder that a later one with
/// the same `fingerprint` can resume. Entry names are checked. add() and has() are thread safe.
class ObjectWriter {
 public:
  /// `fingerprint`: text that identifies inputs and settings; kept in the partial folder.
  /// If the partial folder exists: with `resume` and an equal fingerprint its entries are kept;
  /// with `resume` and another fingerprint, Error; without `resume` it is emptied, unless it holds
  /// what no ObjectWriter put there. A `resume` without a partial folder begins anew. Throws Error
  /// (Fault::Input) if `out` exists and `force` is false, or is a folder that holds no object;
  /// Fault::Machine if the folder cannot be written or another process is writing it.
  ObjectWriter(std::filesystem::path out, ObjectForm form, std::string fingerprint, bool resume,
               bool force);
  /// Removes the partial folder unless keepPartial() was called and an entry is in it.
  ~ObjectWriter();
  ObjectWriter(const ObjectWriter&) = delete;
  ObjectWriter& operator=(const ObjectWriter&) = delete;

  /// Finished already, by an earlier run too; what was damaged since is not.
  bool has(const std::string& entry) const;
  /// Replaces the entry if it exists. A machine's fault here keeps the partial folder.
  void add(const std::string& entry, std::span<const std::byte> bytes);
  /// For signals and machine faults: what is done stays for --resume, if anything is.
  void keepPartial();
  /// Where scratch files may lie; removed at finish, and emptied when a writer resumes.
  std::filesystem::path scratchFolder() const;
  /// Packs in canonical order, flushes, renames. Returns the object's bytes. Throws Error if an
  /// entry that object.json speaks of is missing; entries that it does not speak of are left out.
  /// After a machine's fault the partial folder stays.
  std::uint64_t finish();

 private:
  void createPartial(const std::string& fingerprint, bool resume);
  void lock();
  std::uint64_t finishArchive();
  std::uint64_t finishFolder();

  std::filesystem::path out_, partial_;
  ObjectForm form_;
  bool force_, keep_ = false, finished_ = false;
  int lock_ = -1;
  std::optional<EntryJournal> journal_;
};

}  // namespace illum
