#include <gtest/gtest.h>

#include "illum/basis_table.h"
#include "illum/error.h"

namespace illum {
namespace {

BasisTable coordinates(int columns) {
  BasisTable table(LightDomain::Hemisphere, 9, columns);
  table.fill([columns](Direction d, std::span<double> out) {
    for (int c = 0; c < columns; ++c) out[c] = c + d.x() + 2 * c * d.y();
  });
  return table;
}

TEST(LightBasis, SeparableColumnsTimesTheColourMatrix) {
  BasisColour colour;
  colour.colourMatrix = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const LightBasis basis(coordinates(4), colour);
  ASSERT_EQ(basis.planes(), 12);
  ASSERT_EQ(basis.evaluateSize(), 39U);
  const Direction d = Direction::fromVector({0.3, -0.2, 0.8});
  std::vector<float> columns(4), out(39, -1);
  basis.table().evaluate(d, columns);
  basis.evaluate(d, out);
  for (int j = 0; j < 4; ++j) {
    for (int plane = 0; plane < 3; ++plane) {
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_FLOAT_EQ(out[3 * (3 * j + plane) + channel],
                        static_cast<float>(1 + 3 * channel + plane) * columns[j])
            << j << ' ' << plane << ' ' << channel;
      }
    }
  }
  for (int c = 0; c < 3; ++c) EXPECT_EQ(out[36 + c], 0);
}

TEST(LightBasis, OneColumnIsEnough) {
  const LightBasis basis(coordinates(1), {});
  std::vector<float> column(1), out(basis.evaluateSize());
  const Direction d = Direction::fromVector({0.5, 0, 0.8});
  basis.table().evaluate(d, column);
  basis.evaluate(d, out);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(out[i], i % 4 == 0 ? column[0] : 0) << i;
}

TEST(LightBasis, FullColumnsAreTheValues) {
  BasisColour colour;
  colour.kind = BasisColour::Kind::Full;
  const LightBasis basis(coordinates(9), colour);
  ASSERT_EQ(basis.planes(), 2);
  ASSERT_EQ(basis.evaluateSize(), 9U);
  const Direction d = Direction::fromVector({0.3, -0.2, 0.8});
  std::vector<float> columns(9), out(9);
  basis.table().evaluate(d, columns);
  basis.evaluate(d, out);
  EXPECT_EQ(out, columns);
}

TEST(LightBasis, RefusesFullBasesWithoutWholeTriples) {
  BasisColour colour;
  colour.kind = BasisColour::Kind::Full;
  EXPECT_THROW(LightBasis(coordinates(1), colour), Error);
  EXPECT_THROW(LightBasis(coordinates(7), colour), Error);
  EXPECT_NO_THROW(LightBasis(coordinates(3), colour));
}

}  // namespace
}  // namespace illum
