#include "object/entry_source.h"

#include <fmt/format.h>

#include <system_error>

#include "illum/error.h"
#include "object/entry_name.h"

namespace illum {

std::string sourceName(const std::filesystem::path& path, std::string_view entry) {
  return fmt::format("{}: {}", path.string(), entry);
}

std::uint64_t entryLimitBytes(std::string_view name) {
  if (name == kManifestEntry) return kMaxManifestBytes;
  if (name == kBasisEntry) return kMaxBasisBytes;
  return kMaxTileBytes;
}

std::unique_ptr<EntrySource> openEntrySource(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw fileError(path, "open", error ? error.value() : ENOENT);
  if (std::filesystem::is_directory(status)) return openFolder(path);
  if (std::filesystem::is_regular_file(status)) return openArchive(path);
  throw inputError(path, "an .illum object", "neither a file nor a folder");
}

}  // namespace illum
