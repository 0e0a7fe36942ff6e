// The views of an object as a source for synthesis.
#pragma once

#include <functional>
#include <list>
#include <map>

#include "illum/lumigraph.h"

namespace illum {

/// RGBA pictures come from `relit(group)`; they and depths are kept, the latest used within
/// `memoryBytes`.
class ObjectViews final : public ViewSource {
 public:
  ObjectViews(Object object, std::uint64_t memoryBytes);

  /// From now on; forgets pictures, not depths. RGB counts as covered everywhere.
  void setRelit(std::function<Picture(int group)> relit);

  const std::vector<View>& views() const override { return views_; }
  int channels() const override { return 4; }
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
  Picture depthOf(int group) const;

  Object object_;
  std::uint64_t memoryBytes_, keptBytes_ = 0;
  std::function<Picture(int)> relit_;
  std::vector<View> views_;
  bool hasDepth_ = true;
  std::list<Kept> latest_;  // the latest used first
  std::map<Key, std::list<Kept>::iterator> found_;
};

}  // namespace illum
