#include "encode/object_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <vector>

#include "core/files.h"
#include "core/rename.h"
#include "encode/archive_writer.h"
#include "illum/error.h"
#include "object/entry_name.h"
#include "object/entry_source.h"
#include "object/index_file.h"
#include "object/manifest.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFingerprintFile = "fingerprint.txt";
constexpr std::string_view kJournalFile = "finished.txt";
constexpr std::string_view kLockFile = "lock";
constexpr std::string_view kEntriesFolder = "entries";
constexpr std::string_view kScratchFolder = "scratch";
constexpr std::string_view kPackedFile = "packed.zip";
constexpr std::string_view kReplacedFolder = "replaced";
constexpr std::uint64_t kMaxFingerprintBytes = std::uint64_t{64} << 20;

Error machineError(const fs::path& path, std::string_view action, const std::error_code& error) {
  return {Fault::Machine, fmt::format("{}: cannot {}: {}", path.string(), action, error.message())};
}

void createFolders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw machineError(folder, "create", error);
}

void removeTree(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw machineError(path, "remove", error);
}

bool isThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// A trailing slash says that a folder is wanted; the partial folder stands beside it all the same.
fs::path withoutTrailingSlash(fs::path path) {
  return path.has_filename() ? path : path.parent_path();
}

bool holdsFiles(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (!at->is_directory(error)) return true;
  return false;
}

bool isEmptyFolder(const fs::path& folder) {
  std::error_code error;
  return fs::is_empty(folder, error) && !error;
}

/// --force replaces files and objects, never a folder that holds something else.
void checkTarget(const fs::path& out, bool force) {
  if (out.empty() || !out.has_filename() || out.filename() == "..")
    throw Error(Fault::Usage,
                fmt::format("expected the name of an object to write, found '{}'", out.string()));
  if (!isThere(out)) return;
  if (!force) throw inputError(out, "no file there yet (--force replaces it)", "one");
  std::error_code error;
  if (fs::is_directory(out, error) && !isEmptyFolder(out) &&
      !(isThere(out / kManifestEntry) && isThere(out / kIndexFile)))
    throw inputError(out, "a file or an object to replace", "a folder with other contents");
}

/// Whether every file in the partial folder is one that a writer makes.
bool isPartialFolder(const fs::path& folder) {
  constexpr std::string_view kOurs[] = {kFingerprintFile, kJournalFile,   kLockFile,
                                        kEntriesFolder,   kScratchFolder, kPackedFile,
                                        kReplacedFolder};
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const bool temporary = name.starts_with(".illum-") || name.starts_with(kPackedFile);
    if (!temporary && std::find(std::begin(kOurs), std::end(kOurs), name) == std::end(kOurs))
      return false;
  }
  return !error;
}

std::string requiredText(const fs::path& entries) {
  const fs::path file = entries / kManifestEntry;
  if (!isThere(file))
    throw Error(Fault::Input,
                fmt::format("an object without {} cannot be finished", kManifestEntry));
  return readTextFile(file, kMaxManifestBytes);
}

/// The names that belong to the object, in canonical order.
std::vector<std::string> entriesToFinish(const fs::path& entries) {
  const Manifest manifest = manifestFromText(requiredText(entries), std::string(kManifestEntry));
  std::vector<std::string> names;
  forEachRequiredEntry(manifest, [&](const std::string& name) {
    if (!isThere(entries / name))
      throw Error(Fault::Input, fmt::format("an object without {} cannot be finished", name));
    names.push_back(name);
  });
  if (isThere(entries / kPosterEntry)) names.emplace_back(kPosterEntry);
  std::sort(names.begin(), names.end(), entryNameLess);
  return names;
}

}  // namespace

ObjectWriter::ObjectWriter(fs::path out, ObjectForm form, std::string fingerprint, bool resume,
                           bool force)
    : out_(withoutTrailingSlash(std::move(out))), form_(form), force_(force) {
  checkTarget(out_, force_);
  partial_ = out_;
  partial_ += ".partial";
  journal_.emplace(partial_ / kJournalFile);
  createPartial(fingerprint, resume);
}

void ObjectWriter::createPartial(const std::string& fingerprint, bool resume) {
  const bool existed = isThere(partial_);
  if (existed && !isPartialFolder(partial_))
    throw inputError(partial_, "a folder of an unfinished object", "something else");
  createFolders(partial_);
  try {
    lock();
    const fs::path fingerprintFile = partial_ / kFingerprintFile;
    const bool known = isThere(fingerprintFile);
    if (known && resume) {
      if (readTextFile(fingerprintFile, kMaxFingerprintBytes) != fingerprint)
        throw inputError(partial_, "what an earlier run with the same input and settings left",
                         "that of another input or other settings");
      journal_->removeDoubtful(partial_ / kEntriesFolder);
    } else {
      // The fingerprint goes first and comes last, so that entries never stand under a wrong one.
      removeTree(fingerprintFile);
      removeTree(partial_ / kEntriesFolder);
      removeTree(partial_ / kJournalFile);
      createFolders(partial_ / kEntriesFolder);
      writeFileAtomically(fingerprintFile, fingerprint);
    }
    removeTree(partial_ / kScratchFolder);
    createFolders(partial_ / kScratchFolder);
  } catch (...) {
    // A folder that was there is not this writer's to remove.
    if (lock_ >= 0) ::close(lock_);
    std::error_code ignored;
    if (!existed) fs::remove_all(partial_, ignored);
    throw;
  }
}

void ObjectWriter::lock() {
  const fs::path file = partial_ / kLockFile;
  lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) throw machineError(file, "open", {errno, std::generic_category()});
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error(Fault::Machine,
                fmt::format("{}: another process is writing this object", out_.string()));
}

ObjectWriter::~ObjectWriter() {
  std::error_code ignored;
  const bool worthKeeping = keep_ && !finished_ && holdsFiles(partial_ / kEntriesFolder);
  if (!worthKeeping) fs::remove_all(partial_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

bool ObjectWriter::has(const std::string& entry) const {
  return entryKeyOf(entry) && isThere(partial_ / kEntriesFolder / entry);
}

void ObjectWriter::add(const std::string& entry, std::span<const std::byte> bytes) {
  if (!entryKeyOf(entry))
    throw Error(Fault::Usage, fmt::format("'{}' is not the name of an entry", entry));
  const fs::path file = partial_ / kEntriesFolder / entry;
  try {
    createFolders(file.parent_path());
    writeFileAtomically(file, bytes);
    journal_->note(entry, bytes);
  } catch (const Error&) {
    keep_ = true;
    throw;
  }
}

void ObjectWriter::keepPartial() {
  keep_ = true;
}

fs::path ObjectWriter::scratchFolder() const {
  return partial_ / kScratchFolder;
}

std::uint64_t ObjectWriter::finish() {
  try {
    checkTarget(out_, force_);
    const std::uint64_t bytes = form_ == ObjectForm::Archive ? finishArchive() : finishFolder();
    finished_ = true;
    return bytes;
  } catch (const Error&) {
    keep_ = true;
    throw;
  }
}

std::uint64_t ObjectWriter::finishArchive() {
  const fs::path packed = partial_ / kPackedFile;
  const fs::path entries = partial_ / kEntriesFolder;
  writeArchive(packed, entries, entriesToFinish(entries));
  const std::uint64_t bytes = fs::file_size(packed);
  std::error_code error;
  if (!force_)
    renameToNew(packed, out_);
  else if (fs::is_directory(out_, error))
    exchange(packed, out_, partial_ / kReplacedFolder);
  else
    fs::rename(packed, out_, error);
  if (error) throw machineError(out_, "write", error);
  syncPath(out_.has_parent_path() ? out_.parent_path() : ".");
  return bytes;
}

std::uint64_t ObjectWriter::finishFolder() {
  const fs::path entries = partial_ / kEntriesFolder;
  std::vector<IndexEntry> index;
  std::uint64_t bytes = 0;
  for (const std::string& name : entriesToFinish(entries)) {
    const auto contents = readFile(entries / name, entryLimitBytes(name));
    index.push_back({name, contents.size(), crc32Of(contents)});
    bytes += contents.size();
  }
  const auto indexBytes = encodeIndex(index);
  writeFileAtomically(entries / kIndexFile, indexBytes);
  if (force_ && isThere(out_))
    exchange(entries, out_, partial_ / kReplacedFolder);
  else
    renameToNew(entries, out_);
  syncPath(out_.has_parent_path() ? out_.parent_path() : ".");
  return bytes + indexBytes.size();
}

}  // namespace illum
