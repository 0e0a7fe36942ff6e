#include <fmt/format.h>

#include <cmath>

#include "illum/error.h"
#include "illum/lumigraph.h"

namespace illum {
namespace {

class ViewsInMemory final : public ViewSource {
 public:
  explicit ViewsInMemory(std::span<const SourceView> sources) : sources_(sources) {
    if (sources.empty()) throw Error(Fault::Input, "expected at least one view, found none");
    for (const SourceView& source : sources) {
      views_.push_back(source.view);
      check(source);
      hasBackdrop_ = hasBackdrop_ || coversWithoutDepth(source);
    }
  }

  const std::vector<View>& views() const override { return views_; }
  int channels() const override { return sources_.front().picture.channels(); }
  bool hasDepth() const override { return !sources_.front().depth.empty(); }
  bool hasBackdrop() const override { return hasBackdrop_; }
  std::shared_ptr<const Picture> picture(int view) override { return unowned(at(view).picture); }
  std::shared_ptr<const Picture> depth(int view) override { return unowned(at(view).depth); }

 private:
  const SourceView& at(int view) const { return sources_[static_cast<std::size_t>(view)]; }
  static std::shared_ptr<const Picture> unowned(const Picture& picture) {
    return {std::shared_ptr<const Picture>(), &picture};
  }

  bool coversWithoutDepth(const SourceView& source) const {
    const auto depth = source.depth.samples();
    const auto stride = static_cast<std::size_t>(channels());
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const float coverage = source.picture.samples()[i * stride + stride - 1];
      if (!std::isfinite(depth[i]) && coverage > 0) return true;
    }
    return false;
  }

  void check(const SourceView& source) const {
    const Size size = sizeOf(source.view.geometry);
    const auto complain = [&](std::string_view expected, const Picture& found) {
      throw Error(Fault::Input, fmt::format("view '{}': expected {}, found {}x{} of {} channels",
                                            source.view.name, expected, found.width(),
                                            found.height(), found.channels()));
    };
    if (source.picture.size() != size || source.picture.channels() != channels() ||
        channels() < 2) {
      complain(fmt::format("a picture of {}x{} with coverage, and channels as the first view's",
                           size.width, size.height),
               source.picture);
    }
    const bool fits = source.depth.empty() ? !hasDepth()
                                           : hasDepth() && source.depth.size() == size &&
                                                 source.depth.channels() == 1;
    if (!fits) {
      complain(fmt::format("depth of {}x{} for all views or for none", size.width, size.height),
               source.depth);
    }
  }

  std::span<const SourceView> sources_;
  std::vector<View> views_;
  bool hasBackdrop_ = false;
};

}  // namespace

std::unique_ptr<ViewSource> viewSource(std::span<const SourceView> views) {
  return std::make_unique<ViewsInMemory>(views);
}

}  // namespace illum
