// Where an object's bytes come from: an archive or a folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace illum {

/// The entries of one object. Thread safe. Opening takes untrusted input: names are checked, and no
/// entry is larger than what is really there (or, if compressed, than its limit below).
class EntrySource {
 public:
  virtual ~EntrySource() = default;

  /// In canonical order; folders' own marks are left out.
  virtual const std::vector<std::string>& names() const = 0;
  virtual bool has(std::string_view name) const = 0;
  /// Checked against its CRC-32. Throws Error if it is missing, damaged or larger than
  /// `limitBytes`.
  virtual std::vector<std::byte> read(const std::string& name, std::uint64_t limitBytes) const = 0;
  virtual std::uint64_t fileBytes() const = 0;
  /// What is wrong with the container itself, beyond what opening refuses: one sentence each.
  virtual std::vector<std::string> faults() const = 0;
};

std::unique_ptr<EntrySource> openEntrySource(const std::filesystem::path& path);
std::unique_ptr<EntrySource> openArchive(const std::filesystem::path& path);
std::unique_ptr<EntrySource> openFolder(const std::filesystem::path& path);

/// "PATH: ENTRY", how errors name an entry.
std::string sourceName(const std::filesystem::path& path, std::string_view entry);

inline constexpr std::uint64_t kMaxManifestBytes = std::uint64_t{48} << 20;
inline constexpr std::uint64_t kMaxBasisBytes = std::uint64_t{256} << 20;
/// Of a tile or poster: no coding needs more for the largest atlas.
inline constexpr std::uint64_t kMaxTileBytes = std::uint64_t{256} << 20;
/// The limit that holds for the entry of this name.
std::uint64_t entryLimitBytes(std::string_view name);

}  // namespace illum
