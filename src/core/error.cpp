#include "illum/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace illum {

Error inputError(const std::filesystem::path& file, std::string_view expected,
                 std::string_view found) {
  return {Fault::Input, fmt::format("{}: expected {}, found {}", file.string(), expected, found)};
}

Error fileError(const std::filesystem::path& file, std::string_view action, int errnoValue) {
  const bool namedWrongly = errnoValue == ENOENT || errnoValue == ENOTDIR || errnoValue == EISDIR ||
                            errnoValue == ENAMETOOLONG || errnoValue == ELOOP;
  return {namedWrongly ? Fault::Input : Fault::Machine,
          fmt::format("{}: cannot {}: {}", file.string(), action,
                      std::generic_category().message(errnoValue))};
}

}  // namespace illum
