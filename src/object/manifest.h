// object.json: everything about an object but its pixels (docs/format.md, "object.json").
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codec/depth_tile.h"
#include "codec/tile.h"
#include "illum/basis_table.h"
#include "illum/camera.h"
#include "illum/light_file.h"
#include "illum/picture.h"

namespace illum {

/// g of the common form.
enum class Response {
  Linear,   ///< planes hold linear light
  Display,  ///< planes hold sRGB-encoded values: clamp to [0, 1], then to linear
  Cone,     ///< max(0, .), Belhumeur and Kriegman 1998
};

/// How a code becomes a plane's value.
enum class Curve {
  Linear,      ///< value = offset_k + step * code
  SignedSqrt,  ///< s = offset_k + step * code; value = sign(s) s^2
  Half,        ///< the code is the 16 bits of an IEEE 754 half; offsets are 0, the step is 1
};

std::string_view nameOf(Curve curve);  ///< "linear", "signedSqrt", "half"

/// How the planes of a basis are coded. Offsets and functions are the basis's own, all else is the
/// same for the whole object.
struct CodingEntry {
  Coding coding = Coding::Avif;
  int bits = 8;
  Curve curve = Curve::Linear;
  double step = 1;              ///< common to all planes
  std::vector<double> offsets;  ///< one per stored plane
  /// Which basis function each stored plane carries. Several may carry the same one: their values
  /// add. So a plane whose range exceeds what the bits hold at the common step is stored as two or
  /// more.
  std::vector<int> functions;
  int quality = 0;  ///< what the writer was asked for; informative

  int planes() const { return static_cast<int>(offsets.size()); }
};

/// The basis of the groups whose frames are turned alike: lights are looked up in their frame.
struct BasisEntry {
  std::string name;  ///< "sh", "hsh", "dct", "learned": for people; readers need only the table
  /// Per channel (separable), scalar planes (full), or lights (exact).
  int coefficients = 0;
  BasisColour colour;
  LightDomain domain = LightDomain::Hemisphere;
  std::uint64_t tableOffset = 0, tableBytes = 0;  ///< where in basis.bin
  CodingEntry coding;
  /// Named coefficients C = mixing * planes (row-major, coefficients x coefficients); empty if
  /// none.
  std::vector<double> mixing;
};

/// What the codes of a group's depth tiles mean: from + (to - from) * code / steps.
struct DepthRange {
  double from = 0, to = 0;  ///< camera.h, depthOf; from <= to
  int steps = 1;            ///< 1 to kMaxDepthSteps
  friend bool operator==(const DepthRange&, const DepthRange&) = default;
};

inline float depthOfCode(const DepthRange& range, int code) {
  return static_cast<float>(range.from + (range.to - range.from) * code / range.steps);
}

/// One view. Its reflectance is stored in the frame objectFromGroup(view.geometry).
struct GroupEntry {
  View view;
  int basis = 0;                    ///< index into Manifest::bases
  std::optional<DepthRange> depth;  ///< if the group has depth tiles
};

/// How a view's picture is cut: level l has the size ceil(size / 2^l), and there is a level l + 1
/// while the longer side of level l exceeds a tile.
struct TileGrid {
  Size size;
  int tile = 512;

  int levels() const;
  Size sizeAt(int level) const;
  int tilesAcross(int level) const;
  int tilesDown(int level) const;
  Rectangle tileRectangle(int level, int x, int y) const;
  std::uint64_t tiles() const;  ///< of all levels
};

struct Manifest {
  int versionMajor = 1, versionMinor = 0;
  int tile = 512;  ///< side of a full tile
  Response response = Response::Display;
  std::vector<BasisEntry> bases;
  std::vector<GroupEntry> groups;
  bool mask = false;
  std::vector<LightFileEntry> lights;  ///< that the object was made from, provenance; object frame
  std::vector<int> heldOut;            ///< indices into `lights` that were left out of the fit
  std::string generator;               ///< program and version
  std::vector<std::pair<std::string, std::string>>
      provenance;  ///< settings and figures, for people

  const View& view(int group) const { return groups[static_cast<std::size_t>(group)].view; }
  TileGrid grid(int group) const { return {sizeOf(view(group).geometry), tile}; }
  const BasisEntry& basisOf(int group) const {
    return bases[static_cast<std::size_t>(groups[static_cast<std::size_t>(group)].basis)];
  }
  /// Of the group's planes; all but offsets and functions are those of every group.
  const CodingEntry& coding(int group = 0) const { return basisOf(group).coding; }
};

/// The value of stored plane `plane` at a texel whose code is `code`.
double valueOfCode(const CodingEntry& coding, std::size_t plane, std::uint16_t code);

/// Limits of version 1, held on writing and on reading (docs/format.md, "object.json").
inline constexpr int kMaxSide = 1 << 20;
inline constexpr int kMinTile = 64, kMaxTile = 1360;
inline constexpr int kMaxGroups = 65536, kMaxBases = 1024;
inline constexpr int kMaxSlabs = 65536;
inline constexpr int kMaxLights = 100'000;
inline constexpr std::uint64_t kMaxTiles = std::uint64_t{1} << 22;  ///< of all groups and levels

/// Deterministic; doubles round-trip exactly; bytes of names that are not UTF-8 become U+FFFD.
/// Throws Error (Fault::Input) naming the field for anything that manifestFromText would refuse,
/// numbers that are not finite among it.
std::string textOf(const Manifest& manifest);
/// Untrusted input is safe: every number is checked against the limits in docs/format.md before
/// anything is sized by it. Unknown fields are skipped; a newer major version is refused. Throws
/// Error naming `source` and the field.
Manifest manifestFromText(std::string_view json, const std::string& source);

/// What fields must be to each other, beyond each one's own limits. Throws Error naming the field.
void checkConsistency(const Manifest& manifest);

/// The entries of the planes, depths and masks of one group.
void forEachTileOfGroup(const Manifest& manifest, int group,
                        const std::function<void(const std::string&)>& visit);

/// Every entry that an object with this manifest must have, in canonical order.
void forEachRequiredEntry(const Manifest& manifest,
                          const std::function<void(const std::string&)>& visit);

/// "planes/<group>/<level>/<x>_<y>.avif"; "mask/<group>/<level>/<x>_<y>.png"; "depth/…png"
std::string planeTileName(const Manifest&, int group, int level, int x, int y);
std::string maskTileName(const Manifest&, int group, int level, int x, int y);
std::string depthTileName(const Manifest&, int group, int level, int x, int y);

}  // namespace illum
