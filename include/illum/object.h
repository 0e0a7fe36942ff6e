// Reading an .illum object: a zip archive, or the same tree as a folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "illum/basis_table.h"
#include "illum/picture.h"

namespace illum {

struct Manifest;  // src/object/manifest.h; what of it matters to users is repeated as members below
struct PlaneCodes;  // src/codec/tile.h

/// An opened object. Cheap to copy; reading is thread safe.
class Object {
 public:
  /// Opens a zip archive or a folder. Untrusted input is safe. Throws Error.
  static Object open(const std::filesystem::path& path);

  const std::filesystem::path& path() const;
  const Manifest& manifest() const;
  Size size() const;
  int planes() const;
  const LightBasis& basis(int group) const;
  std::uint64_t fileBytes() const;  ///< of the archive, or the sum of the folder's files

  /// Names of all entries in canonical order.
  std::vector<std::string> entries() const;
  /// One entry, checked against its CRC-32.
  std::vector<std::byte> entry(const std::string& name) const;
  /// Decoded codes of one tile.
  PlaneCodes planeTile(int group, int level, int x, int y) const;
  /// 8-bit coverage of one tile; empty if the object has no mask.
  BytePicture maskTile(int group, int level, int x, int y) const;
  /// What is wrong with the archive or folder itself, beyond what open() refuses: one sentence
  /// each.
  std::vector<std::string> containerFaults() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// Checks every byte of an object: archive structure, every CRC, every tile decoded, nothing
/// missing and nothing unknown. Returns the faults found, one sentence each; empty = sound. Throws
/// Error only if the object cannot be opened at all.
std::vector<std::string> verifyObject(const std::filesystem::path& path);

}  // namespace illum
