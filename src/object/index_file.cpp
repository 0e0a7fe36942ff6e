#include "object/index_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/files.h"
#include "illum/error.h"
#include "object/entry_name.h"

namespace illum {
namespace {

constexpr std::string_view kMagic = "ILLUMIDX";
constexpr std::uint32_t kVersion = 1;

template <typename Integer>
void put(std::vector<std::byte>& out, Integer value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    out.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
}

void put(std::vector<std::byte>& out, std::string_view text) {
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

/// Takes little-endian values from the front of a buffer that may end at any place.
class Cursor {
 public:
  Cursor(std::span<const std::byte> rest, const std::string& source)
      : rest_(rest), source_(source) {}

  template <typename Integer>
  Integer take() {
    const auto bytes = takeBytes(sizeof(Integer));
    Integer value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i)
      value = static_cast<Integer>(value | static_cast<Integer>(bytes[i]) << (8 * i));
    return value;
  }

  std::string takeText(std::size_t count) {
    const auto bytes = takeBytes(count);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  std::span<const std::byte> rest() const { return rest_; }

 private:
  std::span<const std::byte> takeBytes(std::size_t count) {
    if (count > rest_.size())
      throw Error(Fault::Input, fmt::format("{}: the index ends too early", source_));
    const auto bytes = rest_.first(count);
    rest_ = rest_.subspan(count);
    return bytes;
  }

  std::span<const std::byte> rest_;
  const std::string& source_;
};

void checkHeader(Cursor& cursor, const std::string& source) {
  if (cursor.takeText(kMagic.size()) != kMagic)
    throw Error(Fault::Input,
                fmt::format("{}: expected an index that begins with {}, found another kind of file",
                            source, kMagic));
  const auto version = cursor.take<std::uint32_t>();
  if (version != kVersion)
    throw Error(Fault::Input, fmt::format("{}: expected an index of version {}, found version {}",
                                          source, kVersion, version));
}

}  // namespace

std::vector<std::byte> encodeIndex(std::span<const IndexEntry> entries) {
  std::vector<std::byte> body;
  for (const IndexEntry& entry : entries) {
    put(body, static_cast<std::uint16_t>(entry.name.size()));
    put(body, std::string_view(entry.name));
    put(body, entry.size);
    put(body, entry.crc32);
  }
  std::vector<std::byte> out;
  put(out, kMagic);
  put(out, kVersion);
  put(out, static_cast<std::uint32_t>(entries.size()));
  put(out, crc32Of(body));
  out.insert(out.end(), body.begin(), body.end());
  return out;
}

std::vector<IndexEntry> decodeIndex(std::span<const std::byte> bytes, const std::string& source) {
  Cursor cursor(bytes, source);
  checkHeader(cursor, source);
  const auto count = cursor.take<std::uint32_t>();
  const auto checksum = cursor.take<std::uint32_t>();
  if (crc32Of(cursor.rest()) != checksum)
    throw Error(Fault::Input, fmt::format("{}: the index is damaged (CRC-32 differs)", source));

  std::vector<IndexEntry> entries;  // grows with what is there, not with what `count` says
  for (std::uint32_t i = 0; i < count; ++i) {
    IndexEntry entry;
    entry.name = cursor.takeText(cursor.take<std::uint16_t>());
    entry.size = cursor.take<std::uint64_t>();
    entry.crc32 = cursor.take<std::uint32_t>();
    if (!isSafeEntryName(entry.name) || entry.name.back() == '/')
      throw Error(Fault::Input,
                  fmt::format("{}: entry {} has a name that is not allowed", source, i));
    if (!entries.empty() && !entryNameLess(entries.back().name, entry.name))
      throw Error(Fault::Input, fmt::format("{}: entry {} is out of order or repeated", source, i));
    entries.push_back(std::move(entry));
  }
  if (!cursor.rest().empty())
    throw Error(Fault::Input, fmt::format("{}: expected {} entries and nothing more, found {} "
                                          "bytes after them",
                                          source, count, cursor.rest().size()));
  return entries;
}

}  // namespace illum
