#include <cblas.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "fit/dense.h"
#include "fit/fit.h"

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
  assert(pixels <= static_cast<std::size_t>(std::numeric_limits<int>::max()));
  if (pixels == 0 || planes == 0) return;
  useOneBlasThread();
  for (std::size_t k = 0; k < rows; ++k) {
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(k * pixels), pixels, offset[k]);
  }
  const auto columns = static_cast<int>(pixels), depth = static_cast<int>(inner);
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, planes, columns, depth, 1.0F,
              matrix.data(), depth, samples.data(), columns, 1.0F, out.data(), columns);
}

}  // namespace illum
