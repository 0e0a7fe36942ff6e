#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <mutex>

#include "illum/error.h"
#include "object/entry_name.h"
#include "object/entry_source.h"

namespace illum {
namespace {

struct ArchiveDeleter {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct FileDeleter {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using ArchivePointer = std::unique_ptr<zip_t, ArchiveDeleter>;
using FilePointer = std::unique_ptr<zip_file_t, FileDeleter>;

/// libzip's opening; the error is empty on success.
ArchivePointer tryOpen(const std::filesystem::path& path, int flags, std::string& error) {
  int code = 0;
  ArchivePointer archive(zip_open(path.c_str(), ZIP_RDONLY | flags, &code));
  if (archive) return archive;
  zip_error_t detail;
  zip_error_init_with_code(&detail, code);
  error = zip_error_strerror(&detail);
  zip_error_fini(&detail);
  return nullptr;
}

struct ArchiveEntry {
  zip_uint64_t index = 0;
  std::uint64_t size = 0;
};

class ArchiveSource final : public EntrySource {
 public:
  explicit ArchiveSource(const std::filesystem::path& path)
      : path_(path), fileBytes_(std::filesystem::file_size(path)) {
    std::string error;
    archive_ = tryOpen(path, 0, error);
    if (!archive_) throw inputError(path, "a zip archive", fmt::format("none ({})", error));
    const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) addEntry(static_cast<zip_uint64_t>(i));
    for (const auto& [name, entry] : entries_) names_.push_back(name);
    std::sort(names_.begin(), names_.end(), entryNameLess);
  }

  const std::vector<std::string>& names() const override { return names_; }
  bool has(std::string_view name) const override { return entries_.contains(name); }
  std::uint64_t fileBytes() const override { return fileBytes_; }

  std::vector<std::byte> read(const std::string& name, std::uint64_t limitBytes) const override {
    const auto found = entries_.find(name);
    if (found == entries_.end())
      throw Error(Fault::Input, fmt::format("{} is missing", sourceName(path_, name)));
    const ArchiveEntry& entry = found->second;
    if (entry.size > limitBytes)
      throw inputError(sourceName(path_, name), fmt::format("at most {} bytes", limitBytes),
                       fmt::format("{}", entry.size));
    // A libzip handle serves one thread at a time. What is done under the lock is copying and a
    // checksum, a hundredth of what decoding the same tile takes.
    const std::lock_guard lock(mutex_);
    return readLocked(name, entry);
  }

  /// Compares every local header with the directory, which opening leaves out because it touches
  /// the whole file.
  std::vector<std::string> faults() const override {
    std::string error;
    if (tryOpen(path_, ZIP_CHECKCONS, error)) return {};
    return {fmt::format("{}: the archive contradicts itself ({})", path_.string(), error)};
  }

 private:
  void addEntry(zip_uint64_t index) {
    zip_stat_t status;
    const char* raw = zip_get_name(archive_.get(), index, ZIP_FL_ENC_RAW);
    if (raw == nullptr || zip_stat_index(archive_.get(), index, 0, &status) != 0)
      throw inputError(path_, "a readable archive directory",
                       fmt::format("a damaged entry {}", index));
    const std::string name = raw;
    if (!isSafeEntryName(name))
      throw inputError(path_, "entry names that stay inside the object",
                       fmt::format("a name that does not, of entry {}", index));
    if (name.back() == '/') return;
    if (entryKeyOf(name)) checkStorage(name, status);
    if (!entries_.emplace(name, ArchiveEntry{index, status.size}).second)
      throw inputError(path_, "every entry once", fmt::format("'{}' twice", name));
  }

  void checkStorage(const std::string& name, const zip_stat_t& status) const {
    constexpr zip_uint64_t kNeeded =
        ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    const bool stored = status.comp_method == ZIP_CM_STORE;
    const bool deflated = status.comp_method == ZIP_CM_DEFLATE && mayBeDeflated(name);
    if ((status.valid & kNeeded) != kNeeded || status.encryption_method != ZIP_EM_NONE ||
        !(stored || deflated))
      throw inputError(sourceName(path_, name),
                       mayBeDeflated(name) ? "a stored or deflated entry" : "a stored entry",
                       fmt::format("compression method {}{}", status.comp_method,
                                   status.encryption_method != ZIP_EM_NONE ? ", encrypted" : ""));
    if (status.comp_size > fileBytes_ || (stored && status.size != status.comp_size))
      throw inputError(sourceName(path_, name), "a size that the archive can hold",
                       fmt::format("{} bytes", std::max(status.size, status.comp_size)));
    if (status.size > entryLimitBytes(name))
      throw inputError(sourceName(path_, name),
                       fmt::format("at most {} bytes", entryLimitBytes(name)),
                       fmt::format("{}", status.size));
  }

  std::vector<std::byte> readLocked(const std::string& name, const ArchiveEntry& entry) const {
    const FilePointer file(zip_fopen_index(archive_.get(), entry.index, 0));
    if (!file)
      throw Error(Fault::Input, fmt::format("{} cannot be read ({})", sourceName(path_, name),
                                            zip_strerror(archive_.get())));
    std::vector<std::byte> bytes(entry.size);
    std::uint64_t filled = 0;
    while (filled < entry.size) {
      const zip_int64_t got = zip_fread(file.get(), bytes.data() + filled, entry.size - filled);
      if (got <= 0) throw damaged(name, got < 0 ? zip_file_strerror(file.get()) : "it ends early");
      filled += static_cast<std::uint64_t>(got);
    }
    // Only the read that meets the end compares the checksum.
    std::byte beyond;
    const zip_int64_t got = zip_fread(file.get(), &beyond, 1);
    if (got != 0) throw damaged(name, got < 0 ? zip_file_strerror(file.get()) : "it goes on");
    return bytes;
  }

  Error damaged(const std::string& name, const char* how) const {
    return {Fault::Input, fmt::format("{} is damaged ({})", sourceName(path_, name), how)};
  }

  std::filesystem::path path_;
  std::uint64_t fileBytes_ = 0;
  ArchivePointer archive_;
  std::map<std::string, ArchiveEntry, std::less<>> entries_;
  std::vector<std::string> names_;
  mutable std::mutex mutex_;
};

}  // namespace

std::unique_ptr<EntrySource> openArchive(const std::filesystem::path& path) {
  return std::make_unique<ArchiveSource>(path);
}

}  // namespace illum
