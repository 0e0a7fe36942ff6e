#include <algorithm>
#include <cassert>

#include "fit/fit.h"
#include "fit/plane_kernel.h"

namespace illum {

void PlaneOperator::apply(std::span<const float> samples, std::size_t pixels,
                          std::span<float> out) const {
  const auto rows = static_cast<std::size_t>(planes), inner = 3 * static_cast<std::size_t>(lights);
  if (!picks.empty()) {
    assert(picks.size() == rows && samples.size() == inner * pixels);
    for (std::size_t k = 0; k < rows; ++k)
      std::copy_n(samples.data() + static_cast<std::size_t>(picks[k]) * pixels, pixels,
                  out.data() + k * pixels);
    return;
  }
  assert(matrix.size() == rows * inner && offset.size() == rows);
  assert(samples.size() == inner * pixels && out.size() == rows * pixels);
  if (pixels == 0 || planes == 0) return;
  sumPlanes({matrix.data(), offset.data(), rows, inner}, samples.data(), pixels, out.data());
}

}  // namespace illum
