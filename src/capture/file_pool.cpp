#include "capture/file_pool.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <mutex>

#include "illum/error.h"

namespace illum {
namespace {

// Left to libraries, the terminal, the output and its temporaries.
constexpr std::size_t kFilesForOthers = 64;

std::size_t openFileLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 256;
  if (limit.rlim_cur < limit.rlim_max) {
    rlimit raised{limit.rlim_max, limit.rlim_max};
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  }
  const auto files = static_cast<std::size_t>(std::min<rlim_t>(limit.rlim_cur, 1 << 20));
  return files > 2 * kFilesForOthers ? files - kFilesForOthers
                                     : std::max<std::size_t>(1, files / 2);
}

struct PooledFile {
  std::filesystem::path path;
  struct stat identity {};
  int descriptor = -1;
  int readers = 0;
  std::uint64_t lastUse = 0;
};

bool sameFile(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size &&
         a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

}  // namespace

struct FilePool::State {
  std::size_t limit = 0;
  mutable std::mutex mutex;
  std::deque<PooledFile> files;  // a deque, so that references stay valid while files are added
  std::size_t open = 0;
  std::uint64_t clock = 0;

  // False if none can be closed.
  bool closeLeastRecentlyUsed() {
    PooledFile* oldest = nullptr;
    for (PooledFile& file : files) {
      if (file.descriptor < 0 || file.readers > 0) continue;
      if (oldest == nullptr || file.lastUse < oldest->lastUse) oldest = &file;
    }
    if (oldest == nullptr) return false;
    ::close(oldest->descriptor);
    oldest->descriptor = -1;
    --open;
    return true;
  }

  int openForReading(const std::filesystem::path& path, struct stat& identity) {
    if (open >= limit) closeLeastRecentlyUsed();
    // Not blocking: a pipe under a photograph's name must not hang the program.
    int descriptor = -1;
    do {
      descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    } while (descriptor < 0 && (errno == EMFILE || errno == ENFILE) && closeLeastRecentlyUsed());
    if (descriptor < 0) throw fileError(path, "open the photograph", errno);
    if (fstat(descriptor, &identity) != 0 || !S_ISREG(identity.st_mode)) {
      ::close(descriptor);
      throw inputError(path, "a photograph", "something that is not a file");
    }
    return descriptor;
  }

  void reopen(PooledFile& file) {
    struct stat found {};
    const int descriptor = openForReading(file.path, found);
    if (!sameFile(found, file.identity)) {
      ::close(descriptor);
      throw inputError(file.path, "the photograph that was there at the beginning",
                       "a file that has changed since");
    }
    file.descriptor = descriptor;
    ++open;
  }
};

FilePool::FilePool(std::size_t limit) : state_(std::make_unique<State>()) {
  state_->limit = limit > 0 ? limit : openFileLimit();
}

FilePool::~FilePool() {
  for (const PooledFile& file : state_->files) {
    if (file.descriptor >= 0) ::close(file.descriptor);
  }
}

std::size_t FilePool::add(const std::filesystem::path& path) {
  const std::lock_guard lock(state_->mutex);
  PooledFile file;
  file.path = path;
  file.descriptor = state_->openForReading(path, file.identity);
  file.lastUse = ++state_->clock;
  state_->files.push_back(std::move(file));
  ++state_->open;
  return state_->files.size() - 1;
}

const std::filesystem::path& FilePool::path(std::size_t file) const {
  const std::lock_guard lock(state_->mutex);
  return state_->files[file].path;
}

std::uint64_t FilePool::bytes(std::size_t file) const {
  const std::lock_guard lock(state_->mutex);
  return static_cast<std::uint64_t>(state_->files[file].identity.st_size);
}

std::size_t FilePool::openFiles() const {
  const std::lock_guard lock(state_->mutex);
  return state_->open;
}

std::size_t FilePool::read(std::size_t number, std::uint64_t offset, std::span<std::byte> buffer) {
  std::unique_lock lock(state_->mutex);
  PooledFile& file = state_->files[number];
  if (file.descriptor < 0) state_->reopen(file);
  file.lastUse = ++state_->clock;
  ++file.readers;
  lock.unlock();

  std::size_t done = 0;
  int fault = 0;
  while (done < buffer.size() && fault == 0) {
    const ssize_t got = ::pread(file.descriptor, buffer.data() + done, buffer.size() - done,
                                static_cast<off_t>(offset + done));
    if (got == 0) break;
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (errno != EINTR) {
      fault = errno;
    }
  }

  lock.lock();
  --file.readers;
  if (fault != 0) throw fileError(file.path, "read the photograph", fault);
  return done;
}

}  // namespace illum
