#include "encode/entry_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <system_error>
#include <vector>

#include "core/files.h"
#include "illum/error.h"
#include "object/entry_name.h"
#include "object/entry_source.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxJournalBytes = std::uint64_t{1} << 30;

std::string lineFor(const std::string& entry, std::span<const std::byte> bytes) {
  return fmt::format("{:08x} {} {}\n", crc32Of(bytes), bytes.size(), entry);
}

/// The last line of each entry; what follows the last line's end is not one.
std::map<std::string, std::string> linesOf(const fs::path& file) {
  std::map<std::string, std::string> lines;
  std::error_code error;
  if (!fs::exists(file, error)) return lines;
  const std::string text = readTextFile(file, kMaxJournalBytes);
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    const std::string line = text.substr(begin, end + 1 - begin);
    const std::size_t name = line.find(' ', line.find(' ') + 1);
    if (name == std::string::npos) continue;
    lines[line.substr(name + 1, line.size() - name - 2)] = line;
  }
  return lines;
}

}  // namespace

void EntryJournal::note(const std::string& entry, std::span<const std::byte> bytes) {
  const std::string line = lineFor(entry, bytes);
  const std::scoped_lock lock(mutex_);
  const int file = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const auto written = file < 0 ? -1 : ::write(file, line.data(), line.size());
  const int error = errno;
  if (file >= 0) ::close(file);
  if (written != static_cast<ssize_t>(line.size()))
    throw Error(Fault::Machine,
                fmt::format("{}: cannot write: {}", file_.string(),
                            std::generic_category().message(written < 0 ? error : ENOSPC)));
}

void EntryJournal::removeDoubtful(const fs::path& entries) const {
  const auto lines = linesOf(file_);
  std::vector<fs::path> doubtful;
  std::error_code error;
  for (fs::recursive_directory_iterator at(entries, error), end; !error && at != end;
       at.increment(error)) {
    if (at->is_directory(error)) continue;
    const std::string name = at->path().lexically_relative(entries).generic_string();
    const auto known = lines.find(name);
    if (known == lines.end() ||
        lineFor(name, readFile(at->path(), entryLimitBytes(name))) != known->second)
      doubtful.push_back(at->path());
  }
  for (const fs::path& file : doubtful) fs::remove(file, error);
  if (error)
    throw Error(Fault::Machine,
                fmt::format("{}: cannot look through: {}", entries.string(), error.message()));
}

}  // namespace illum
