#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <system_error>

#include "core/files.h"
#include "illum/error.h"
#include "object/entry_name.h"
#include "object/entry_source.h"
#include "object/index_file.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

class FolderSource final : public EntrySource {
 public:
  explicit FolderSource(const fs::path& path) : path_(path) {
    const fs::path index = path / kIndexFile;
    std::error_code error;
    if (!fs::exists(index, error))
      throw inputError(path, "an .illum object", fmt::format("a folder without {}", kIndexFile));
    const auto bytes = readFile(index, kMaxIndexBytes);
    entries_ = decodeIndex(bytes, index.string());
    fileBytes_ = bytes.size();
    for (const IndexEntry& entry : entries_) {
      names_.push_back(entry.name);
      fileBytes_ += entry.size;
    }
  }

  const std::vector<std::string>& names() const override { return names_; }
  bool has(std::string_view name) const override { return find(name) != nullptr; }
  std::uint64_t fileBytes() const override { return fileBytes_; }

  std::vector<std::byte> read(const std::string& name, std::uint64_t limitBytes) const override {
    const IndexEntry* entry = find(name);
    if (entry == nullptr)
      throw Error(Fault::Input, fmt::format("{} is missing", sourceName(path_, name)));
    if (entry->size > limitBytes)
      throw inputError(sourceName(path_, name), fmt::format("at most {} bytes", limitBytes),
                       fmt::format("{}", entry->size));
    const fs::path file = path_ / name;
    checkOrdinary(file, entry->size);
    std::vector<std::byte> bytes;
    if (fs::file_size(file) == entry->size) bytes = readFile(file, entry->size);
    if (bytes.size() != entry->size || crc32Of(bytes) != entry->crc32)
      throw Error(Fault::Input, fmt::format("{} is damaged (it differs from what {} says)",
                                            file.string(), kIndexFile));
    return bytes;
  }

  /// Files that the index does not know.
  std::vector<std::string> faults() const override {
    std::vector<std::string> faults;
    std::error_code error;
    for (fs::recursive_directory_iterator at(path_, error), end; !error && at != end;
         at.increment(error)) {
      if (at->is_directory(error)) continue;
      const std::string name = at->path().lexically_relative(path_).generic_string();
      if (name != kIndexFile && !has(name))
        faults.push_back(fmt::format("{}: '{}' is not in {}", path_.string(), name, kIndexFile));
    }
    if (error)
      faults.push_back(
          fmt::format("{}: cannot list the folder: {}", path_.string(), error.message()));
    std::sort(faults.begin(), faults.end());
    return faults;
  }

 private:
  /// Devices and pipes would block or never end.
  void checkOrdinary(const fs::path& file, std::uint64_t size) const {
    std::error_code error;
    const auto status = fs::status(file, error);
    if (!fs::exists(status)) throw fileError(file, "open", error ? error.value() : ENOENT);
    if (!fs::is_regular_file(status))
      throw inputError(file, fmt::format("a file of {} bytes", size), "no ordinary file");
  }

  const IndexEntry* find(std::string_view name) const {
    const auto found = std::lower_bound(
        entries_.begin(), entries_.end(), name,
        [](const IndexEntry& entry, std::string_view n) { return entryNameLess(entry.name, n); });
    return found != entries_.end() && found->name == name ? &*found : nullptr;
  }

  fs::path path_;
  std::uint64_t fileBytes_ = 0;
  std::vector<IndexEntry> entries_;
  std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<EntrySource> openFolder(const std::filesystem::path& path) {
  return std::make_unique<FolderSource>(path);
}

}  // namespace illum
