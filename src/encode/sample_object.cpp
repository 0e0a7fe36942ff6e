#include "encode/sample_object.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "encode/encode_tile.h"
#include "object/entry_name.h"

namespace illum {
namespace {

constexpr std::size_t kCoefficients = 4;
constexpr std::size_t kFullPlanes = 5;

/// Four smooth functions: the first real spherical harmonics without their constants.
std::array<double, kCoefficients> harmonics(Direction d) {
  return {1, d.x(), d.y(), d.z()};
}

BasisTable separableTable(LightDomain domain) {
  BasisTable table(domain, 9, kCoefficients);
  table.fill([](Direction d, std::span<double> out) {
    const auto values = harmonics(d);
    std::copy(values.begin(), values.end(), out.begin());
  });
  return table;
}

/// Every plane has its own colour, and the mean is reddish.
BasisTable fullTable(LightDomain domain) {
  BasisTable table(domain, 10, 3 * kFullPlanes + 3);
  table.fill([](Direction d, std::span<double> out) {
    const auto values = harmonics(d);
    for (std::size_t k = 0; k <= kFullPlanes; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        out[3 * k + c] = values[k % kCoefficients] / static_cast<double>(1 + (k + c) % 3);
  });
  return table;
}

BasisTable sampleTable(const SampleOptions& options) {
  return options.fullBasis ? fullTable(options.domain) : separableTable(options.domain);
}

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

}  // namespace

Manifest sampleManifest(const SampleOptions& options) {
  Manifest m;
  m.size = options.size;
  m.tile = options.tile;
  m.levels = std::max(options.size.width, options.size.height) > options.tile ? 2 : 1;
  m.response = options.response;
  m.domain = options.domain;
  m.coding.coding = options.coding;
  m.coding.bits = options.bits;
  m.coding.curve = options.curve;
  m.coding.step = std::ldexp(1.0, -options.bits);
  m.coding.quality = options.quality;
  const int functions = static_cast<int>(options.fullBasis ? kFullPlanes : 3 * kCoefficients);
  for (int k = 0; k < functions; ++k) {
    m.coding.offsets.push_back(k < 3 ? 0 : -0.5);
    m.coding.functions.push_back(k);
  }
  BasisEntry basis;
  basis.name = options.fullBasis ? "learned" : "sh";
  basis.coefficients = static_cast<int>(options.fullBasis ? kFullPlanes : kCoefficients);
  basis.tableBytes = 1;
  if (options.fullBasis) {
    basis.colour.kind = BasisColour::Kind::Full;
    // One function more in two planes: the range of one is not enough for it.
    m.coding.offsets.push_back(-0.25);
    m.coding.functions.push_back(1);
  }
  m.bases.push_back(basis);
  m.groups.push_back({"photograph", 0, 1, {}});
  m.mask = options.mask;
  m.lights.push_back({"left.jpg", {Direction::fromVector({-0.6, 0, 0.8}), {1, 1, 1}}, 0});
  m.lights.push_back({"above.jpg", {Direction::fromVector({0, 0.6, 0.8}), {1, 0.5f, 2}}, 0});
  m.heldOut = {1};
  m.generator = "sample";
  m.provenance = {{"made by", "arithmetic"}};
  return m;
}

PlaneCodes sampleCodes(const Manifest& manifest, int level, int x, int y) {
  const Rectangle area = manifest.tileRectangle(level, x, y);
  PlaneCodes codes{manifest.planes(), area.size(), {}};
  codes.values.reserve(static_cast<std::size_t>(codes.planes) * area.pixels());
  const double scale = std::ldexp(1.0, level), largest = std::ldexp(1.0, manifest.coding.bits) - 1;
  for (int k = 0; k < codes.planes; ++k)
    for (int row = area.y; row < area.bottom(); ++row)
      for (int column = area.x; column < area.right(); ++column) {
        // Triangle waves: exact in binary, so that no library's sine decides a frozen byte.
        const double t = (3 * column + 5 * row + 7 * k) * scale / 64 + k / 16.0;
        const double wave = std::abs(t - 2 * std::floor(t / 2) - 1);
        codes.values.push_back(static_cast<std::uint16_t>(std::lround(wave * largest)));
      }
  return codes;
}

BytePicture sampleMask(const Manifest& manifest, int level, int x, int y) {
  const Rectangle area = manifest.tileRectangle(level, x, y);
  BytePicture mask(area.size(), 1);
  for (int row = 0; row < area.height; ++row)
    for (int column = 0; column < area.width; ++column)
      mask.at(column, row, 0) = static_cast<std::uint8_t>(std::min(255, 4 * (area.x + column)));
  return mask;
}

Entries sampleEntries(const SampleOptions& options) {
  Manifest manifest = sampleManifest(options);
  const auto table = sampleTable(options).encode();
  manifest.bases.front().tableBytes = table.size();
  Entries entries;
  entries.emplace_back(kManifestEntry, bytesOf(textOf(manifest)));
  entries.emplace_back(kBasisEntry, table);
  if (options.poster) {
    PlaneCodes poster = sampleCodes(manifest, 0, 0, 0);
    for (auto& value : poster.values)
      value = static_cast<std::uint16_t>(value >> (options.bits - 8));
    entries.emplace_back(kPosterEntry, encodeTile(poster, Coding::Jpeg, 8, {}));
  }
  const auto forEachTile = [&](const auto& add) {
    for (int level = 0; level < manifest.levels; ++level)
      for (int y = 0; y < manifest.tilesDown(level); ++y)
        for (int x = 0; x < manifest.tilesAcross(level); ++x) add(level, x, y);
  };
  forEachTile([&](int level, int x, int y) {
    entries.emplace_back(planeTileName(manifest, 0, level, x, y),
                         encodeTile(sampleCodes(manifest, level, x, y), options.coding,
                                    options.bits, {options.quality, 8}));
  });
  if (options.mask)
    forEachTile([&](int level, int x, int y) {
      entries.emplace_back(maskTileName(manifest, 0, level, x, y),
                           encodeMaskTile(sampleMask(manifest, level, x, y)));
    });
  return entries;
}

void writeSampleObject(const std::filesystem::path& out, ObjectForm form,
                       const SampleOptions& options) {
  ObjectWriter writer(out, form, "sample", false, true);
  for (const auto& [name, bytes] : sampleEntries(options)) writer.add(name, bytes);
  writer.finish();
}

}  // namespace illum
