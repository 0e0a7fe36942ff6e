#include "relight/tile_cache.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

namespace illum {
namespace {

// A tile of one byte: where it lies.
TilePlanes tileAt(const TileKey& key) {
  return {PlaneCodes{1, {1, 1}, {static_cast<std::uint16_t>(16 * key.y + key.x)}}, 8};
}

TEST(TileCache, KeepsWhatWasUsedLastWithinItsMemory) {
  int decoded = 0;
  TileCache cache(
      [&](const TileKey& key) {
        ++decoded;
        return tileAt(key);
      },
      3);
  for (const int x : {0, 1, 2}) EXPECT_EQ(cache.planes({0, 0, x, 5})->code(0, 0), 80 + x);
  EXPECT_EQ(decoded, 3);
  cache.planes({0, 0, 0, 5});  // used again: the next is the oldest
  EXPECT_EQ(decoded, 3);
  cache.planes({0, 0, 3, 5});
  EXPECT_EQ(decoded, 4);
  for (const int x : {0, 2, 3}) cache.planes({0, 0, x, 5});
  EXPECT_EQ(decoded, 4);
  cache.planes({0, 0, 1, 5});
  EXPECT_EQ(decoded, 5);
}

TEST(TileCache, LetsGoOfWhatItDoesNotKeep) {
  TileCache cache(tileAt, 2);
  std::vector<std::weak_ptr<const TilePlanes>> seen;
  for (int x = 0; x < 9; ++x) {
    seen.push_back(cache.planes({0, 0, x, 0}));
    EXPECT_LE(std::ranges::count_if(seen, [](const auto& tile) { return !tile.expired(); }), 2);
  }
  EXPECT_FALSE(seen.back().expired());
}

TEST(TileCache, ATileInUseOutlivesItsPlace) {
  TileCache cache(tileAt, 1);
  const auto first = cache.planes({0, 0, 7, 1});
  cache.planes({0, 0, 8, 1});
  EXPECT_EQ(first->code(0, 0), 23);
}

TEST(TileCache, WithoutRoomForATileNothingIsKept) {
  int decoded = 0;
  TileCache cache(
      [&](const TileKey& key) {
        ++decoded;
        return tileAt(key);
      },
      0);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(cache.planes({0, 0, 2, 1})->code(0, 0), 18);
  EXPECT_EQ(decoded, 3);
}

TEST(TileCache, GivesManyThreadsTheirTiles) {
  TileCache cache(tileAt, 10);
  std::atomic<int> wrong = 0;
  tbb::parallel_for(0, 5000, [&](int i) {
    const TileKey key{0, 0, i % 16, i / 7 % 13};
    if (cache.planes(key)->code(0, 0) != 16 * key.y + key.x) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace illum
