#include "illum/lumigraph.h"

#include <deque>

#include "illum/relight.h"
#include "lumigraph/default_focus.h"
#include "lumigraph/object_views.h"
#include "lumigraph/sharpest_plane.h"

namespace illum {

// Of the memory a third is for tiles as they are decoded, the rest for pictures and depths.
struct Lumigraph::State {
  State(const Object& source, std::uint64_t memoryBytes)
      : object(source),
        relighter(object, memoryBytes / 3),
        views(object, memoryBytes - memoryBytes / 3) {}
  Object object;
  Relighter relighter;
  ObjectViews views;
  std::optional<std::optional<Plane>> sharpest;  // set when it was looked for

  // Cameras that all look the same way say nothing of how far away things are, and without depth
  // neither does anything else.
  bool needsFocus(const SynthesisOptions& options) const {
    if (options.focus || views.hasDepth()) return false;
    std::deque<ViewProjector> projectors;
    std::vector<const ViewProjector*> all;
    for (const View& view : views.views()) {
      if (!std::holds_alternative<PinholeCamera>(view.geometry)) return false;
      all.push_back(&projectors.emplace_back(view.geometry));
    }
    return !planeLookedAt(all);
  }
};

Lumigraph::Lumigraph(Object object, std::uint64_t memoryBytes)
    : state_(std::make_unique<State>(object, memoryBytes)) {}
Lumigraph::~Lumigraph() = default;

const Object& Lumigraph::object() const {
  return state_->object;
}

void Lumigraph::setLights(const Illumination& lights) {
  // Under other lights there may be something to see.
  if (state_->sharpest && !*state_->sharpest) state_->sharpest.reset();
  // Views share what a slab's lights come down to; what was prepared last is of the slab at hand.
  state_->views.setRelit([relighter = &state_->relighter,
                          latest = state_->relighter.prepare(lights)](int group) mutable {
    latest = relighter->prepareAlso(latest, group);
    return relighter->relight(latest);
  });
}

void Lumigraph::setLights(std::span<const DirectionalLight> lights) {
  setLights(Illumination{{lights.begin(), lights.end()}, {}, {}});
}

SynthesisedView Lumigraph::see(const ViewGeometry& camera, const SynthesisOptions& options) {
  if (!state_->needsFocus(options)) return synthesise(state_->views, camera, options);
  if (!state_->sharpest) state_->sharpest = sharpestPlane(state_->views);
  SynthesisOptions focused = options;
  focused.focus = *state_->sharpest;
  return synthesise(state_->views, camera, focused);
}

Vector3 Lumigraph::middle() const {
  return middleOf(state_->views.views());
}

}  // namespace illum
