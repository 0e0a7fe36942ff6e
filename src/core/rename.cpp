#include "core/rename.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "illum/error.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

Error machineError(const fs::path& path, const char* action, const std::error_code& error) {
  return {Fault::Machine, fmt::format("{}: cannot {}: {}", path.string(), action, error.message())};
}

}  // namespace

void renameToNew(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno == EINVAL || errno == ENOSYS) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(to, error)))
      errno = EEXIST;
    else if (::rename(from.c_str(), to.c_str()) == 0)
      return;
  }
  if (errno == EEXIST) throw inputError(to, "no file there yet (--force replaces it)", "one");
  throw machineError(to, "write", {errno, std::generic_category()});
}

void exchange(const fs::path& from, const fs::path& to, const fs::path& aside) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS)
    throw machineError(to, "replace", {errno, std::generic_category()});
  std::error_code error;
  fs::rename(to, aside, error);
  if (!error) fs::rename(from, to, error);
  if (error) throw machineError(to, "replace", error);
}

}  // namespace illum
