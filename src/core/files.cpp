#include "core/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>

#include "illum/error.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int get() const { return value_; }

 private:
  int value_;
};

Error tooLarge(const fs::path& file, std::uint64_t limitBytes) {
  return inputError(file, fmt::format("at most {} bytes", limitBytes), "a larger file");
}

/// What fstat says is where reading starts from; pipes and files that grow are read to their end.
template <typename Buffer>
Buffer readWhole(const fs::path& file, std::uint64_t limitBytes) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.get() < 0) throw fileError(file, "open", errno);
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) throw fileError(file, "read", errno);
  if (S_ISDIR(status.st_mode)) throw fileError(file, "read", EISDIR);
  const auto expected = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  if (expected > limitBytes) throw tooLarge(file, limitBytes);

  constexpr std::uint64_t kStep = 64 * 1024;
  Buffer buffer;
  buffer.resize(expected + 1);  // one more, so that the end is seen without another allocation
  std::uint64_t filled = 0;
  for (;;) {
    if (filled > limitBytes) throw tooLarge(file, limitBytes);
    if (filled == buffer.size()) buffer.resize(filled + std::max(filled / 2, kStep));
    const ssize_t got = ::read(descriptor.get(), buffer.data() + filled, buffer.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw fileError(file, "read", errno);
    if (got == 0) break;
    filled += static_cast<std::uint64_t>(got);
  }
  buffer.resize(filled);
  return buffer;
}

/// Writing to a place that does not exist is the machine's fault here, unlike reading from one: the
/// input was fine.
Error writeError(const fs::path& file, int errnoValue) {
  return {Fault::Machine, fmt::format("{}: cannot write: {}", file.string(),
                                      std::generic_category().message(errnoValue))};
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// 0, or why `file` cannot be flushed. Some file systems know no flushing of folders.
int flushErrno(const fs::path& path) {
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.get() < 0) return errno;
  if (::fsync(descriptor.get()) == 0 || errno == EINVAL || errno == ENOTSUP) return 0;
  return errno;
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& file, std::uint64_t limitBytes) {
  return readWhole<std::vector<std::byte>>(file, limitBytes);
}

std::string readTextFile(const fs::path& file, std::uint64_t limitBytes) {
  return readWhole<std::string>(file, limitBytes);
}

AtomicFile::AtomicFile(const fs::path& target) : target_(target), resolved_(target) {
  if (target.empty() || !target.has_filename()) fail(target.empty() ? ENOENT : EISDIR);
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode))
    throw Error(Fault::Machine,
                fmt::format("{}: cannot write: not an ordinary file", target.string()));
  // Renaming would also replace a file that is marked read-only, which its user hardly wants.
  if (exists && ::access(target.c_str(), W_OK) != 0) fail(errno);
  if (exists) {
    std::error_code unresolved;
    const fs::path followed = fs::canonical(target, unresolved);
    if (!unresolved) resolved_ = followed;
  }
  createTemporary();
  if (exists) ::fchmod(descriptor_, status.st_mode & 0777);
}

void AtomicFile::createTemporary() {
  // Process and counter keep names apart; a name left by a killed process is passed over.
  static std::atomic<unsigned> counter{0};
  do {
    temporary_ = folderOf(resolved_) / fmt::format(".illum-{}-{}.tmp", ::getpid(), counter++);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ >= 0) return;
  const int reason = errno;
  temporary_.clear();
  fail(reason);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(int errnoValue) const {
  throw writeError(target_, errnoValue);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (::fsync(descriptor_) != 0) fail(errno);
  // Network file systems report a full disk only here.
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail(errno);
  if (::rename(temporary_.c_str(), resolved_.c_str()) != 0) fail(errno);
  temporary_.clear();
  if (const int reason = flushErrno(folderOf(resolved_)); reason != 0) fail(reason);
}

void writeFileAtomically(const fs::path& file, std::span<const std::byte> bytes) {
  AtomicFile writing(file);
  writing.write(bytes);
  writing.commit();
}

void writeFileAtomically(const fs::path& file, std::string_view text) {
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void syncPath(const fs::path& path) {
  if (const int reason = flushErrno(path); reason != 0) throw writeError(path, reason);
}

}  // namespace illum
