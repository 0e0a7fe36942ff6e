#include <gtest/gtest.h>

#include "illum/basis_table.h"

namespace illum {
namespace {

TEST(BasisTable, EqualsItsDecodedFile) {
  BasisTable table(LightDomain::Hemisphere, 9, 3);
  table.fill([](Direction d, std::span<double> out) {
    out[0] = d.x();
    out[1] = d.y() * d.z();
    out[2] = 1;
  });
  const std::vector<std::byte> bytes = table.encode();
  EXPECT_EQ(BasisTable::decode(bytes, "basis.bin"), table);
}

}  // namespace
}  // namespace illum
