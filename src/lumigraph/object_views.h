// The views of an object as a source for synthesis.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <vector>

#include "illum/lumigraph.h"

namespace illum {

/// Pictures come from `relit(group)`; they and depths are kept, the latest used within
/// `memoryBytes`.
class ObjectViews final : public ViewSource {
 public:
  /// All views of the object, in RGBA.
  ObjectViews(Object object, std::uint64_t memoryBytes);
  /// Some of them; `channels` as ViewSource's.
  ObjectViews(Object object, std::uint64_t memoryBytes, std::vector<int> groups, int channels);

  /// From now on; forgets pictures, not depths. Pictures of one channel less than the source has
  /// count as covered everywhere.
  void setRelit(std::function<Picture(int group)> relit);

  const std::vector<View>& views() const override { return views_; }
  int channels() const override { return channels_; }
  bool hasDepth() const override { return hasDepth_; }
  bool hasBackdrop() const override { return !object_.hasMask(); }
  std::shared_ptr<const Picture> picture(int view) override;
  std::shared_ptr<const Picture> depth(int view) override;

 private:
  struct Key {
    bool isDepth = false;
    int view = 0;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  struct Kept {
    Key key;
    std::shared_ptr<const Picture> picture;
  };
  template <typename Make>
  std::shared_ptr<const Picture> kept(const Key& key, const Make& make);
  Picture withCoverage(Picture picture) const;
  Picture depthOf(int group) const;

  Object object_;
  std::uint64_t memoryBytes_, keptBytes_ = 0;
  std::function<Picture(int)> relit_;
  std::vector<int> groups_;  // of the views
  int channels_;
  std::vector<View> views_;
  bool hasDepth_ = true;
  std::list<Kept> latest_;  // the latest used first
  std::map<Key, std::list<Kept>::iterator> found_;
};

}  // namespace illum
