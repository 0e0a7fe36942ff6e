#include "lumigraph/view_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "illum/error.h"
#include "lumigraph/view_projector.h"

namespace illum {
namespace {

// In cells of the grid: what is this near to a view point means that view, decimal fractions being
// no thirds.
constexpr double kSamePlace = 1e-4;

const SlabView* slabViewOf(const View& view) {
  return std::get_if<SlabView>(&view.geometry);
}

std::optional<double> fraction(std::string_view text) {
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value >= 0 && value <= 1 ? std::optional(value) : std::nullopt;
}

// The column or row at a fraction of the grid, if there is one.
std::optional<int> placeAt(double share, int count) {
  const double cells = share * (count - 1);
  const double nearest = std::round(cells);
  if (count > 1 && std::abs(cells - nearest) > kSamePlace) return std::nullopt;
  return static_cast<int>(nearest);
}

ViewChoice viewOf(std::span<const View> views, const LightSlab& slab, double u, double v) {
  const auto column = placeAt(u, slab.uCount), row = placeAt(v, slab.vCount);
  if (column && row) {
    const ViewGeometry place = SlabView{slab, *column, *row};
    const auto found = std::ranges::find(views, place, &View::geometry);
    if (found != views.end()) return {static_cast<int>(found - views.begin()), place, slab};
  }
  return {std::nullopt, pinholeOf(slab, u, v), slab};
}

// Of "slab:u,v" or "u,v"; empty if it is none or no slab has that name.
std::optional<ViewChoice> betweenViews(std::span<const View> views, std::string_view name) {
  const auto colon = name.rfind(':');
  const std::string_view slab = colon == name.npos ? "" : name.substr(0, colon);
  const std::string_view place = colon == name.npos ? name : name.substr(colon + 1);
  const auto comma = place.find(',');
  if (comma == place.npos) return std::nullopt;
  const auto u = fraction(place.substr(0, comma)), v = fraction(place.substr(comma + 1));
  if (!u || !v) return std::nullopt;
  for (const View& view : views) {
    const SlabView* at = slabViewOf(view);
    if (at == nullptr || (colon != name.npos && at->slab.name != slab)) continue;
    return viewOf(views, at->slab, *u, *v);
  }
  return std::nullopt;
}

std::string slabsOf(std::span<const View> views) {
  std::vector<std::string> names;
  for (const View& view : views) {
    const SlabView* at = slabViewOf(view);
    if (at != nullptr && std::ranges::find(names, at->slab.name) == names.end())
      names.push_back(at->slab.name);
  }
  constexpr std::size_t kMostShown = 8;
  const bool all = names.size() <= kMostShown;
  names.resize(std::min(names.size(), kMostShown));
  return fmt::format("{}{}", fmt::join(names, ", "), all ? "" : ", ...");
}

}  // namespace

ViewChoice middleView(std::span<const View> views) {
  if (const SlabView* first = slabViewOf(views.front()))
    return viewOf(views, first->slab, 0.5, 0.5);
  std::vector<Vector3> eyes;
  Vector3 sum;
  for (const View& view : views) {
    eyes.push_back(ViewProjector(view.geometry).eye());
    sum = sum + eyes.back();
  }
  const Vector3 middle = (1.0 / static_cast<double>(eyes.size())) * sum;
  const auto nearest =
      std::ranges::min_element(eyes, {}, [&](Vector3 eye) { return length(eye - middle); });
  const auto group = nearest - eyes.begin();
  return {static_cast<int>(group), views[static_cast<std::size_t>(group)].geometry, {}};
}

ViewChoice viewNamed(std::span<const View> views, const std::string& name) {
  if (std::holds_alternative<OrthographicView>(views.front().geometry)) {
    throw Error(Fault::Usage,
                fmt::format("--view: expected an object of several views, found a photograph and "
                            "\"{}\"",
                            name));
  }
  if (const auto between = betweenViews(views, name)) return *between;
  const auto found = std::ranges::find(views, name, &View::name);
  if (found != views.end()) return {static_cast<int>(found - views.begin()), found->geometry, {}};
  const bool slabs = slabViewOf(views.front()) != nullptr;
  throw Error(
      Fault::Usage,
      slabs ? fmt::format("--view: expected u,v or slab:u,v with u and v from 0 to 1 and a slab of "
                          "{}, found \"{}\"",
                          slabsOf(views), name)
            : fmt::format("--view: expected the name of one of the {} views, such as \"{}\", found "
                          "\"{}\"",
                          views.size(), views.front().name, name));
}

}  // namespace illum
