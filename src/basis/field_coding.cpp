#include "basis/field_coding.h"

#include "basis/chart.h"

namespace illum {
namespace {

// Builds the order; knows which samples exist.
class OrderBuilder {
 public:
  OrderBuilder(int resolution, std::vector<CodingStep>& steps)
      : side_(resolution + 2),
        centre_(side_ / 2),
        reachable_(reachableSamples(resolution)),
        steps_(steps) {}

  void build() {
    int level = 0;
    while ((2 << level) <= centre_) ++level;
    steps_.push_back(
        {index(centre_, centre_), 0, Prediction::None, static_cast<std::uint8_t>(level + 1)});
    for (; level >= 0; --level) {
      addPass(level, true);
      addPass(level, false);
    }
  }

 private:
  std::uint32_t index(int row, int column) const {
    return static_cast<std::uint32_t>(row) * side_ + column;
  }

  bool exists(int row, int column) const {
    return row >= 0 && row < side_ && column >= 0 && column < side_ &&
           reachable_[index(row, column)] != 0;
  }

  void addPass(int level, bool alongRow) {
    const int stride = 1 << level;
    const int first = centre_ % stride;
    for (int row = first; row < side_; row += stride) {
      const bool oddRow = ((row - centre_) >> level) & 1;
      if (oddRow == alongRow) continue;
      for (int column = first; column < side_; column += stride) {
        const bool oddColumn = ((column - centre_) >> level) & 1;
        if (alongRow && !oddColumn) continue;
        if (exists(row, column)) addStep(level, row, column, alongRow);
      }
    }
  }

  void addStep(int level, int row, int column, bool alongRow) {
    const int stride = 1 << level;
    const auto known = [&](int multiple) {
      return alongRow ? exists(row, column + multiple * stride)
                      : exists(row + multiple * stride, column);
    };
    // The nearer side comes first: the one toward the centre, where there are always samples.
    const int inward = (alongRow ? column : row) > centre_ ? -1 : 1;
    const int d = -inward * stride * (alongRow ? 1 : side_);
    Prediction prediction = Prediction::Nearest;
    if (known(-inward)) {
      if (known(3 * inward)) {
        prediction = known(-3 * inward) ? Prediction::Cubic : Prediction::OneSided;
      } else {
        prediction = Prediction::Linear;
      }
    } else if (known(3 * inward)) {
      prediction =
          known(5 * inward) ? Prediction::ExtrapolateQuadratic : Prediction::ExtrapolateLinear;
    }
    steps_.push_back({index(row, column), d, prediction, static_cast<std::uint8_t>(level)});
  }

  int side_, centre_;
  std::vector<std::uint8_t> reachable_;
  std::vector<CodingStep>& steps_;
};

}  // namespace

CodingOrder::CodingOrder(int resolution) {
  OrderBuilder(resolution, steps).build();
}

std::int32_t predict(const CodingStep& step, std::span<const std::int32_t> field) {
  const std::int32_t* v = field.data() + step.sample;
  const std::ptrdiff_t d = step.d;
  switch (step.prediction) {
    case Prediction::None:
      return 0;
    case Prediction::Cubic:
      return (9 * (v[-d] + v[d]) - v[-3 * d] - v[3 * d] + 8) >> 4;
    case Prediction::OneSided:
      return (6 * v[-d] + 3 * v[d] - v[-3 * d] + 4) >> 3;
    case Prediction::Linear:
      return (v[-d] + v[d] + 1) >> 1;
    case Prediction::ExtrapolateQuadratic:
      return (15 * v[-d] - 10 * v[-3 * d] + 3 * v[-5 * d] + 4) >> 3;
    case Prediction::ExtrapolateLinear:
      return (3 * v[-d] - v[-3 * d] + 1) >> 1;
    case Prediction::Nearest:
      return v[-d];
  }
  return 0;
}

std::int32_t unitsPerCode(int level) {
  return level >= 4 ? 1 : 16 >> level;
}

}  // namespace illum
