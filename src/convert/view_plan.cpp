#include "convert/view_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "illum/error.h"

namespace illum {
namespace {

// The place on the old grid at which one of the new grid stands, if there is one. A single place
// stands in the middle.
std::optional<int> placeOnOldGrid(int place, int count, int oldCount) {
  const int steps = count > 1 ? count - 1 : 2, at = count > 1 ? place : 1;
  if (oldCount == 1) return count == 1 || 2 * at == steps ? std::optional(0) : std::nullopt;
  if (at * (oldCount - 1) % steps != 0) return std::nullopt;
  return at * (oldCount - 1) / steps;
}

std::vector<LightSlab> slabsOf(const Manifest& manifest) {
  std::vector<LightSlab> slabs;
  for (const GroupEntry& group : manifest.groups) {
    const auto* view = std::get_if<SlabView>(&group.view.geometry);
    if (view == nullptr) {
      throw Error(Fault::Input, fmt::format("expected an object of slabs, as another grid of view "
                                            "points is asked for, found the view '{}'",
                                            group.view.name));
    }
    if (std::ranges::find(slabs, view->slab) == slabs.end()) slabs.push_back(view->slab);
  }
  return slabs;
}

std::vector<int> groupsOf(const Manifest& manifest, const LightSlab& slab) {
  std::vector<int> groups;
  for (std::size_t g = 0; g < manifest.groups.size(); ++g) {
    if (std::get<SlabView>(manifest.groups[g].view.geometry).slab == slab)
      groups.push_back(static_cast<int>(g));
  }
  return groups;
}

std::optional<int> groupAt(const Manifest& manifest, const std::vector<int>& groups, int u, int v) {
  for (const int g : groups) {
    const auto& view = std::get<SlabView>(manifest.view(g).geometry);
    if (view.u == u && view.v == v) return g;
  }
  return std::nullopt;
}

}  // namespace

std::vector<PlannedView> viewsAsTheyAre(const Manifest& manifest) {
  std::vector<PlannedView> views;
  for (const GroupEntry& group : manifest.groups)
    views.push_back({group, static_cast<int>(views.size()), {}});
  return views;
}

std::vector<PlannedView> viewsOnGrid(const Manifest& manifest, int uCount, int vCount) {
  std::vector<PlannedView> views;
  for (const LightSlab& old : slabsOf(manifest)) {
    const std::vector<int> sources = groupsOf(manifest, old);
    LightSlab slab = old;
    slab.uCount = uCount;
    slab.vCount = vCount;
    for (int v = 0; v < vCount; ++v) {
      for (int u = 0; u < uCount; ++u) {
        PlannedView planned;
        const auto oldU = placeOnOldGrid(u, uCount, old.uCount);
        const auto oldV = placeOnOldGrid(v, vCount, old.vCount);
        if (oldU && oldV) planned.stored = groupAt(manifest, sources, *oldU, *oldV);
        if (!planned.stored) planned.sources = sources;
        const int like = planned.stored.value_or(sources.front());
        planned.entry = manifest.groups[static_cast<std::size_t>(like)];
        planned.entry.view = {fmt::format("{}_u{:02}_v{:02}", slab.name, u, v),
                              SlabView{slab, u, v}};
        views.push_back(std::move(planned));
      }
    }
  }
  return views;
}

}  // namespace illum
