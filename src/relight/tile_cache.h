// Decoded tiles, kept within a bound of memory.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "relight/tile_planes.h"

namespace illum {

struct TileKey {
  int group = 0, level = 0, x = 0, y = 0;
  friend auto operator<=>(const TileKey&, const TileKey&) = default;
};

/// Least recently used tiles leave first. Thread safe; a tile in use outlives its place in the
/// cache.
class TileCache {
 public:
  using Decode = std::function<TilePlanes(const TileKey&)>;

  /// `decode` is called from several threads.
  TileCache(Decode decode, std::uint64_t memoryBytes)
      : decode_(std::move(decode)), memoryBytes_(memoryBytes) {}

  /// The codes, decoded now or earlier. Two threads that miss at once may both decode.
  std::shared_ptr<const TilePlanes> planes(const TileKey& key);

 private:
  struct Entry {
    std::shared_ptr<const TilePlanes> codes;
    std::list<TileKey>::iterator use;
  };
  void keep(const TileKey& key, const std::shared_ptr<const TilePlanes>& codes);

  Decode decode_;
  std::uint64_t memoryBytes_, usedBytes_ = 0;
  std::mutex mutex_;
  std::map<TileKey, Entry> entries_;
  std::list<TileKey> uses_;  // most recent first
};

}  // namespace illum
