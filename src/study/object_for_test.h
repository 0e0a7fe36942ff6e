// A small object on disk, for tests: the same picture under every light.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "codec/tile.h"
#include "encode/encode_tile.h"
#include "encode/object_writer.h"
#include "illum/basis_table.h"
#include "illum/object.h"
#include "object/manifest.h"

namespace illum {

/// A folder that goes away with the test.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("illum_study_" + name + "-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What the object shows, as a byte of its encoded picture: x, y, channel.
using ByteAt = std::function<int(int, int, int)>;

struct FlatObject {
  Size size;
  ByteAt byteAt;
  std::vector<LightFileEntry> lights;
  std::vector<int> heldOut;
  std::function<int(int, int)> coverageAt = {};  ///< a byte; empty: no mask
  std::vector<View> views = {};                  ///< empty: a photograph of `size`
  int brighter = 0;                              ///< each view than the one before, in bytes
};

/// One basis function, the constant 1, in each colour: relit = the planes, whatever the light.
inline std::vector<std::byte> constantTable(BasisTable& table) {
  table = BasisTable(LightDomain::Hemisphere, 5, 1);
  table.fill([](Direction, std::span<double> out) { out[0] = 1; });
  table.setStoredError(1e-7);
  return table.encode();
}

inline Manifest manifestOf(const FlatObject& object, std::size_t tableBytes) {
  Manifest manifest;
  manifest.tile = 64;
  manifest.response = Response::Display;
  BasisEntry basis;
  basis.name = "constant";
  basis.coefficients = 1;
  basis.tableBytes = tableBytes;
  basis.coding = {Coding::Png, 8, Curve::Linear, 1.0 / 255, {0, 0, 0}, {0, 1, 2}, 0};
  manifest.bases = {basis};
  for (const View& view : object.views) manifest.groups.push_back({view, 0, {}});
  if (object.views.empty()) manifest.groups = {{{"view", OrthographicView{object.size}}, 0, {}}};
  manifest.mask = static_cast<bool>(object.coverageAt);
  manifest.lights = object.lights;
  manifest.heldOut = object.heldOut;
  manifest.generator = "test";
  return manifest;
}

inline void writeTiles(const FlatObject& object, const Manifest& manifest, int group, int level,
                       ObjectWriter& writer) {
  const TileGrid grid = manifest.grid(group);
  for (int y = 0; y < grid.tilesDown(level); ++y) {
    for (int x = 0; x < grid.tilesAcross(level); ++x) {
      const Rectangle tile = grid.tileRectangle(level, x, y);
      PlaneCodes codes{3, tile.size(), {}};
      BytePicture mask(tile.size(), 1);
      for (int c = 0; c < 3; ++c)
        for (int v = tile.y; v < tile.bottom(); ++v)
          for (int u = tile.x; u < tile.right(); ++u)
            codes.values.push_back(static_cast<std::uint16_t>(
                object.byteAt(u << level, v << level, c) + group * object.brighter));
      writer.add(planeTileName(manifest, group, level, x, y),
                 encodeTile(codes, Coding::Png, 8, {}));
      if (!manifest.mask) continue;
      for (int v = 0; v < tile.height; ++v)
        for (int u = 0; u < tile.width; ++u)
          mask.at(u, v, 0) = static_cast<std::uint8_t>(
              object.coverageAt((tile.x + u) << level, (tile.y + v) << level));
      writer.add(maskTileName(manifest, group, level, x, y), encodeMaskTile(mask));
    }
  }
}

inline Object makeObject(const std::filesystem::path& file, const FlatObject& object) {
  BasisTable table;
  const std::vector<std::byte> bytes = constantTable(table);
  const Manifest manifest = manifestOf(object, bytes.size());
  ObjectWriter writer(file, ObjectForm::Archive, "test", false, true);
  for (int group = 0; group < static_cast<int>(manifest.groups.size()); ++group)
    for (int level = 0; level < manifest.grid(group).levels(); ++level)
      writeTiles(object, manifest, group, level, writer);
  writer.add("basis.bin", bytes);
  const std::string text = textOf(manifest);
  writer.add("object.json", std::as_bytes(std::span(text)));
  writer.finish();
  return Object::open(file);
}

}  // namespace illum
