#include "object/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "illum/error.h"
#include "object/entry_name.h"
#include "object/view_check.h"

namespace illum {
namespace {

// IEEE 754-2008, section 3.4, binary16.
double valueOfHalf(std::uint16_t bits) {
  constexpr int kMantissaBits = 10, kInfinite = 31, kBias = 15;
  const int exponent = bits >> kMantissaBits & kInfinite, mantissa = bits & 1023;
  const double sign = (bits & 0x8000) != 0 ? -1 : 1;
  if (exponent == kInfinite)
    return mantissa == 0 ? sign * std::numeric_limits<double>::infinity()
                         : std::numeric_limits<double>::quiet_NaN();
  if (exponent == 0) return sign * std::ldexp(mantissa, 1 - kBias - kMantissaBits);
  return sign * std::ldexp(1024 + mantissa, exponent - kBias - kMantissaBits);
}

int dividedUp(int value, int divisor) {
  return value / divisor + (value % divisor != 0 ? 1 : 0);
}

Error wrong(std::string_view field, std::string_view expected, std::string_view found) {
  return {Fault::Input, fmt::format("field '{}': expected {}, found {}", field, expected, found)};
}

/// Planes that a basis describes.
int functionsOf(const BasisEntry& basis) {
  return basis.colour.kind == BasisColour::Kind::Full ? basis.coefficients : 3 * basis.coefficients;
}

// Half bit patterns leave nothing to scale.
void checkHalves(const CodingEntry& c, const std::string& field) {
  if (c.bits != 16) throw wrong("coding.bits", "16 with the curve half", std::to_string(c.bits));
  if (c.step != 1) throw wrong("coding.step", "1 with the curve half", fmt::format("{}", c.step));
  for (const double offset : c.offsets)
    if (offset != 0) throw wrong(field, "0 with the curve half", fmt::format("{}", offset));
}

void checkExact(const BasisEntry& basis, std::size_t index) {
  if (basis.colour.kind != BasisColour::Kind::Exact) return;
  if (basis.domain != LightDomain::Sphere)
    throw wrong(fmt::format("bases[{}].domain", index), "sphere with the kind exact", "hemisphere");
  if (basis.colour.colourMatrix != BasisColour().colourMatrix)
    throw wrong(fmt::format("bases[{}].colourMatrix", index), "the identity with the kind exact",
                "another");
}

void checkCoding(const Manifest& m, std::size_t index) {
  const CodingEntry &c = m.bases[index].coding, &common = m.bases.front().coding;
  if (!supportsBits(c.coding, c.bits))
    throw wrong("coding.bits", fmt::format("a depth that {} can hold", nameOf(c.coding)),
                std::to_string(c.bits));
  if (c.coding != common.coding || c.bits != common.bits || c.curve != common.curve ||
      c.step != common.step)
    throw wrong("coding", "the same for all bases", fmt::format("another for basis {}", index));
  const std::string field = fmt::format("bases[{}].functions", index);
  if (c.functions.size() != c.offsets.size())
    throw wrong(field, fmt::format("{} values", c.offsets.size()),
                std::to_string(c.functions.size()));
  if (c.curve == Curve::Half) checkHalves(c, fmt::format("bases[{}].offsets", index));
  const int functions = functionsOf(m.bases[index]);
  for (const int function : c.functions)
    if (function >= functions)
      throw wrong(field, fmt::format("less than {}, the number that the basis has", functions),
                  std::to_string(function));
  AtlasLayout::forTile(c.planes(), {m.tile, m.tile}, splitsBytes(c.coding, c.bits));
}

void checkMixing(const BasisEntry& basis, std::size_t index) {
  const auto n = static_cast<std::size_t>(basis.coefficients);
  if (!basis.mixing.empty() && basis.mixing.size() != n * n)
    throw wrong(fmt::format("bases[{}].mixing", index), fmt::format("0 or {} values", n * n),
                std::to_string(basis.mixing.size()));
}

void checkTile(const Manifest& m) {
  if (m.tile % kCellAlignment != 0)
    throw wrong("tile", fmt::format("a multiple of {}", kCellAlignment), std::to_string(m.tile));
}

void checkGroups(const Manifest& m) {
  std::uint64_t tiles = 0;
  for (std::size_t g = 0; g < m.groups.size(); ++g) {
    if (m.groups[g].basis >= static_cast<int>(m.bases.size()))
      throw wrong(fmt::format("groups[{}].basis", g), fmt::format("less than {}", m.bases.size()),
                  std::to_string(m.groups[g].basis));
    tiles += m.grid(static_cast<int>(g)).tiles();
  }
  if (tiles > kMaxTiles)
    throw wrong("tile", fmt::format("tiles so large that there are at most {}", kMaxTiles),
                std::to_string(tiles));
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

using Visit = std::function<void(const std::string&)>;

template <typename NameOfTile>
void visitTiles(const Manifest& m, int group, NameOfTile nameOfTile, const Visit& visit) {
  const TileGrid grid = m.grid(group);
  for (int level = 0; level < grid.levels(); ++level)
    for (int y = 0; y < grid.tilesDown(level); ++y)
      for (int x = 0; x < grid.tilesAcross(level); ++x) visit(nameOfTile(m, group, level, x, y));
}

}  // namespace

int TileGrid::levels() const {
  int levels = 1;
  for (int side = std::max(size.width, size.height); side > tile; side = dividedUp(side, 2))
    ++levels;
  return levels;
}

Size TileGrid::sizeAt(int level) const {
  const int divisor = 1 << level;
  return {dividedUp(size.width, divisor), dividedUp(size.height, divisor)};
}

int TileGrid::tilesAcross(int level) const {
  return dividedUp(sizeAt(level).width, tile);
}

int TileGrid::tilesDown(int level) const {
  return dividedUp(sizeAt(level).height, tile);
}

Rectangle TileGrid::tileRectangle(int level, int x, int y) const {
  const Size whole = sizeAt(level);
  return {x * tile, y * tile, std::min(tile, whole.width - x * tile),
          std::min(tile, whole.height - y * tile)};
}

std::uint64_t TileGrid::tiles() const {
  std::uint64_t tiles = 0;
  for (int level = 0; level < levels(); ++level)
    tiles += static_cast<std::uint64_t>(tilesAcross(level)) *
             static_cast<std::uint64_t>(tilesDown(level));
  return tiles;
}

void checkConsistency(const Manifest& m) {
  checkTile(m);
  for (std::size_t b = 0; b < m.bases.size(); ++b) {
    checkCoding(m, b);
    checkMixing(m.bases[b], b);
    checkExact(m.bases[b], b);
  }
  checkGroups(m);
  checkViews(m);
  checkHeldOut(m);
}

std::string_view nameOf(Curve curve) {
  switch (curve) {
    case Curve::Linear:
      return "linear";
    case Curve::SignedSqrt:
      return "signedSqrt";
    case Curve::Half:
      return "half";
  }
  return "";
}

double valueOfCode(const CodingEntry& coding, std::size_t plane, std::uint16_t code) {
  if (coding.curve == Curve::Half) return valueOfHalf(code);
  const double s = coding.offsets[plane] + coding.step * code;
  return coding.curve == Curve::Linear ? s : s * std::abs(s);
}

std::string planeTileName(const Manifest& m, int group, int level, int x, int y) {
  return tileEntryName("planes", group, level, x, y, fileSuffixOf(m.coding().coding));
}

std::string maskTileName(const Manifest&, int group, int level, int x, int y) {
  return tileEntryName("mask", group, level, x, y, ".png");
}

std::string depthTileName(const Manifest&, int group, int level, int x, int y) {
  return tileEntryName("depth", group, level, x, y, ".png");
}

void forEachTileOfGroup(const Manifest& m, int group, const Visit& visit) {
  visitTiles(m, group, planeTileName, visit);
  if (m.groups[static_cast<std::size_t>(group)].depth) visitTiles(m, group, depthTileName, visit);
  if (m.mask) visitTiles(m, group, maskTileName, visit);
}

void forEachRequiredEntry(const Manifest& m, const Visit& visit) {
  const int groups = static_cast<int>(m.groups.size());
  visit(std::string(kManifestEntry));
  visit(std::string(kBasisEntry));
  for (int g = 0; g < groups; ++g) visitTiles(m, g, planeTileName, visit);
  for (int g = 0; g < groups; ++g)
    if (m.groups[static_cast<std::size_t>(g)].depth) visitTiles(m, g, depthTileName, visit);
  for (int g = 0; m.mask && g < groups; ++g) visitTiles(m, g, maskTileName, visit);
}

}  // namespace illum
