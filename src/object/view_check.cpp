#include "object/view_check.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "illum/error.h"
#include "object/view_record.h"

namespace illum {
namespace {

constexpr std::size_t kMaxSlabNameBytes = 255;

void require(bool holds, const std::string& field, std::string_view expected,
             const std::string& found) {
  if (holds) return;
  throw Error(Fault::Input,
              fmt::format("field '{}': expected {}, found {}", field, expected, found));
}

/// What is known of the groups that were looked at so far.
struct Seen {
  std::set<std::string_view> names;
  std::map<std::string_view, const LightSlab*> slabs;
  std::set<std::tuple<std::string_view, int, int>> places;
};

void checkPlace(const SlabView& view, const std::string& field, Seen& seen) {
  const LightSlab& slab = view.slab;
  require(!slab.name.empty() && slab.name.size() <= kMaxSlabNameBytes, field + ", its slab's name",
          fmt::format("1 to {} bytes", kMaxSlabNameBytes), std::to_string(slab.name.size()));
  const auto [known, isNew] = seen.slabs.try_emplace(slab.name, &slab);
  require(isNew || *known->second == slab, field + ", its slab", "one slab of each name",
          fmt::format("two that are called '{}'", slab.name));
  require(view.u >= 0 && view.u < slab.uCount && view.v >= 0 && view.v < slab.vCount, field,
          fmt::format("a view point of {}x{}", slab.uCount, slab.vCount),
          fmt::format("({}, {})", view.u, view.v));
  require(seen.places.emplace(slab.name, view.u, view.v).second, field, "one view at each u, v",
          fmt::format("a second one at ({}, {})", view.u, view.v));
}

/// Of what each kind of geometry must be by itself.
void checkShape(const ViewGeometry& geometry, const std::string& field) {
  try {
    checkGeometry(geometry);
  } catch (const Error& error) {
    throw Error(Fault::Input, fmt::format("field '{}': {}", field, error.what()));
  }
}

}  // namespace

void checkViews(const Manifest& manifest) {
  Seen seen;
  for (std::size_t g = 0; g < manifest.groups.size(); ++g) {
    const GroupEntry& group = manifest.groups[g];
    const std::string field = fmt::format("groups[{}]", g);
    require(seen.names.insert(group.view.name).second, field + ".name", "a name of its own",
            fmt::format("'{}' a second time", group.view.name));
    const ViewGeometry& geometry = group.view.geometry;
    require(!std::holds_alternative<OrthographicView>(geometry) || manifest.groups.size() == 1,
            field + ".geometry", "a photograph to be an object's only view",
            fmt::format("{} groups", manifest.groups.size()));
    checkShape(geometry, field + ".geometry");
    if (const auto* view = std::get_if<SlabView>(&geometry))
      checkPlace(*view, field + ".geometry", seen);
    if (group.depth)
      require(group.depth->from <= group.depth->to, field + ".depth", "from not above to",
              fmt::format("{} and {}", group.depth->from, group.depth->to));
  }
}

}  // namespace illum
