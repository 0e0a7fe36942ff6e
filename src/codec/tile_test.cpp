#include "codec/tile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "codec/frozen_tiles.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

/// The sentence of the Error that `action` throws; empty if it throws none.
template <typename Action>
std::string errorOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

PlaneCodes decode(const FrozenTile& tile, std::span<const std::byte> file) {
  return decodeTile(tile.coding, tile.bits, kFrozenPlanes, kFrozenSize, file, "SOURCE");
}

std::string nameOf(const FrozenTile& tile) {
  return std::string(nameOf(tile.coding)) + " " + std::to_string(tile.bits);
}

TEST(Coding, NamesAreInverse) {
  for (const Coding coding : {Coding::Png, Coding::Avif, Coding::Jpeg})
    EXPECT_EQ(codingFromName(nameOf(coding)), coding) << nameOf(coding);
}

TEST(Coding, AnUnknownNameListsTheKnownOnes) {
  try {
    codingFromName("gif");
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_THAT(error.what(), HasSubstr("png, avif, jpeg"));
  }
}

TEST(Coding, BitsAreThoseOfTheFormat) {
  for (const Coding coding : {Coding::Png, Coding::Avif, Coding::Jpeg}) {
    std::vector<int> supported;
    for (int bits = 0; bits <= 32; ++bits)
      if (supportsBits(coding, bits)) supported.push_back(bits);
    const std::vector<int> expected = coding == Coding::Png    ? std::vector{8, 10, 12, 16}
                                      : coding == Coding::Avif ? std::vector{8, 10, 12}
                                                               : std::vector{8};
    EXPECT_EQ(supported, expected) << nameOf(coding);
  }
}

TEST(AtlasLayout, CellsAreWholeTilesRoundedUp) {
  for (int planes = 1; planes <= 40; ++planes)
    for (const Size tile : {Size{1, 1}, Size{8, 8}, Size{9, 200}, Size{512, 77}})
      for (const bool split : {false, true}) {
        const auto layout = AtlasLayout::forTile(planes, tile, split);
        const auto what = testing::Message() << planes << " planes of " << tile.width << "x"
                                             << tile.height << (split ? " split" : "");
        EXPECT_EQ(layout.cell.width % kCellAlignment, 0) << what;
        EXPECT_EQ(layout.cell.height % kCellAlignment, 0) << what;
        EXPECT_GE(layout.cell.width, tile.width) << what;
        EXPECT_LT(layout.cell.width, tile.width + kCellAlignment) << what;
        EXPECT_GE(layout.columns * layout.rows, layout.cells()) << what;
        EXPECT_LT(layout.columns * (layout.rows - 1), layout.cells()) << what;
      }
}

// The rule of docs/format.md, by exhaustion.
TEST(AtlasLayout, NoOtherNumberOfColumnsMakesTheLongerSideShorter) {
  for (int planes = 1; planes <= 60; ++planes)
    for (const Size tile : {Size{64, 64}, Size{200, 40}, Size{40, 200}}) {
      const auto layout = AtlasLayout::forTile(planes, tile, false);
      const int longer = std::max(layout.atlas().width, layout.atlas().height);
      for (int columns = 1; columns <= layout.cells(); ++columns) {
        const int rows = (layout.cells() + columns - 1) / columns;
        const int other = std::max(columns * layout.cell.width, rows * layout.cell.height);
        EXPECT_GE(other, longer) << planes << " planes, " << columns << " columns";
        if (columns < layout.columns) {
          EXPECT_GT(other, longer) << planes << " planes, " << columns << " columns";
        }
      }
    }
}

TEST(AtlasLayout, RefusesWhatExceedsAnAtlas) {
  EXPECT_EQ(AtlasLayout::forTile(27, {1360, 1360}, false).atlas(), (Size{4080, 4080}));
  EXPECT_THAT(errorOf([] {
                AtlasLayout::forTile(27, {1368, 1368}, false);
              }),
              HasSubstr("do not fit an atlas of 4096x4096"));
  EXPECT_THAT(errorOf([] {
                AtlasLayout::forTile(27, {1360, 1360}, true);
              }),
              HasSubstr("high and low bytes"));
  for (const Size tile : {Size{0, 5}, Size{5, 0}, Size{-8, 8}, Size{2147483647, 1}, Size{4097, 1}})
    EXPECT_NE(errorOf([&] { AtlasLayout::forTile(1, tile, false); }), "") << tile.width;
  for (const int planes : {-1, 0, kMaxPlanes + 1, 2147483647})
    EXPECT_NE(errorOf([&] { AtlasLayout::forTile(planes, {8, 8}, true); }), "") << planes;
}

TEST(DecodeTile, FrozenFilesDecodeToWhatTheyAlwaysDid) {
  for (const FrozenTile& tile : frozenTiles()) {
    const PlaneCodes codes = decode(tile, bytesOf(tile));
    EXPECT_EQ(codes.planes, kFrozenPlanes) << nameOf(tile);
    EXPECT_EQ(codes.tile, kFrozenSize) << nameOf(tile);
    EXPECT_EQ(std::vector<int>(codes.values.begin(), codes.values.end()), tile.expected)
        << nameOf(tile);
  }
}

TEST(DecodeTile, EveryTruncationIsAnErrorThatNamesTheSource) {
  for (const FrozenTile& tile : frozenTiles()) {
    const auto file = bytesOf(tile);
    for (std::size_t length = 0; length < file.size(); ++length)
      EXPECT_THAT(errorOf([&] { decode(tile, std::span(file).first(length)); }),
                  testing::StartsWith("SOURCE"))
          << nameOf(tile) << " of " << length << " bytes";
  }
}

TEST(DecodeTile, EveryFlippedBitIsAnErrorOrATile) {
  for (const FrozenTile& tile : frozenTiles()) {
    auto file = bytesOf(tile);
    int errors = 0;
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
      file[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
      const std::string error = errorOf([&] {
        const PlaneCodes codes = decode(tile, file);
        EXPECT_EQ(codes.values.size(), kFrozenPlanes * kFrozenSize.pixels());
        EXPECT_LE(*std::max_element(codes.values.begin(), codes.values.end()),
                  (1 << tile.bits) - 1);
      });
      errors += error.empty() ? 0 : 1;
      file[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    }
    EXPECT_GT(errors, 0) << nameOf(tile);
  }
}

TEST(DecodeTile, RefusesAPictureThatIsNotTheLayouts) {
  for (const FrozenTile& tile : frozenTiles()) {
    const auto file = bytesOf(tile);
    for (const Size size : {Size{9, 3}, Size{5, 9}, Size{1000, 1000}})
      EXPECT_THAT(
          errorOf([&] { decodeTile(tile.coding, tile.bits, kFrozenPlanes, size, file, "SOURCE"); }),
          HasSubstr("SOURCE: expected"))
          << nameOf(tile);
    EXPECT_THAT(
        errorOf([&] { decodeTile(tile.coding, tile.bits, 9, kFrozenSize, file, "SOURCE"); }),
        HasSubstr("SOURCE: expected"))
        << nameOf(tile);
  }
}

TEST(DecodeTile, RefusesEveryOtherCodingsFiles) {
  for (const FrozenTile& tile : frozenTiles())
    for (const FrozenTile& other : frozenTiles()) {
      if (tile.coding == other.coding) continue;
      EXPECT_THAT(errorOf([&] { decode(tile, bytesOf(other)); }), HasSubstr("SOURCE: expected"))
          << nameOf(other) << " as " << nameOf(tile);
    }
}

TEST(DecodeTile, RefusesAnAvifOfAnotherDepth) {
  for (const FrozenTile& tile : frozenTiles())
    for (const int bits : {8, 10, 12}) {
      if (tile.coding != Coding::Avif || bits == tile.bits) continue;
      EXPECT_THAT(errorOf([&] {
                    decodeTile(Coding::Avif, bits, kFrozenPlanes, kFrozenSize, bytesOf(tile),
                               "SOURCE");
                  }),
                  HasSubstr("another depth"));
    }
}

TEST(DecodeTile, RefusesBitsThatTheCodingCannotHold) {
  EXPECT_THAT(errorOf([] {
                decodeTile(Coding::Jpeg, 12, 3, {8, 8}, {}, "SOURCE");
              }),
              HasSubstr("jpeg cannot hold 12 bits"));
}

TEST(DecodeMaskTile, RefusesAColouredPng) {
  const auto tiles = frozenTiles();
  EXPECT_THAT(errorOf([&] {
                decodeMaskTile({8, 16}, bytesOf(tiles.front()), "SOURCE");
              }),
              HasSubstr("SOURCE: expected a PNG of 8x16 with 1 plain"));
}

}  // namespace
}  // namespace illum
