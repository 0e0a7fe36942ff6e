#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/memory.h"
#include "illum/capture_folder.h"
#include "illum/colour.h"
#include "illum/error.h"
#include "lumigraph/swept_depth.h"

namespace illum {
namespace {

// The mean of so many lights' pictures is compared: what one light hides another shows.
constexpr std::size_t kMostLights = 4;
// Only views that look about the same way are compared: within 45 degrees.
constexpr double kLeastCosine = 0.7;
constexpr std::size_t kKeptDepths = 2;
// Bytes a pixel while a depth is found: of the picture, linear, displayed and as it is read, and
// kept depths; of the small one, costs, weights and the first look.
constexpr std::uint64_t kBytesPerPixel = 12 + 12 + 12 + 4 * (1 + kKeptDepths),
                        kBytesPerSmallPixel = 176;

// What was made last, by the number of its view.
template <typename Made>
class Latest {
 public:
  explicit Latest(std::size_t most) : most_(most) {}
  template <typename Make>
  std::shared_ptr<const Made> get(int view, const Make& make) {
    const auto found = std::ranges::find(made_, view, &Entry::first);
    if (found != made_.end()) {
      made_.splice(made_.begin(), made_, found);
    } else {
      auto made = std::make_shared<const Made>(make());
      made_.emplace_front(view, std::move(made));
      if (made_.size() > most_) made_.pop_back();
    }
    return made_.front().second;
  }

 private:
  using Entry = std::pair<int, std::shared_ptr<const Made>>;
  std::size_t most_;
  std::list<Entry> made_;
};

class SweptCapture final : public Capture {
 public:
  SweptCapture(std::unique_ptr<Capture> inner, std::uint64_t memoryBytes)
      : inner_(std::move(inner)),
        memoryBytes_(memoryBytes),
        smalls_(smallsWithin(memoryBytes)),
        depths_(kKeptDepths) {
    for (const View& view : inner_->views()) projectors_.emplace_back(view.geometry);
    const std::size_t count = std::min(kMostLights, lights().size());
    for (std::size_t i = 0; i < count; ++i)
      compared_.push_back(static_cast<int>(i * lights().size() / count));
  }

  const std::vector<View>& views() const override { return inner_->views(); }
  Transfer transfer() const override { return inner_->transfer(); }
  const std::vector<LightFileEntry>& lights() const override { return inner_->lights(); }
  bool hasMask() const override { return inner_->hasMask(); }
  bool hasDepth() const override { return true; }
  void read(int group, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override {
    inner_->read(group, rectangle, lights, samples);
  }
  const ByteSamples* bytes() const override { return inner_->bytes(); }
  void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const override {
    inner_->readMask(group, rectangle, coverage);
  }
  void readDepth(int group, const Rectangle& rectangle, std::span<float> depth) const override {
    const auto whole = depthOf(group);
    for (int y = 0; y < rectangle.height; ++y) {
      const auto row = whole->row(rectangle.y + y).subspan(static_cast<std::size_t>(rectangle.x));
      std::copy_n(row.begin(), rectangle.width,
                  depth.begin() + static_cast<std::ptrdiff_t>(y) * rectangle.width);
    }
  }
  int bandRows() const override { return inner_->bandRows(); }
  std::uint64_t residentBytes() const override { return inner_->residentBytes() + memoryBytes_; }
  std::string fingerprint() const override { return inner_->fingerprint() + "\nswept depth 1"; }

 private:
  std::size_t smallsWithin(std::uint64_t memoryBytes) const {
    std::uint64_t pixels = 0;
    for (int view = 0; view < groups(); ++view)
      pixels = std::max<std::uint64_t>(pixels, size(view).pixels());
    const std::uint64_t small = std::min<std::uint64_t>(
        pixels, static_cast<std::uint64_t>(kSweptSide) * static_cast<std::uint64_t>(kSweptSide));
    const std::uint64_t work = kBytesPerPixel * pixels + kBytesPerSmallPixel * small;
    const std::uint64_t one = 12 * small, least = work + (kSweptNeighbours + 1) * one;
    if (memoryBytes < least) {
      throw Error(Fault::Machine,
                  fmt::format("memory: finding depth takes at least {} beside the photographs, "
                              "there are {}",
                              textFromBytes(least), textFromBytes(memoryBytes)));
    }
    return static_cast<std::size_t>((memoryBytes - work) / one);
  }

  std::shared_ptr<const Picture> depthOf(int view) const {
    const std::scoped_lock lock(mutex_);
    // Whoever holds the lock must not take up other work that waits for it.
    return tbb::this_task_arena::isolate(
        [&] { return depths_.get(view, [&] { return sweptDepthOf(view); }); });
  }

  // Linear, of the mean over the lights that are compared.
  Picture pictureOf(int view) const {
    const Size size = inner_->size(view);
    Picture picture(size, 3);
    std::vector<float> samples(3 * size.pixels());
    const float share = 1 / static_cast<float>(compared_.size());
    for (const int light : compared_) {
      inner_->read(view, {0, 0, size.width, size.height}, {&light, 1}, samples);
      for (std::size_t c = 0; c < 3; ++c) {
        const float* plane = samples.data() + c * size.pixels();
        for (std::size_t p = 0; p < size.pixels(); ++p) {
          const float linear =
              transfer() == Transfer::Display ? linearFromDisplay(plane[p]) : plane[p];
          picture.samples()[3 * p + c] += share * linear;
        }
      }
    }
    return picture;
  }

  std::shared_ptr<const SmallView> smallOf(int view) const {
    return smalls_.get(view, [&] {
      return SmallView{projectors_[static_cast<std::size_t>(view)],
                       SmallPicture(pictureOf(view), kSweptSide)};
    });
  }

  // The nearest ones at other places that look about the same way.
  std::vector<int> neighboursOf(int view) const {
    const ViewProjector& own = projectors_[static_cast<std::size_t>(view)];
    std::vector<std::pair<double, int>> others;
    for (int other = 0; other < groups(); ++other) {
      const ViewProjector& projector = projectors_[static_cast<std::size_t>(other)];
      const double apart = length(projector.eye() - own.eye());
      if (apart > 0 && dot(projector.axis(), own.axis()) >= kLeastCosine)
        others.emplace_back(apart, other);
    }
    std::ranges::sort(others);
    others.resize(std::min(others.size(), kSweptNeighbours));
    std::vector<int> nearest;
    for (const auto& [apart, other] : others) nearest.push_back(other);
    return nearest;
  }

  Picture sweptDepthOf(int view) const {
    std::vector<std::shared_ptr<const SmallView>> held;
    for (const int other : neighboursOf(view)) held.push_back(smallOf(other));
    if (held.empty()) {
      Picture unknown(size(view), 1);
      std::ranges::fill(unknown.samples(), std::numeric_limits<float>::infinity());
      return unknown;
    }
    std::vector<const SmallView*> neighbours;
    for (const auto& small : held) neighbours.push_back(small.get());
    const Picture picture = pictureOf(view);
    const SmallView own{projectors_[static_cast<std::size_t>(view)],
                        SmallPicture(picture, kSweptSide)};
    Picture depth = sweptDepth(picture, own, neighbours);
    if (hasMask()) {
      std::vector<float> coverage(depth.size().pixels());
      readMask(view, {0, 0, depth.width(), depth.height()}, coverage);
      for (std::size_t p = 0; p < coverage.size(); ++p) {
        if (!(coverage[p] > 0)) depth.samples()[p] = std::numeric_limits<float>::infinity();
      }
    }
    return depth;
  }

  std::unique_ptr<Capture> inner_;
  std::uint64_t memoryBytes_;
  std::vector<ViewProjector> projectors_;
  std::vector<int> compared_;  // lights
  mutable std::mutex mutex_;
  mutable Latest<SmallView> smalls_;
  mutable Latest<Picture> depths_;
};

}  // namespace

std::unique_ptr<Capture> withSweptDepth(std::unique_ptr<Capture> capture,
                                        std::uint64_t memoryBytes) {
  if (capture->hasDepth() || capture->isRendered())
    throw Error(Fault::Usage, "depth is to be found by comparing views: expected none, found some");
  bool severalPlaces = false;
  const ViewProjector first(capture->views().front().geometry);
  for (const View& view : capture->views()) {
    const ViewProjector projector(view.geometry);
    if (!projector.isPerspective())
      throw Error(Fault::Usage, fmt::format("depth is to be found by comparing views: expected "
                                            "cameras or slabs, found {}, which is neither",
                                            view.name.empty() ? "a photograph" : view.name));
    severalPlaces = severalPlaces || !(projector.eye() == first.eye());
  }
  if (!severalPlaces)
    throw Error(Fault::Usage,
                "depth is to be found by comparing views: expected views from two places at "
                "least, found one");
  return std::make_unique<SweptCapture>(std::move(capture), memoryBytes);
}

}  // namespace illum
