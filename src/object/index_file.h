// index.bin: size and checksum of every entry of an object's folder form (docs/format.md,
// "index.bin").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace illum {

struct IndexEntry {
  std::string name;
  std::uint64_t size = 0;
  std::uint32_t crc32 = 0;
  friend bool operator==(const IndexEntry&, const IndexEntry&) = default;
};

/// `entries` in canonical order, with safe names.
std::vector<std::byte> encodeIndex(std::span<const IndexEntry> entries);

/// Untrusted input is safe: magic, version, checksum, names (safe, in strictly rising canonical
/// order) are checked. Throws Error that begins with `source`.
std::vector<IndexEntry> decodeIndex(std::span<const std::byte> bytes, const std::string& source);

/// No index.bin may be larger.
inline constexpr std::uint64_t kMaxIndexBytes = std::uint64_t{1} << 30;

}  // namespace illum
