// Decoded tiles of an object, kept within a bound of memory.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "illum/object.h"
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
  TileCache(Object object, std::uint64_t memoryBytes)
      : object_(std::move(object)), memoryBytes_(memoryBytes) {}

  /// The codes, decoded now or earlier. Two threads that miss at once may both decode.
  std::shared_ptr<const TilePlanes> planes(const TileKey& key);

  const Object& object() const { return object_; }

 private:
  struct Entry {
    std::shared_ptr<const TilePlanes> codes;
    std::list<TileKey>::iterator use;
  };
  void keep(const TileKey& key, const std::shared_ptr<const TilePlanes>& codes);

  Object object_;
  std::uint64_t memoryBytes_, usedBytes_ = 0;
  std::mutex mutex_;
  std::map<TileKey, Entry> entries_;
  std::list<TileKey> uses_;  // most recent first
};

}  // namespace illum
