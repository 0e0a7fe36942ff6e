#include "relight/tile_cache.h"

#include <utility>

namespace illum {
namespace {

std::uint64_t bytesOf(const PlaneCodes& codes) {
  return codes.values.size() * sizeof(codes.values[0]);
}

}  // namespace

std::shared_ptr<const PlaneCodes> TileCache::planes(const TileKey& key) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = entries_.find(key); found != entries_.end()) {
      uses_.splice(uses_.begin(), uses_, found->second.use);
      return found->second.codes;
    }
  }
  auto codes =
      std::make_shared<const PlaneCodes>(object_.planeTile(key.group, key.level, key.x, key.y));
  keep(key, codes);
  return codes;
}

void TileCache::keep(const TileKey& key, const std::shared_ptr<const PlaneCodes>& codes) {
  const std::scoped_lock lock(mutex_);
  if (entries_.contains(key) || bytesOf(*codes) > memoryBytes_) return;
  usedBytes_ += bytesOf(*codes);
  while (usedBytes_ > memoryBytes_) {
    const auto oldest = entries_.find(uses_.back());
    usedBytes_ -= bytesOf(*oldest->second.codes);
    entries_.erase(oldest);
    uses_.pop_back();
  }
  uses_.push_front(key);
  entries_.emplace(key, Entry{codes, uses_.begin()});
}

}  // namespace illum
