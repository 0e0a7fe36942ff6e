#include "relight/tile_cache.h"

namespace illum {

std::shared_ptr<const TilePlanes> TileCache::planes(const TileKey& key) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = entries_.find(key); found != entries_.end()) {
      uses_.splice(uses_.begin(), uses_, found->second.use);
      return found->second.codes;
    }
  }
  auto codes = std::make_shared<const TilePlanes>(decode_(key));
  keep(key, codes);
  return codes;
}

void TileCache::keep(const TileKey& key, const std::shared_ptr<const TilePlanes>& codes) {
  const std::scoped_lock lock(mutex_);
  if (entries_.contains(key) || codes->memoryBytes() > memoryBytes_) return;
  usedBytes_ += codes->memoryBytes();
  while (usedBytes_ > memoryBytes_) {
    const auto oldest = entries_.find(uses_.back());
    usedBytes_ -= oldest->second.codes->memoryBytes();
    entries_.erase(oldest);
    uses_.pop_back();
  }
  uses_.push_front(key);
  entries_.emplace(key, Entry{codes, uses_.begin()});
}

}  // namespace illum
