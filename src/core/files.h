// Files: whole reads with a limit, atomic replacement, checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace illum {

/// The whole file. Throws Error if it is missing, a folder, unreadable, or larger than `limitBytes`
/// (checked before memory is allocated).
std::vector<std::byte> readFile(const std::filesystem::path& file, std::uint64_t limitBytes);
std::string readTextFile(const std::filesystem::path& file, std::uint64_t limitBytes);

/// Replaces `file` by `bytes` atomically: a temporary beside it, fsync, rename, fsync of the folder.
/// On failure (disk full, no permission) nothing of it remains and the old file stays.
void writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& file, std::string_view text);

/// CRC-32 as in zip and PNG (reflected 0xEDB88320). `crc` continues a running value.
std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t crc = 0);

/// fsync of a file or folder by name; throws Error (Fault::Machine).
void syncPath(const std::filesystem::path& path);

}  // namespace illum
