#include "lumigraph/object_views.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "object/manifest.h"

namespace illum {
namespace {

std::uint64_t bytesOf(const Picture& picture) {
  return picture.samples().size_bytes();
}

std::vector<int> allGroups(const Object& object) {
  std::vector<int> groups(static_cast<std::size_t>(object.groups()));
  std::iota(groups.begin(), groups.end(), 0);
  return groups;
}

}  // namespace

ObjectViews::ObjectViews(Object object, std::uint64_t memoryBytes)
    : ObjectViews(object, memoryBytes, allGroups(object), 4) {}

ObjectViews::ObjectViews(Object object, std::uint64_t memoryBytes, std::vector<int> groups,
                         int channels)
    : object_(std::move(object)),
      memoryBytes_(memoryBytes),
      groups_(std::move(groups)),
      channels_(channels) {
  for (const int group : groups_) {
    views_.push_back(object_.view(group));
    hasDepth_ = hasDepth_ && object_.hasDepth(group);
  }
}

Picture ObjectViews::withCoverage(Picture picture) const {
  if (picture.channels() == channels_) return picture;
  const auto colours = static_cast<std::size_t>(channels_) - 1;
  Picture covered(picture.size(), channels_);
  for (std::size_t i = 0; i < picture.size().pixels(); ++i) {
    float* out = &covered.samples()[(colours + 1) * i];
    std::copy_n(&picture.samples()[colours * i], colours, out);
    out[colours] = 1;
  }
  return covered;
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
  const int group = groups_[static_cast<std::size_t>(view)];
  return kept({false, view}, [&] {
    return relit_ ? withCoverage(relit_(group)) : Picture(object_.size(group), channels_);
  });
}

std::shared_ptr<const Picture> ObjectViews::depth(int view) {
  return kept({true, view}, [&] { return depthOf(groups_[static_cast<std::size_t>(view)]); });
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
