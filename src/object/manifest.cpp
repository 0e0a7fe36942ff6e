#include "object/manifest.h"

#include <fmt/format.h>

#include <algorithm>

#include "illum/error.h"
#include "object/entry_name.h"

namespace illum {
namespace {

int dividedUp(int value, int divisor) {
  return value / divisor + (value % divisor != 0 ? 1 : 0);
}

Error wrong(std::string_view field, std::string_view expected, std::string_view found) {
  return {Fault::Input, fmt::format("field '{}': expected {}, found {}", field, expected, found)};
}

void checkCoding(const Manifest& m) {
  const CodingEntry& c = m.coding;
  if (!supportsBits(c.coding, c.bits))
    throw wrong("coding.bits", fmt::format("a depth that {} can hold", nameOf(c.coding)),
                std::to_string(c.bits));
  if (c.functions.size() != c.offsets.size())
    throw wrong("coding.functions", fmt::format("{} values", c.offsets.size()),
                std::to_string(c.functions.size()));
  AtlasLayout::forTile(m.planes(), {m.tile, m.tile}, splitsBytes(c.coding, c.bits));
}

/// Planes that a basis describes.
int functionsOf(const BasisEntry& basis) {
  return basis.colour.kind == BasisColour::Kind::Separable ? 3 * basis.coefficients
                                                           : basis.coefficients;
}

void checkBasis(const Manifest& m, std::size_t index) {
  const BasisEntry& basis = m.bases[index];
  const auto n = static_cast<std::size_t>(basis.coefficients);
  if (!basis.mixing.empty() && basis.mixing.size() != n * n)
    throw wrong(fmt::format("bases[{}].mixing", index), fmt::format("0 or {} values", n * n),
                std::to_string(basis.mixing.size()));
  for (const int function : m.coding.functions)
    if (function >= functionsOf(basis))
      throw wrong(
          "coding.functions",
          fmt::format("less than {}, the number that basis {} has", functionsOf(basis), index),
          std::to_string(function));
}

void checkTile(const Manifest& m) {
  if (m.tile % kCellAlignment != 0)
    throw wrong("tile", fmt::format("a multiple of {}", kCellAlignment), std::to_string(m.tile));
}

/// Coarser levels exist only while the longer side exceeds a tile.
void checkLevels(const Manifest& m) {
  if (m.levels == 1) return;
  const Size finer = m.sizeAt(m.levels - 2);
  if (std::max(finer.width, finer.height) <= m.tile)
    throw wrong("levels", "no level beyond the first that fits one tile", std::to_string(m.levels));
}

void checkTileCount(const Manifest& m) {
  std::uint64_t tiles = 0;
  for (int level = 0; level < m.levels; ++level)
    tiles += static_cast<std::uint64_t>(m.tilesAcross(level)) *
             static_cast<std::uint64_t>(m.tilesDown(level));
  tiles *= m.groups.size();
  if (tiles > kMaxTiles)
    throw wrong("tile", fmt::format("tiles so large that there are at most {}", kMaxTiles),
                std::to_string(tiles));
}

/// A photograph's frame is the object's (docs/conventions.md, "Frames").
void checkPose(const GroupEntry& group, std::size_t index) {
  if (group.objectFromGroup != RigidTransform())
    throw wrong(fmt::format("groups[{}].objectFromGroup", index),
                "the identity, as for every photograph", "another transform");
}

void checkHeldOut(const Manifest& m) {
  for (std::size_t i = 0; i < m.heldOut.size(); ++i) {
    const int light = m.heldOut[i];
    if (light < 0 || light >= static_cast<int>(m.lights.size()) ||
        (i > 0 && light <= m.heldOut[i - 1]))
      throw wrong("heldOut", fmt::format("rising indices below {}", m.lights.size()),
                  std::to_string(light));
  }
}

}  // namespace

Size Manifest::sizeAt(int level) const {
  const int divisor = 1 << level;
  return {dividedUp(size.width, divisor), dividedUp(size.height, divisor)};
}

int Manifest::tilesAcross(int level) const {
  return dividedUp(sizeAt(level).width, tile);
}

int Manifest::tilesDown(int level) const {
  return dividedUp(sizeAt(level).height, tile);
}

Rectangle Manifest::tileRectangle(int level, int x, int y) const {
  const Size whole = sizeAt(level);
  return {x * tile, y * tile, std::min(tile, whole.width - x * tile),
          std::min(tile, whole.height - y * tile)};
}

void checkConsistency(const Manifest& m) {
  checkTile(m);
  checkCoding(m);
  for (std::size_t b = 0; b < m.bases.size(); ++b) checkBasis(m, b);
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    if (m.groups[g].basis >= static_cast<int>(m.bases.size()))
      throw wrong(fmt::format("groups[{}].basis", g), fmt::format("less than {}", m.bases.size()),
                  std::to_string(m.groups[g].basis));
    checkPose(m.groups[g], g);
  }
  checkLevels(m);
  checkTileCount(m);
  checkHeldOut(m);
}

std::string planeTileName(const Manifest& manifest, int group, int level, int x, int y) {
  return tileEntryName("planes", group, level, x, y, fileSuffixOf(manifest.coding.coding));
}

std::string maskTileName(const Manifest&, int group, int level, int x, int y) {
  return tileEntryName("mask", group, level, x, y, ".png");
}

void forEachRequiredEntry(const Manifest& m, const std::function<void(const std::string&)>& visit) {
  const auto visitTiles = [&](auto nameOfTile) {
    for (int group = 0; group < static_cast<int>(m.groups.size()); ++group)
      for (int level = 0; level < m.levels; ++level)
        for (int y = 0; y < m.tilesDown(level); ++y)
          for (int x = 0; x < m.tilesAcross(level); ++x) visit(nameOfTile(m, group, level, x, y));
  };
  visit(std::string(kManifestEntry));
  visit(std::string(kBasisEntry));
  visitTiles(planeTileName);
  if (m.mask) visitTiles(maskTileName);
}

}  // namespace illum
