// Random numbers, the pixel filter, points on discs, the index of discs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "render/camera_rays.h"
#include "render/light_table.h"
#include "render/sample_sequence.h"
#include "render/test_scenes.h"

namespace illum {
namespace {

TEST(SampleSequence, FillsEveryElementaryInterval) {
  for (const std::uint32_t dimension : {0u, 1u, 5u, 17u}) {
    for (int shape = 0; shape <= 6; ++shape) {
      // 64 points; boxes of 2^-shape by 2^(shape - 6) hold one each.
      std::set<std::pair<int, int>> boxes;
      for (int s = 0; s < 64; ++s) {
        const auto [a, b] = SampleSequence(9, 4, 7, s).pair(dimension);
        ASSERT_TRUE(a >= 0 && a < 1 && b >= 0 && b < 1);
        boxes.insert(
            {static_cast<int>(std::ldexp(a, shape)), static_cast<int>(std::ldexp(b, 6 - shape))});
      }
      EXPECT_EQ(boxes.size(), 64u) << "dimension " << dimension << " shape " << shape;
    }
  }
}

TEST(SampleSequence, PixelsAndDimensionsAreIndependent) {
  // Correlation of the first sample of 4096 pixels, between neighbours and between dimensions.
  double beside = 0, below = 0, dimensions = 0, mean = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto at = [&](int px, int py, std::uint32_t d) {
        return static_cast<double>(SampleSequence(1, px, py, 0).pair(d)[0]) - 0.5;
      };
      mean += at(x, y, 0);
      beside += at(x, y, 0) * at(x + 1, y, 0);
      below += at(x, y, 0) * at(x, y + 1, 0);
      dimensions += at(x, y, 0) * at(x, y, 1);
    }
  }
  EXPECT_NEAR(mean / 4096, 0, 0.02);
  // Standard deviation of a mean of 4096 products of variance 1/144: 0.0013.
  EXPECT_NEAR(beside / 4096, 0, 0.005);
  EXPECT_NEAR(below / 4096, 0, 0.005);
  EXPECT_NEAR(dimensions / 4096, 0, 0.005);
}

TEST(PixelFilter, IsATrapezoidOfItsRadius) {
  for (const double radius : {0.25, 0.5, 0.75, 1.0, 2.0}) {
    const PixelFilter filter(radius);
    // The variance of a sum of two boxes: (wide^2 + narrow^2) / 12.
    const double wide = radius < 0.5 ? 2 * radius : std::max(1.0, radius);
    const double narrow = 2 * radius - wide;
    double mean = 0, square = 0, most = 0, last = -10;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
      const double offset = filter.offset((i + 0.5) / kSteps);
      ASSERT_GE(offset, last) << "radius " << radius;
      last = offset;
      mean += offset / kSteps;
      square += offset * offset / kSteps;
      most = std::max(most, std::abs(offset));
    }
    EXPECT_NEAR(mean, 0, 1e-9) << "radius " << radius;
    EXPECT_NEAR(square, (wide * wide + narrow * narrow) / 12, 1e-5) << "radius " << radius;
    EXPECT_LE(most, radius) << "radius " << radius;
    EXPECT_GT(most, 0.97 * radius) << "radius " << radius;
  }
}

TEST(LightTable, PointsLieEvenlyOnDiscs) {
  for (const double radius : {1e-4, 0.05, 0.7, 1.5}) {
    const auto lights = fibonacciLights(70);
    const LightTable table(lights, radius);
    DirectionBatch buffer;
    for (const std::size_t batch : {0u, 1u}) {
      for (const std::size_t i : {0u, 3u, 5u}) {
        const Vector3 centre = lights[64 * batch + i].toLight.vector();
        Vector3 sum;
        constexpr int kSteps = 64;
        for (int s = 0; s < kSteps * kSteps; ++s) {
          const float a = (static_cast<float>(s % kSteps) + 0.5f) / kSteps;
          const float b = (static_cast<float>(s / kSteps) + 0.5f) / kSteps;
          const DirectionBatch& drawn = table.draw(batch, {a, b}, buffer);
          const Vector3 d = vector3({drawn.x[i], drawn.y[i], drawn.z[i]});
          ASSERT_NEAR(length(d), 1, 1e-5);
          ASSERT_LE(angleRadians(Direction::fromVector(d), Direction::fromVector(centre)),
                    radius * (1 + 1e-3) + 1e-6);
          sum = sum + (1.0 / (kSteps * kSteps)) * d;
        }
        // The mean direction of a cap has the length (1 + cos r) / 2.
        // The grid is turned, so that one of its rows is cut: 1/64 of the disc.
        EXPECT_NEAR(length(sum - (0.5 * (1 + std::cos(radius))) * centre), 0, 0.01)
            << "radius " << radius << " light " << 64 * batch + i;
      }
    }
    EXPECT_NEAR(table.weight() * table.density(), table.radiance(), 1e-4 * table.radiance());
  }
}

TEST(LightTable, WithoutRadiusLightsAreDirections) {
  const auto lights = fibonacciLights(3);
  const LightTable table(lights, 0);
  DirectionBatch buffer;
  EXPECT_FLOAT_EQ(table.draw(0, {0.3f, 0.9f}, buffer).y[2],
                  static_cast<float>(lights[2].toLight.y()));
  EXPECT_FLOAT_EQ(table.weight(), std::numbers::pi_v<float>);
}

TEST(LightTable, DiscsAreFoundByDirection) {
  for (const int count : {1, 20, 1000}) {
    for (const double radius : {0.003, 0.06, 0.5, 1.4}) {
      const auto lights = fibonacciLights(count);
      const LightTable table(lights, radius);
      for (int s = 0; s < 500; ++s) {
        const auto [a, b] = SampleSequence(3, s, count, 0).pair(2);
        Direction direction = Direction::fromAngles(std::acos(1 - 2 * a), 6.2831853 * b);
        if (s < count && s % 2 == 0) {  // within the light itself
          direction = lights[static_cast<std::size_t>(s)].toLight;
        }
        std::set<std::size_t> found, expected;
        table.forDiscsAt(float3(direction.vector()), [&](std::size_t l) { found.insert(l); });
        bool onEdge = false;
        for (std::size_t l = 0; l < lights.size(); ++l) {
          const double angle = angleRadians(direction, lights[l].toLight);
          if (angle < radius) expected.insert(l);
          onEdge = onEdge || std::abs(angle - radius) < 1e-5;
        }
        if (onEdge) continue;
        ASSERT_EQ(found, expected) << count << " discs of " << radius;
      }
    }
  }
}

}  // namespace
}  // namespace illum
