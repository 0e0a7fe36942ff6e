#include "illum/object.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "basis/light_mesh.h"
#include "illum/error.h"
#include "object/entry_name.h"
#include "object/entry_source.h"
#include "object/manifest.h"

namespace illum {
namespace {

Manifest readManifest(const EntrySource& source, const std::filesystem::path& path) {
  if (!source.has(kManifestEntry))
    throw inputError(path, "an .illum object",
                     fmt::format("an archive or folder without {}", kManifestEntry));
  const auto bytes = source.read(std::string(kManifestEntry), kMaxManifestBytes);
  return manifestFromText({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                          sourceName(path, kManifestEntry));
}

LightBasis readBasis(const BasisEntry& entry, std::span<const std::byte> tables,
                     const std::string& source) {
  if (entry.tableOffset > tables.size() || entry.tableBytes > tables.size() - entry.tableOffset)
    throw inputError(source,
                     fmt::format("a table at bytes {} to {}", entry.tableOffset,
                                 entry.tableOffset + entry.tableBytes),
                     fmt::format("{} bytes in all", tables.size()));
  const auto bytes = tables.subspan(entry.tableOffset, entry.tableBytes);
  if (entry.colour.kind == BasisColour::Kind::Exact) {
    auto mesh = std::make_shared<const LightMesh>(LightMesh::decode(bytes, source));
    if (mesh->lights() != entry.coefficients)
      throw inputError(source, fmt::format("{} lights", entry.coefficients),
                       std::to_string(mesh->lights()));
    return LightBasis(std::move(mesh));
  }
  BasisTable table = BasisTable::decode(bytes, source);
  const bool separable = entry.colour.kind == BasisColour::Kind::Separable;
  const int columns = separable ? entry.coefficients : 3 * entry.coefficients + 3;
  if (table.columns() != columns || table.domain() != entry.domain)
    throw inputError(source, fmt::format("a table of {} columns over its domain", columns),
                     fmt::format("{} columns{}", table.columns(),
                                 table.domain() != entry.domain ? " over another domain" : ""));
  return {std::move(table), entry.colour};
}

}  // namespace

struct Object::State {
  std::filesystem::path path;
  std::unique_ptr<EntrySource> source;
  Manifest manifest;
  std::vector<LightBasis> bases;

  void checkGroup(int group) const {
    if (group < 0 || group >= static_cast<int>(manifest.groups.size()))
      throw Error(Fault::Usage, fmt::format("{} has no group {}", path.string(), group));
  }

  /// Where a tile lies in its level, if there is one.
  Rectangle tileRectangle(int group, int level, int x, int y) const {
    checkGroup(group);
    const TileGrid grid = manifest.grid(group);
    if (level < 0 || level >= grid.levels() || x < 0 || x >= grid.tilesAcross(level) || y < 0 ||
        y >= grid.tilesDown(level))
      throw Error(Fault::Usage, fmt::format("{} has no tile {},{} of group {} at level {}",
                                            path.string(), x, y, group, level));
    return grid.tileRectangle(level, x, y);
  }
};

Object Object::open(const std::filesystem::path& path) {
  auto state = std::make_shared<State>();
  state->path = path;
  state->source = openEntrySource(path);
  state->manifest = readManifest(*state->source, path);
  const auto tables = state->source->read(std::string(kBasisEntry), kMaxBasisBytes);
  for (const BasisEntry& entry : state->manifest.bases)
    state->bases.push_back(readBasis(entry, tables, sourceName(path, kBasisEntry)));
  Object object;
  object.state_ = std::move(state);
  return object;
}

const std::filesystem::path& Object::path() const {
  return state_->path;
}

const Manifest& Object::manifest() const {
  return state_->manifest;
}

int Object::groups() const {
  return static_cast<int>(state_->manifest.groups.size());
}

const View& Object::view(int group) const {
  state_->checkGroup(group);
  return state_->manifest.view(group);
}

Size Object::size(int group) const {
  return sizeOf(view(group).geometry);
}

int Object::levels(int group) const {
  state_->checkGroup(group);
  return state_->manifest.grid(group).levels();
}

int Object::planes(int group) const {
  state_->checkGroup(group);
  return state_->manifest.coding(group).planes();
}

const LightBasis& Object::basis(int group) const {
  state_->checkGroup(group);
  const auto& groups = state_->manifest.groups;
  return state_->bases[static_cast<std::size_t>(groups[static_cast<std::size_t>(group)].basis)];
}

bool Object::hasMask() const {
  return state_->manifest.mask;
}

bool Object::hasDepth(int group) const {
  state_->checkGroup(group);
  return state_->manifest.groups[static_cast<std::size_t>(group)].depth.has_value();
}

std::uint64_t Object::fileBytes() const {
  return state_->source->fileBytes();
}

std::vector<std::string> Object::entries() const {
  return state_->source->names();
}

std::vector<std::byte> Object::entry(const std::string& name) const {
  return state_->source->read(name, entryLimitBytes(name));
}

PlaneCodes Object::planeTile(int group, int level, int x, int y) const {
  const Manifest& m = state_->manifest;
  const Size tile = state_->tileRectangle(group, level, x, y).size();
  const CodingEntry& coding = m.coding(group);
  const std::string name = planeTileName(m, group, level, x, y);
  return decodeTile(coding.coding, coding.bits, coding.planes(), tile, entry(name),
                    sourceName(state_->path, name));
}

BytePicture Object::maskTile(int group, int level, int x, int y) const {
  const Manifest& m = state_->manifest;
  const Size tile = state_->tileRectangle(group, level, x, y).size();
  if (!m.mask) return {};
  const std::string name = maskTileName(m, group, level, x, y);
  return decodeMaskTile(tile, entry(name), sourceName(state_->path, name));
}

std::vector<float> Object::depthTile(int group, int level, int x, int y) const {
  const Manifest& m = state_->manifest;
  const Size tile = state_->tileRectangle(group, level, x, y).size();
  const auto& range = m.groups[static_cast<std::size_t>(group)].depth;
  if (!range) return {};
  const std::string name = depthTileName(m, group, level, x, y);
  const auto codes =
      decodeDepthTile(tile, range->steps, entry(name), sourceName(state_->path, name));
  std::vector<float> depths(codes.size());
  std::transform(codes.begin(), codes.end(), depths.begin(), [&](std::uint16_t code) {
    return code == kNoDepth ? std::numeric_limits<float>::infinity() : depthOfCode(*range, code);
  });
  return depths;
}

std::vector<std::string> Object::containerFaults() const {
  return state_->source->faults();
}

}  // namespace illum
