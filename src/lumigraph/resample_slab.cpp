#include <fmt/format.h>

#include "illum/error.h"
#include "illum/lumigraph.h"

namespace illum {

void resampleSlab(ViewSource& source, const LightSlab& slab, int uCount, int vCount,
                  const SynthesisOptions& options, const std::function<void(SourceView&&)>& take) {
  constexpr int kMostViewPoints = 1024;  // in a row
  if (uCount < 1 || vCount < 1 || uCount > kMostViewPoints || vCount > kMostViewPoints) {
    throw Error(Fault::Usage, fmt::format("expected 1 to {} view points in rows and columns, found "
                                          "{}x{}",
                                          kMostViewPoints, uCount, vCount));
  }
  LightSlab finer = slab;
  finer.uCount = uCount;
  finer.vCount = vCount;
  for (int v = 0; v < vCount; ++v) {
    for (int u = 0; u < uCount; ++u) {
      const View view{fmt::format("{}:{},{}", slab.name, u, v), SlabView{finer, u, v}};
      SynthesisedView seen = synthesise(source, view.geometry, options);
      take({view, std::move(seen.picture), std::move(seen.depth)});
    }
  }
}

}  // namespace illum
