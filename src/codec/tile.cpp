#include "codec/tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "codec/atlas.h"
#include "codec/tile_decoders.h"
#include "illum/error.h"

namespace illum {
namespace {

struct CodingName {
  Coding coding;
  std::string_view name, suffix;
};

constexpr std::array<CodingName, 3> kCodings{{
    {Coding::Png, "png", ".png"},
    {Coding::Avif, "avif", ".avif"},
    {Coding::Jpeg, "jpeg", ".jpg"},
}};

const CodingName& find(Coding coding) {
  return *std::find_if(kCodings.begin(), kCodings.end(),
                       [=](const CodingName& c) { return c.coding == coding; });
}

int roundedUpToCell(int texels) {
  return (texels + kCellAlignment - 1) / kCellAlignment * kCellAlignment;
}

/// Reads the planes' bytes, high and low ones where they are split.
void unpack(const std::vector<std::uint8_t>& samples, const AtlasLayout& layout,
            PlaneCodes& codes) {
  const auto view = interleavedAtlas(samples.data(), layout.atlas());
  for (int k = 0; k < layout.planes; ++k) {
    const CellOrigin high = cellOrigin(layout, k / 3);
    const CellOrigin low = cellOrigin(layout, k / 3 + cellsPerSet(layout.planes));
    std::uint16_t* out = codes.plane(k).data();
    for (int y = 0; y < layout.tile.height; ++y) {
      const std::uint8_t* first = view.at(k % 3, high.x, high.y + y);
      const std::uint8_t* second = layout.split ? view.at(k % 3, low.x, low.y + y) : nullptr;
      for (int x = 0; x < layout.tile.width; ++x, ++out) {
        const std::size_t at = 3 * static_cast<std::size_t>(x);
        *out = static_cast<std::uint16_t>(second ? first[at] << 8 | second[at] : first[at]);
      }
    }
  }
}

void checkRange(const PlaneCodes& codes, int bits, const std::string& source) {
  const auto largest = std::max_element(codes.values.begin(), codes.values.end());
  if (largest != codes.values.end() && *largest >> bits != 0)
    throw Error(Fault::Input,
                fmt::format("{}: expected codes of {} bits, found {}", source, bits, *largest));
}

void checkRequest(Coding coding, int bits, int planes, Size tile) {
  if (!supportsBits(coding, bits))
    throw Error(Fault::Input,
                fmt::format("the coding {} cannot hold {} bits", nameOf(coding), bits));
  if (planes < 1 || planes > kMaxPlanes || tile.width < 1 || tile.height < 1)
    throw Error(Fault::Input, fmt::format("a tile of {}x{} texels and {} planes is not possible",
                                          tile.width, tile.height, planes));
}

}  // namespace

std::string_view nameOf(Coding coding) {
  return find(coding).name;
}

std::string_view fileSuffixOf(Coding coding) {
  return find(coding).suffix;
}

Coding codingFromName(std::string_view name) {
  for (const CodingName& c : kCodings)
    if (c.name == name) return c.coding;
  throw Error(Fault::Usage,
              fmt::format("expected one of the codings png, avif, jpeg, found '{}'", name));
}

bool supportsBits(Coding coding, int bits) {
  switch (coding) {
    case Coding::Png:
      return bits == 8 || bits == 10 || bits == 12 || bits == 16;
    case Coding::Avif:
      return bits == 8 || bits == 10 || bits == 12;
    case Coding::Jpeg:
      return bits == 8;
  }
  return false;
}

bool splitsBytes(Coding coding, int bits) {
  return coding == Coding::Png && bits > 8;
}

AtlasLayout AtlasLayout::forTile(int planes, Size tile, bool split) {
  AtlasLayout layout;
  layout.planes = planes;
  layout.tile = tile;
  layout.split = split;
  const bool possible = planes >= 1 && planes <= kMaxPlanes && tile.width >= 1 &&
                        tile.height >= 1 && tile.width <= kMaxAtlasSide &&
                        tile.height <= kMaxAtlasSide;
  int shortest = kMaxAtlasSide + 1;
  if (possible) {
    layout.cell = {roundedUpToCell(tile.width), roundedUpToCell(tile.height)};
    for (int columns = 1; columns <= layout.cells(); ++columns) {
      const int rows = (layout.cells() + columns - 1) / columns;
      const int longer = std::max(columns * layout.cell.width, rows * layout.cell.height);
      if (longer >= shortest) continue;
      shortest = longer;
      layout.columns = columns;
      layout.rows = rows;
    }
  }
  if (shortest > kMaxAtlasSide)
    throw Error(Fault::Input,
                fmt::format("{} planes of {}x{} texels{} do not fit an atlas of {}x{}", planes,
                            tile.width, tile.height, split ? " in high and low bytes" : "",
                            kMaxAtlasSide, kMaxAtlasSide));
  return layout;
}

PlaneCodes decodeTile(Coding coding, int bits, int planes, Size tile,
                      std::span<const std::byte> file, const std::string& source) {
  checkRequest(coding, bits, planes, tile);
  const auto layout = AtlasLayout::forTile(planes, tile, splitsBytes(coding, bits));
  PlaneCodes codes{planes, tile, {}};
  if (coding == Coding::Avif) {
    decodeAvifCodes(file, bits, layout, codes, source);
    return codes;
  }
  const auto samples = coding == Coding::Png ? decodePngSamples(file, layout.atlas(), 3, source)
                                             : decodeJpegSamples(file, layout.atlas(), source);
  codes.values.resize(static_cast<std::size_t>(planes) * tile.pixels());
  unpack(samples, layout, codes);
  checkRange(codes, bits, source);
  return codes;
}

BytePicture decodeMaskTile(Size tile, std::span<const std::byte> file, const std::string& source) {
  const auto samples = decodePngSamples(file, tile, 1, source);
  BytePicture mask(tile, 1);
  std::copy(samples.begin(), samples.end(), mask.samples().begin());
  return mask;
}

}  // namespace illum
