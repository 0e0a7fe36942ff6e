#include "encode/archive_writer.h"

#include <fmt/format.h>
#include <zip.h>

#include <memory>

#include "core/files.h"
#include "illum/error.h"
#include "object/entry_name.h"

namespace illum {
namespace {

constexpr zip_uint16_t kDosTime = 0;                    // 00:00:00
constexpr zip_uint16_t kDosDate = 0 << 9 | 1 << 5 | 1;  // 1980-01-01
constexpr zip_uint32_t kDeflateLevel = 9;
constexpr zip_uint32_t kAttributes = (0100644u << 16);  // an ordinary file, rw-r--r--

struct ArchiveDeleter {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using ArchivePointer = std::unique_ptr<zip_t, ArchiveDeleter>;

Error cannotWrite(const std::filesystem::path& archive, zip_error_t* error) {
  return {Fault::Machine,
          fmt::format("{}: cannot write: {}", archive.string(), zip_error_strerror(error))};
}

ArchivePointer createArchive(const std::filesystem::path& archive) {
  int code = 0;
  ArchivePointer created(zip_open(archive.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (created) return created;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const Error failure = cannotWrite(archive, &error);
  zip_error_fini(&error);
  throw failure;
}

/// libzip opens the file only while it writes the archive, so their number is not limited.
bool addFile(zip_t* archive, const std::filesystem::path& file, const std::string& name) {
  zip_source_t* source = zip_source_file(archive, file.c_str(), 0, -1);
  if (source == nullptr) return false;
  const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    return false;
  }
  const auto at = static_cast<zip_uint64_t>(index);
  const bool deflated = name == kManifestEntry;
  return zip_set_file_compression(archive, at, deflated ? ZIP_CM_DEFLATE : ZIP_CM_STORE,
                                  deflated ? kDeflateLevel : 0) == 0 &&
         zip_file_set_dostime(archive, at, kDosTime, kDosDate, 0) == 0 &&
         zip_file_set_external_attributes(archive, at, 0, ZIP_OPSYS_UNIX, kAttributes) == 0;
}

}  // namespace

void writeArchive(const std::filesystem::path& archive, const std::filesystem::path& folder,
                  std::span<const std::string> names) {
  ArchivePointer writing = createArchive(archive);
  for (const std::string& name : names)
    if (!addFile(writing.get(), folder / name, name))
      throw cannotWrite(archive, zip_get_error(writing.get()));
  if (zip_close(writing.get()) != 0) throw cannotWrite(archive, zip_get_error(writing.get()));
  static_cast<void>(writing.release());  // closing has freed it
  syncPath(archive);
}

}  // namespace illum
