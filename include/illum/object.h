// Reading an .illum object: a zip archive, or the same tree as a folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "illum/basis_table.h"
#include "illum/camera.h"
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

  /// Groups of views, each of one view; at least one.
  int groups() const;
  const View& view(int group) const;
  Size size(int group = 0) const;
  /// Level l is half as large as level l - 1; 1 where the view fits one tile.
  int levels(int group = 0) const;
  int planes(int group = 0) const;
  /// Looked up in the frame of the group: R^-1 w of a direction w in the object frame
  /// (camera.h, objectFromGroup).
  const LightBasis& basis(int group) const;
  bool hasMask() const;
  bool hasDepth(int group = 0) const;
  std::uint64_t fileBytes() const;  ///< of the archive, or the sum of the folder's files

  /// Names of all entries in canonical order.
  std::vector<std::string> entries() const;
  /// One entry, checked against its CRC-32.
  std::vector<std::byte> entry(const std::string& name) const;
  /// Decoded codes of one tile.
  PlaneCodes planeTile(int group, int level, int x, int y) const;
  /// 8-bit coverage of one tile; empty if the object has no mask.
  BytePicture maskTile(int group, int level, int x, int y) const;
  /// Depths of one tile as camera.h's depthOf, row by row, infinity where nothing is; empty if the
  /// group has none.
  std::vector<float> depthTile(int group, int level, int x, int y) const;
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
