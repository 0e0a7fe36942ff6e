#include "illum/object.h"

#include <fmt/format.h>

#include <algorithm>

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

LightBasis readBasis(const Manifest& manifest, const BasisEntry& entry,
                     std::span<const std::byte> tables, const std::string& source) {
  if (entry.tableOffset > tables.size() || entry.tableBytes > tables.size() - entry.tableOffset)
    throw inputError(source,
                     fmt::format("a table at bytes {} to {}", entry.tableOffset,
                                 entry.tableOffset + entry.tableBytes),
                     fmt::format("{} bytes in all", tables.size()));
  BasisTable table =
      BasisTable::decode(tables.subspan(entry.tableOffset, entry.tableBytes), source);
  const bool separable = entry.colour.kind == BasisColour::Kind::Separable;
  const int columns = separable ? entry.coefficients : 3 * entry.coefficients + 3;
  if (table.columns() != columns || table.domain() != manifest.domain)
    throw inputError(source,
                     fmt::format("a table of {} columns over the manifest's domain", columns),
                     fmt::format("{} columns{}", table.columns(),
                                 table.domain() != manifest.domain ? " over another domain" : ""));
  return {std::move(table), entry.colour};
}

}  // namespace

struct Object::State {
  std::filesystem::path path;
  std::unique_ptr<EntrySource> source;
  Manifest manifest;
  std::vector<LightBasis> bases;

  void checkTile(int group, int level, int x, int y) const {
    if (group < 0 || group >= static_cast<int>(manifest.groups.size()) || level < 0 ||
        level >= manifest.levels || x < 0 || x >= manifest.tilesAcross(level) || y < 0 ||
        y >= manifest.tilesDown(level))
      throw Error(Fault::Usage, fmt::format("{} has no tile {},{} of group {} at level {}",
                                            path.string(), x, y, group, level));
  }
};

Object Object::open(const std::filesystem::path& path) {
  auto state = std::make_shared<State>();
  state->path = path;
  state->source = openEntrySource(path);
  state->manifest = readManifest(*state->source, path);
  const auto tables = state->source->read(std::string(kBasisEntry), kMaxBasisBytes);
  for (const BasisEntry& entry : state->manifest.bases)
    state->bases.push_back(
        readBasis(state->manifest, entry, tables, sourceName(path, kBasisEntry)));
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

Size Object::size() const {
  return state_->manifest.size;
}

int Object::planes() const {
  return state_->manifest.planes();
}

const LightBasis& Object::basis(int group) const {
  const auto& groups = state_->manifest.groups;
  if (group < 0 || group >= static_cast<int>(groups.size()))
    throw Error(Fault::Usage, fmt::format("{} has no group {}", state_->path.string(), group));
  return state_->bases[static_cast<std::size_t>(groups[static_cast<std::size_t>(group)].basis)];
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
  state_->checkTile(group, level, x, y);
  const std::string name = planeTileName(m, group, level, x, y);
  return decodeTile(m.coding.coding, m.coding.bits, m.planes(), m.tileRectangle(level, x, y).size(),
                    entry(name), sourceName(state_->path, name));
}

BytePicture Object::maskTile(int group, int level, int x, int y) const {
  const Manifest& m = state_->manifest;
  state_->checkTile(group, level, x, y);
  if (!m.mask) return {};
  const std::string name = maskTileName(m, group, level, x, y);
  return decodeMaskTile(m.tileRectangle(level, x, y).size(), entry(name),
                        sourceName(state_->path, name));
}

std::vector<std::string> Object::containerFaults() const {
  return state_->source->faults();
}

}  // namespace illum
