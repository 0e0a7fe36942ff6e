#include "encode/sample_object.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "basis/light_mesh.h"
#include "encode/encode_tile.h"
#include "object/entry_name.h"

namespace illum {
namespace {

constexpr std::size_t kCoefficients = 4;
constexpr std::size_t kFullPlanes = 5;
constexpr int kSampleLights = 5;

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

/// Five lights on the axes, and the south pole, which stands for the four around it.
LightMesh sampleMesh() {
  return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
          kSampleLights,
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}},
          "sample"};
}

std::vector<std::byte> sampleTable(const SampleOptions& options) {
  if (options.exact) return sampleMesh().encode();
  BasisTable table = options.fullBasis ? fullTable(options.domain) : separableTable(options.domain);
  return table.encode();
}

void makeExact(BasisEntry& basis) {
  basis.name = "exact";
  basis.coefficients = kSampleLights;
  basis.colour.kind = BasisColour::Kind::Exact;
  basis.domain = LightDomain::Sphere;
  basis.coding.curve = Curve::Half;
  basis.coding.step = 1;
  basis.coding.offsets.assign(3 * kSampleLights, 0);
  basis.coding.functions.resize(3 * kSampleLights);
  std::iota(basis.coding.functions.begin(), basis.coding.functions.end(), 0);
}

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

}  // namespace

std::vector<View> sampleViews() {
  LightSlab front;
  front.name = "front";
  front.distance = 3;
  front.uv = {-0.5, -0.25, 0.5, 0.25};
  front.uCount = 3;
  front.vCount = 2;
  front.size = {70, 40};
  LightSlab side = front;
  side.name = "side";
  side.objectFromSlab = rotationAbout(Direction::fromVector({0, 1, 0}), 1.5);
  side.objectFromSlab.translation = {0.25, 0, -0.5};
  side.size = {33, 50};
  const RigidTransform pose = lookAt({1, 2, 3}, {0, 0, 0}, {0, 1, 0});
  return {
      {"front 0,0", SlabView{front, 0, 0}},
      {"front 2,1", SlabView{front, 2, 1}},
      {"side 1,1", SlabView{side, 1, 1}},
      {"camera", PinholeCamera{pose, 80, 81, {20.5, 16}, {40, 32}}},
      {"around", Panorama{Panorama::Projection::Cylindrical, pose, {-3, -0.5, 3, 0.5}, {90, 20}}},
      {"sphere", Panorama{Panorama::Projection::Equirectangular, pose, {}, {64, 32}}}};
}

Manifest sampleManifest(const SampleOptions& options) {
  Manifest m;
  m.tile = options.tile;
  m.response = options.response;
  BasisEntry basis;
  basis.name = options.fullBasis ? "learned" : "sh";
  basis.coefficients = static_cast<int>(options.fullBasis ? kFullPlanes : kCoefficients);
  basis.domain = options.domain;
  basis.tableBytes = 1;
  CodingEntry& coding = basis.coding;
  coding.coding = options.coding;
  coding.bits = options.bits;
  coding.curve = options.curve;
  coding.step = std::ldexp(1.0, -options.bits);
  coding.quality = options.quality;
  const int functions = static_cast<int>(options.fullBasis ? kFullPlanes : 3 * kCoefficients);
  for (int k = 0; k < functions; ++k) {
    coding.offsets.push_back(k < 3 ? 0 : -0.5);
    coding.functions.push_back(k);
  }
  if (options.fullBasis) {
    basis.colour.kind = BasisColour::Kind::Full;
    // One function more in two planes: the range of one is not enough for it.
    coding.offsets.push_back(-0.25);
    coding.functions.push_back(1);
  }
  if (options.exact) makeExact(basis);
  for (int b = 0; b < options.bases; ++b) {
    m.bases.push_back(basis);
    for (double& offset : basis.coding.offsets) offset += 0.125;
  }
  std::vector<View> views = options.views;
  if (views.empty()) views.push_back({"photograph", OrthographicView{options.size}});
  for (std::size_t g = 0; g < views.size(); ++g) {
    GroupEntry group{views[g], static_cast<int>(g) % options.bases, {}};
    if (options.depthSteps > 0) group.depth = {-1, 0.5, options.depthSteps};
    m.groups.push_back(group);
  }
  m.mask = options.mask;
  m.lights.push_back({"left.jpg", {Direction::fromVector({-0.6, 0, 0.8}), {1, 1, 1}}, 0});
  m.lights.push_back({"above.jpg", {Direction::fromVector({0, 0.6, 0.8}), {1, 0.5f, 2}}, 0});
  m.heldOut = {1};
  m.generator = "sample";
  m.provenance = {{"made by", "arithmetic"}};
  return m;
}

PlaneCodes sampleCodes(const Manifest& manifest, int group, int level, int x, int y) {
  const CodingEntry& coding = manifest.coding(group);
  const Rectangle area = manifest.grid(group).tileRectangle(level, x, y);
  PlaneCodes codes{coding.planes(), area.size(), {}};
  codes.values.reserve(static_cast<std::size_t>(codes.planes) * area.pixels());
  constexpr double kHalfOfOne = 0x3c00;
  const double scale = std::ldexp(1.0, level);
  const double largest =
      coding.curve == Curve::Half ? kHalfOfOne : std::ldexp(1.0, coding.bits) - 1;
  for (int k = 0; k < codes.planes; ++k)
    for (int row = area.y; row < area.bottom(); ++row)
      for (int column = area.x; column < area.right(); ++column) {
        // Triangle waves: exact in binary, so that no library's sine decides a frozen byte.
        const double t = (3 * column + 5 * row + 7 * k + group) * scale / 64 + k / 16.0;
        const double wave = std::abs(t - 2 * std::floor(t / 2) - 1);
        codes.values.push_back(static_cast<std::uint16_t>(std::lround(wave * largest)));
      }
  return codes;
}

BytePicture sampleMask(const Manifest& manifest, int group, int level, int x, int y) {
  const Rectangle area = manifest.grid(group).tileRectangle(level, x, y);
  BytePicture mask(area.size(), 1);
  for (int row = 0; row < area.height; ++row)
    for (int column = 0; column < area.width; ++column)
      mask.at(column, row, 0) = static_cast<std::uint8_t>(std::min(255, 4 * (area.x + column)));
  return mask;
}

std::vector<std::uint16_t> sampleDepth(const Manifest& manifest, int group, int level, int x,
                                       int y) {
  const Rectangle area = manifest.grid(group).tileRectangle(level, x, y);
  const int steps = manifest.groups[static_cast<std::size_t>(group)].depth->steps;
  std::vector<std::uint16_t> codes;
  for (int row = area.y; row < area.bottom(); ++row)
    for (int column = area.x; column < area.right(); ++column) {
      const bool hole = (row + column) % 7 == 0;
      const int code = std::min(steps, (3 * row + 2 * column) * steps / 300);
      codes.push_back(hole ? kNoDepth : static_cast<std::uint16_t>(code));
    }
  return codes;
}

Entries sampleEntries(const SampleOptions& options) {
  Manifest manifest = sampleManifest(options);
  const auto table = sampleTable(options);
  for (BasisEntry& basis : manifest.bases) basis.tableBytes = table.size();
  Entries entries;
  entries.emplace_back(kManifestEntry, bytesOf(textOf(manifest)));
  entries.emplace_back(kBasisEntry, table);
  if (options.poster) {
    PlaneCodes poster = sampleCodes(manifest, 0, 0, 0, 0);
    for (auto& value : poster.values)
      value = static_cast<std::uint16_t>(value >> (options.bits - 8));
    entries.emplace_back(kPosterEntry, encodeTile(poster, Coding::Jpeg, 8, {}));
  }
  const auto forEachTile = [&](const auto& add) {
    for (int group = 0; group < static_cast<int>(manifest.groups.size()); ++group) {
      const TileGrid grid = manifest.grid(group);
      for (int level = 0; level < grid.levels(); ++level)
        for (int y = 0; y < grid.tilesDown(level); ++y)
          for (int x = 0; x < grid.tilesAcross(level); ++x) add(group, level, x, y);
    }
  };
  forEachTile([&](int group, int level, int x, int y) {
    entries.emplace_back(planeTileName(manifest, group, level, x, y),
                         encodeTile(sampleCodes(manifest, group, level, x, y), options.coding,
                                    options.bits, {options.quality, 8}));
  });
  if (options.depthSteps > 0)
    forEachTile([&](int group, int level, int x, int y) {
      const Size tile = manifest.grid(group).tileRectangle(level, x, y).size();
      entries.emplace_back(
          depthTileName(manifest, group, level, x, y),
          encodeDepthTile(sampleDepth(manifest, group, level, x, y), tile, options.depthSteps));
    });
  if (options.mask)
    forEachTile([&](int group, int level, int x, int y) {
      entries.emplace_back(maskTileName(manifest, group, level, x, y),
                           encodeMaskTile(sampleMask(manifest, group, level, x, y)));
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
