// The whole reader: opens, verifies and decodes what the bytes say. An input that begins like a zip
// file is taken as it is; any other is a list of entries from which a sound archive is made,
// because random changes of an archive seldom get past its checksums.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "codec/tile.h"
#include "encode/raw_archive.h"
#include "illum/error.h"
#include "illum/object.h"

namespace {

/// A file in memory, one for the whole process.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("object", 0)) {
    if (descriptor_ < 0) std::abort();
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  }
  void fill(std::span<const std::byte> bytes) const {
    if (::ftruncate(descriptor_, 0) != 0 ||
        ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      std::abort();
  }
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

constexpr std::array<const char*, 9> kNames{
    "object.json",         "basis.bin",          "planes/0/0/0_0.png",
    "planes/0/0/0_0.avif", "planes/0/0/0_0.jpg", "mask/0/0/0_0.png",
    "poster.jpg",          "planes/0/0/1_0.png", "depth/0/0/0_0.png"};

/// Entries of one byte for the name, two for the length (low first), then the contents.
std::vector<std::byte> archiveOf(std::span<const std::byte> bytes) {
  std::vector<illum::RawEntry> entries;
  while (bytes.size() >= 3) {
    const auto name = std::to_integer<std::size_t>(bytes[0]) % kNames.size();
    const std::size_t length =
        std::to_integer<std::size_t>(bytes[1]) | std::to_integer<std::size_t>(bytes[2]) << 8;
    bytes = bytes.subspan(3);
    const auto contents = bytes.first(std::min(length, bytes.size()));
    bytes = bytes.subspan(contents.size());
    entries.push_back(illum::storedEntry(kNames[name], contents));
  }
  return illum::rawArchive(entries);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  const bool isArchive = size >= 2 && data[0] == 'P' && data[1] == 'K';
  if (isArchive)
    file.fill(bytes);
  else
    file.fill(archiveOf(bytes));
  try {
    illum::verifyObject(file.path());
    const illum::Object object = illum::Object::open(file.path());
    std::vector<float> values(object.basis(0).evaluateSize());
    object.basis(0).evaluate({}, values);
    object.maskTile(0, 0, 0, 0);
    object.planeTile(0, 0, 0, 0);
    object.depthTile(0, 0, 0, 0);
  } catch (const illum::Error&) {
  }
  return 0;
}
