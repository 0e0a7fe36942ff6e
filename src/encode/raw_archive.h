// Zip archives built byte by byte, so that tests can make every lie that a real packer would not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace illum {

struct RawEntry {
  std::string name;
  std::vector<std::byte> data;           ///< as it stands in the archive
  std::uint16_t method = 0;              ///< 0 stored, 8 deflated
  std::uint16_t flags = 0;               ///< bit 0: encrypted
  std::uint32_t crc32 = 0;               ///< of the contents
  std::uint32_t size = 0;                ///< of the contents, as declared
  std::optional<std::string> localName;  ///< in the local header, where it differs
};

/// Stored, with everything right.
RawEntry storedEntry(std::string name, std::span<const std::byte> contents);
/// Deflated, with everything right.
RawEntry deflatedEntry(std::string name, std::span<const std::byte> contents);

std::vector<std::byte> rawArchive(std::span<const RawEntry> entries);

}  // namespace illum
