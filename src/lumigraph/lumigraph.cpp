#include "illum/lumigraph.h"

#include "illum/relight.h"
#include "lumigraph/default_focus.h"
#include "lumigraph/object_views.h"

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
};

Lumigraph::Lumigraph(Object object, std::uint64_t memoryBytes)
    : state_(std::make_unique<State>(object, memoryBytes)) {}
Lumigraph::~Lumigraph() = default;

const Object& Lumigraph::object() const {
  return state_->object;
}

void Lumigraph::setLights(const Illumination& lights) {
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
  return synthesise(state_->views, camera, options);
}

Vector3 Lumigraph::middle() const {
  return middleOf(state_->views.views());
}

}  // namespace illum
