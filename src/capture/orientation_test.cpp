#include "capture/orientation.h"

#include <gtest/gtest.h>

#include <set>

namespace illum {
namespace {

constexpr Size kStored{5, 3};

TEST(Orientation, UprightSizeExchangesSidesFromFiveOn) {
  for (int exif = 1; exif <= 8; ++exif) {
    EXPECT_EQ(Orientation{exif}.upright(kStored), (exif < 5 ? kStored : Size{3, 5})) << exif;
  }
}

TEST(Orientation, EveryStoredPixelIsOneUprightPixelAndBack) {
  for (int exif = 1; exif <= 8; ++exif) {
    const Orientation orientation{exif};
    const Size upright = orientation.upright(kStored);
    const Orientation::Map map = orientation.storedFromUpright(kStored);
    std::set<std::pair<int, int>> seen;
    for (int y = 0; y < upright.height; ++y) {
      for (int x = 0; x < upright.width; ++x) {
        const int storedX = map.x0 + map.xx * x + map.xy * y;
        const int storedY = map.y0 + map.yx * x + map.yy * y;
        ASSERT_TRUE(storedX >= 0 && storedX < kStored.width) << exif << " " << x << " " << y;
        ASSERT_TRUE(storedY >= 0 && storedY < kStored.height) << exif << " " << x << " " << y;
        seen.emplace(storedX, storedY);
        EXPECT_EQ(orientation.uprightFromStored(kStored, {storedX, storedY}),
                  (Orientation::Position{x, y}))
            << exif;
      }
    }
    EXPECT_EQ(seen.size(), kStored.pixels()) << exif;
  }
}

// Exif 2.32, table of tag 0x0112: which side of the upright picture the stored row 0 and column 0
// are.
TEST(Orientation, FirstRowAndColumnAreWhereExifSaysTheyAre) {
  struct Sides {
    int exif;
    char row, column;  // t(op), b(ottom), l(eft), r(ight)
  };
  const auto sideOf = [](const Orientation& o, bool row) {
    const Size upright = o.upright(kStored);
    const int last = row ? kStored.width - 1 : kStored.height - 1;
    const auto a = o.uprightFromStored(kStored, {0, 0});
    const auto b = o.uprightFromStored(
        kStored, row ? Orientation::Position{last, 0} : Orientation::Position{0, last});
    if (a.y == b.y) return a.y == 0 ? 't' : a.y == upright.height - 1 ? 'b' : '?';
    return a.x == 0 ? 'l' : a.x == upright.width - 1 ? 'r' : '?';
  };
  for (const Sides& sides :
       {Sides{1, 't', 'l'}, Sides{2, 't', 'r'}, Sides{3, 'b', 'r'}, Sides{4, 'b', 'l'},
        Sides{5, 'l', 't'}, Sides{6, 'r', 't'}, Sides{7, 'r', 'b'}, Sides{8, 'l', 'b'}}) {
    EXPECT_EQ(sideOf({sides.exif}, true), sides.row) << sides.exif;
    EXPECT_EQ(sideOf({sides.exif}, false), sides.column) << sides.exif;
  }
}

TEST(Orientation, OnlyTheFirstTwoKeepTheOrderOfRows) {
  for (int exif = 1; exif <= 8; ++exif) {
    EXPECT_EQ(Orientation{exif}.keepsRowOrder(), exif <= 2) << exif;
  }
}

}  // namespace
}  // namespace illum
