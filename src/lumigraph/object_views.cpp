#include "lumigraph/object_views.h"

#include <algorithm>

#include "object/manifest.h"

namespace illum {
namespace {

std::uint64_t bytesOf(const Picture& picture) {
  return picture.samples().size_bytes();
}

Picture withCoverage(Picture picture) {
  if (picture.channels() == 4) return picture;
  Picture covered(picture.size(), 4);
  for (std::size_t i = 0; i < picture.size().pixels(); ++i) {
    std::copy_n(&picture.samples()[3 * i], 3, &covered.samples()[4 * i]);
    covered.samples()[4 * i + 3] = 1;
  }
  return covered;
}

}  // namespace

ObjectViews::ObjectViews(Object object, std::uint64_t memoryBytes)
    : object_(std::move(object)), memoryBytes_(memoryBytes) {
  for (int group = 0; group < object_.groups(); ++group) {
    views_.push_back(object_.view(group));
    hasDepth_ = hasDepth_ && object_.hasDepth(group);
  }
}

void ObjectViews::setRelit(std::function<Picture(int group)> relit) {
  relit_ = std::move(relit);
  for (auto at = latest_.begin(); at != latest_.end();) {
    const auto here = at++;
    if (here->key.isDepth) continue;
    keptBytes_ -= bytesOf(*here->picture);
    found_.erase(here->key);
    latest_.erase(here);
  }
}

template <typename Make>
std::shared_ptr<const Picture> ObjectViews::kept(const Key& key, const Make& make) {
  if (const auto found = found_.find(key); found != found_.end()) {
    latest_.splice(latest_.begin(), latest_, found->second);
    return found->second->picture;
  }
  auto picture = std::make_shared<const Picture>(make());
  keptBytes_ += bytesOf(*picture);
  latest_.push_front({key, picture});
  found_[key] = latest_.begin();
  while (keptBytes_ > memoryBytes_ && latest_.size() > 1) {
    keptBytes_ -= bytesOf(*latest_.back().picture);
    found_.erase(latest_.back().key);
    latest_.pop_back();
  }
  return picture;
}

std::shared_ptr<const Picture> ObjectViews::picture(int view) {
  return kept({false, view},
              [&] { return relit_ ? withCoverage(relit_(view)) : Picture(object_.size(view), 4); });
}

std::shared_ptr<const Picture> ObjectViews::depth(int view) {
  return kept({true, view}, [&] { return depthOf(view); });
}

Picture ObjectViews::depthOf(int group) const {
  const TileGrid grid = object_.manifest().grid(group);
  Picture depth(object_.size(group), 1);
  for (int y = 0; y < grid.tilesDown(0); ++y) {
    for (int x = 0; x < grid.tilesAcross(0); ++x) {
      const Rectangle tile = grid.tileRectangle(0, x, y);
      const std::vector<float> values = object_.depthTile(group, 0, x, y);
      for (int row = 0; row < tile.height; ++row) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(row) * tile.width, tile.width,
                    depth.row(tile.y + row).begin() + tile.x);
      }
    }
  }
  return depth;
}

}  // namespace illum
