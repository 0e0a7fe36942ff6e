// Writes tiles of every coding and depth with the codes that our decoder reads from them, so that a
// browser's decoder can be held to ours (tests/browser/run.mjs).
//
// illum_tile_cases FOLDER: NAME.png|.avif|.jpg, NAME.u16 (little-endian codes, plane by plane) and
// cases.json.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "codec/tile.h"
#include "core/files.h"
#include "encode/encode_tile.h"
#include "illum/error.h"

namespace {

using namespace illum;

struct Case {
  Coding coding;
  int bits;
  int quality;
};

constexpr int kPlanes = 7;  // a last cell that is not full
constexpr Size kTile{93, 61};

// Waves of a different frequency in every plane, some noise, and both ends of the range.
PlaneCodes syntheticCodes(int bits) {
  const double peak = std::exp2(bits) - 1;
  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  PlaneCodes codes{kPlanes, kTile, {}};
  for (int k = 0; k < kPlanes; ++k)
    for (int y = 0; y < kTile.height; ++y)
      for (int x = 0; x < kTile.width; ++x) {
        const double wave = std::sin(0.05 * (k + 1) * x) * std::cos(0.04 * (k + 2) * y);
        const double unit = std::clamp(0.5 + 0.55 * wave + noise(random), 0.0, 1.0);
        codes.values.push_back(static_cast<std::uint16_t>(std::lround(unit * peak)));
      }
  return codes;
}

std::vector<std::byte> littleEndian(const PlaneCodes& codes) {
  std::vector<std::byte> bytes;
  for (const std::uint16_t value : codes.values) {
    bytes.push_back(static_cast<std::byte>(value & 255));
    bytes.push_back(static_cast<std::byte>(value >> 8));
  }
  return bytes;
}

std::string describe(const Case& c, const std::string& name) {
  const AtlasLayout layout = AtlasLayout::forTile(kPlanes, kTile, splitsBytes(c.coding, c.bits));
  const auto number = [](const char* key, int value) {
    return std::string("\"") + key + "\": " + std::to_string(value) + ", ";
  };
  return "{\"name\": \"" + name + "\", \"file\": \"" + name + std::string(fileSuffixOf(c.coding)) +
         "\", \"coding\": \"" + std::string(nameOf(c.coding)) + "\", " + number("bits", c.bits) +
         number("planes", kPlanes) + number("tileWidth", kTile.width) +
         number("tileHeight", kTile.height) + number("cellWidth", layout.cell.width) +
         number("cellHeight", layout.cell.height) + number("columns", layout.columns) +
         number("rows", layout.rows) + "\"split\": " + (layout.split ? "true" : "false") + "}";
}

std::string writeCase(const Case& c, const std::filesystem::path& folder) {
  const std::string name =
      std::string(nameOf(c.coding)) + std::to_string(c.bits) + "_q" + std::to_string(c.quality);
  const std::vector<std::byte> file =
      encodeTile(syntheticCodes(c.bits), c.coding, c.bits, {c.quality, 8});
  const PlaneCodes decoded = decodeTile(c.coding, c.bits, kPlanes, kTile, file, name);
  writeFileAtomically(folder / (name + std::string(fileSuffixOf(c.coding))), file);
  writeFileAtomically(folder / (name + ".u16"), littleEndian(decoded));
  return describe(c, name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: illum_tile_cases FOLDER\n", stderr);
    return 2;
  }
  const std::vector<Case> cases = {
      {Coding::Png, 8, 75},   {Coding::Png, 10, 75},  {Coding::Png, 12, 75},
      {Coding::Png, 16, 75},  {Coding::Jpeg, 8, 60},  {Coding::Jpeg, 8, 95},
      {Coding::Avif, 8, 50},  {Coding::Avif, 8, 95},  {Coding::Avif, 10, 50},
      {Coding::Avif, 10, 95}, {Coding::Avif, 12, 50}, {Coding::Avif, 12, 95},
  };
  try {
    std::filesystem::create_directories(argv[1]);
    std::string json;
    for (const Case& c : cases) json += (json.empty() ? "[\n" : ",\n") + writeCase(c, argv[1]);
    writeFileAtomically(std::filesystem::path(argv[1]) / "cases.json", json + "\n]\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "illum_tile_cases: %s\n", error.what());
    return 1;
  }
}
