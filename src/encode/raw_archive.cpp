#include "encode/raw_archive.h"

#include <zlib.h>

#include <stdexcept>

#include "core/files.h"

namespace illum {
namespace {

class Bytes {
 public:
  void put(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i)
      bytes_.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
  }
  void put(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) bytes_.push_back(b);
  }
  void put(const std::string& text) { put(std::as_bytes(std::span(text))); }
  std::size_t size() const { return bytes_.size(); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// What local header and directory share, from "version needed" to the length of the name.
void putCommon(Bytes& out, const RawEntry& entry, std::size_t nameLength) {
  constexpr std::uint64_t kVersionNeeded = 20, kTime = 0, kDate1980 = 0x21;
  out.put(kVersionNeeded, 2);
  out.put(entry.flags, 2);
  out.put(entry.method, 2);
  out.put(kTime, 2);
  out.put(kDate1980, 2);
  out.put(entry.crc32, 4);
  out.put(entry.data.size(), 4);
  out.put(entry.size, 4);
  out.put(nameLength, 2);
  out.put(0, 2);  // extra field
}

}  // namespace

RawEntry storedEntry(std::string name, std::span<const std::byte> contents) {
  return {std::move(name),   {contents.begin(), contents.end()},          0,           0,
          crc32Of(contents), static_cast<std::uint32_t>(contents.size()), std::nullopt};
}

RawEntry deflatedEntry(std::string name, std::span<const std::byte> contents) {
  z_stream stream{};
  if (deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("deflateInit2");
  std::vector<std::byte> data(deflateBound(&stream, contents.size()));
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(contents.data()));
  stream.avail_in = static_cast<uInt>(contents.size());
  stream.next_out = reinterpret_cast<Bytef*>(data.data());
  stream.avail_out = static_cast<uInt>(data.size());
  deflate(&stream, Z_FINISH);
  data.resize(stream.total_out);
  deflateEnd(&stream);
  RawEntry entry = storedEntry(std::move(name), contents);
  entry.data = std::move(data);
  entry.method = 8;
  return entry;
}

// APPNOTE.TXT 6.3, sections 4.3.7, 4.3.12, 4.3.16.
std::vector<std::byte> rawArchive(std::span<const RawEntry> entries) {
  Bytes out, directory;
  for (const RawEntry& entry : entries) {
    directory.put(0x02014b50, 4);
    directory.put(20, 2);  // made by
    putCommon(directory, entry, entry.name.size());
    directory.put(0, 2 + 2 + 2);  // comment, disk, internal attributes
    directory.put(0, 4);          // external attributes
    directory.put(out.size(), 4);
    directory.put(entry.name);

    const std::string localName = entry.localName.value_or(entry.name);
    out.put(0x04034b50, 4);
    putCommon(out, entry, localName.size());
    out.put(localName);
    out.put(entry.data);
  }
  const std::size_t start = out.size(), length = directory.size();
  out.put(directory.take());
  out.put(0x06054b50, 4);
  out.put(0, 4);  // disks
  out.put(entries.size(), 2);
  out.put(entries.size(), 2);
  out.put(length, 4);
  out.put(start, 4);
  out.put(0, 2);  // comment
  return out.take();
}

}  // namespace illum
