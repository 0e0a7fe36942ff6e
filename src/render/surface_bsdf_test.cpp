#include "render/surface_bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/hair_bsdf.h"
#include "render/sample_sequence.h"
#include "render/test_scenes.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

SurfacePoint point(float roughness, float metallic, float specular = 0.5f) {
  SurfacePoint p;
  p.geometricNormal = p.shadingNormal = {0, 0, 1};
  p.tangent = {1, 0, 0};
  p.colour = {1, 0.5f, 0.2f};
  p.roughness = roughness;
  p.metallic = metallic;
  p.specular = specular;
  return p;
}

Float3 direction(double theta, double phi) {
  return {static_cast<float>(std::sin(theta) * std::cos(phi)),
          static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))};
}

struct Value {
  double r, b, density;
};

template <typename Bsdf>
Value valueOf(const Bsdf& bsdf, Float3 toLight) {
  DirectionBatch batch{};
  batch.x[0] = toLight.x, batch.y[0] = toLight.y, batch.z[0] = toLight.z;
  BsdfBatch out;
  bsdf.evaluate(batch, 1, out);
  return {out.r[0], out.b[0], out.density[0]};
}

// The whole of what is sent toward the viewer under white light, by drawn directions.
template <typename Bsdf>
double drawnAlbedo(const Bsdf& bsdf, int samples) {
  double sum = 0;
  for (int s = 0; s < samples; ++s) {
    const SampleSequence sequence(1, 2, 3, s);
    const auto drawn = bsdf.sample(sequence.pair(0)[0], sequence.pair(1));
    if (drawn) sum += static_cast<double>(drawn->weight.r);
  }
  return sum / samples;
}

// The same by a grid over the sphere, even in area; and the integral of the density.
template <typename Bsdf>
Value integrated(const Bsdf& bsdf, int steps) {
  Value sum{};
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < 2 * steps; ++j) {
      const double theta = std::acos(1 - (2 * i + 1.0) / steps);
      const Value v = valueOf(bsdf, direction(theta, kPi * (j + 0.5) / steps));
      const double area = 4 * kPi / (2.0 * steps * steps);
      sum.r += area * v.r, sum.b += area * v.b, sum.density += area * v.density;
    }
  }
  return sum;
}

TEST(SurfaceBsdf, IsTheFormulaOfThePapers) {
  for (const float roughness : {0.3f, 0.7f, 1.0f}) {
    const Float3 viewer = direction(0.7, 0.3);
    const SurfaceBsdf bsdf(point(roughness, 1), viewer);
    for (const double theta : {0.05, 0.5, 0.72, 1.2, 1.5}) {
      for (const double phi : {0.0, 2.0, 3.4}) {
        const Float3 light = direction(theta, phi);
        const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
        const double expected = referenceMicrofacets(alpha, 1, 1, viewer, light) * std::cos(theta);
        EXPECT_NEAR(valueOf(bsdf, light).r, expected, 2e-4 * expected + 1e-6)
            << "roughness " << roughness << " theta " << theta << " phi " << phi;
      }
    }
  }
}

TEST(SurfaceBsdf, WithoutSpecularItIsLambert) {
  const SurfaceBsdf bsdf(point(0.4f, 0, 0), direction(1, 0.3));
  for (const double theta : {0.0, 0.8, 1.5}) {
    EXPECT_NEAR(valueOf(bsdf, direction(theta, 1)).r, std::cos(theta) / kPi, 1e-6);
  }
  EXPECT_FALSE(bsdf.isGlossy());
}

TEST(SurfaceBsdf, IsTheSameBothWays) {
  for (const float roughness : {0.1f, 0.4f, 1.0f}) {
    for (const float metallic : {0.0f, 0.3f, 1.0f}) {
      for (const double a : {0.1, 0.8, 1.3, 1.55}) {
        for (const double b : {0.05, 0.7, 1.4}) {
          const Float3 v = direction(a, 0), l = direction(b, 2.6);
          const SurfacePoint p = point(roughness, metallic);
          const double there = valueOf(SurfaceBsdf(p, v), l).b / std::cos(b);
          const double back = valueOf(SurfaceBsdf(p, l), v).b / std::cos(a);
          EXPECT_NEAR(there, back, 1e-4 * there)
              << "roughness " << roughness << " metallic " << metallic << " " << a << " " << b;
        }
      }
    }
  }
}

TEST(SurfaceBsdf, ReflectsAtMostWhatItGets) {
  for (const float roughness : {0.0f, 0.05f, 0.2f, 0.5f, 0.77f, 1.0f}) {
    for (const float metallic : {0.0f, 0.4f, 1.0f}) {
      for (const float specular : {0.0f, 0.1f, 0.5f, 1.0f}) {
        for (const double theta : {0.0, 0.5, 1.0, 1.3, 1.45, 1.55}) {
          const SurfaceBsdf bsdf(point(roughness, metallic, specular), direction(theta, 0));
          const double albedo = drawnAlbedo(bsdf, 4096);
          EXPECT_LE(albedo, 1.004) << "roughness " << roughness << " metallic " << metallic
                                   << " specular " << specular << " theta " << theta;
          if (metallic == 0) {
            EXPECT_GE(albedo, 0.94) << "roughness " << roughness << " theta " << theta;
          }
        }
      }
    }
  }
}

TEST(SurfaceBsdf, DrawsByItsDensity) {
  for (const float roughness : {0.4f, 0.8f}) {
    for (const float metallic : {0.0f, 1.0f}) {
      for (const double theta : {0.2, 1.2}) {
        const SurfaceBsdf bsdf(point(roughness, metallic), direction(theta, 0.4));
        const Value whole = integrated(bsdf, 400);
        // Directions below the horizon are drawn, but lost.
        EXPECT_LE(whole.density, 1.002);
        EXPECT_GE(whole.density, 0.5);
        EXPECT_NEAR(drawnAlbedo(bsdf, 8192), whole.r, 0.01)
            << "roughness " << roughness << " metallic " << metallic << " theta " << theta;
      }
    }
  }
}

TEST(SurfaceBsdf, NothingComesFromBelowEitherHorizon) {
  SurfacePoint p = point(0.5f, 0.5f);
  p.shadingNormal = normalised({0.5f, 0, 1});
  const SurfaceBsdf bsdf(p, direction(0.2, 1));
  EXPECT_EQ(valueOf(bsdf, direction(1.62, 0)).r, 0);   // below the geometric one alone
  EXPECT_EQ(valueOf(bsdf, direction(1.4, kPi)).r, 0);  // below the shading one alone
  EXPECT_GT(valueOf(bsdf, direction(1.4, 0)).r, 0);
}

TEST(HairBsdf, IsTheSameBothWays) {
  for (const double a : {0.3, 1.2, 2.5}) {
    for (const double b : {0.1, 1.6, 2.9}) {
      const Float3 v = direction(a, 0.4), l = direction(b, 2.2);
      const SurfacePoint p = point(0.3f, 0);
      const auto across = [&](Float3 d) { return std::sqrt(1 - d.x * d.x); };
      const double there = valueOf(HairBsdf(p, v), l).b / static_cast<double>(across(l));
      const double back = valueOf(HairBsdf(p, l), v).b / static_cast<double>(across(v));
      EXPECT_NEAR(there, back, 1e-4 * there + 1e-7) << a << " " << b;
    }
  }
}

// By reciprocity what a fibre scatters of light from one direction is the integral over the
// viewer's: S times the sine of the viewer's angle.
TEST(HairBsdf, ScattersAtMostWhatItGets) {
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    for (const double theta : {0.0, 0.5, 1.2, 1.5}) {
      SurfacePoint p = point(roughness, 0, 1);
      p.colour = {1, 1, 1};
      const HairBsdf bsdf(p, direction(theta, 0));
      const Value whole = integrated(bsdf, 300);
      EXPECT_LE(whole.r, 1.002) << "roughness " << roughness << " theta " << theta;
      EXPECT_GE(whole.r, 0.9) << "roughness " << roughness << " theta " << theta;
      EXPECT_NEAR(whole.density, 1, 0.002);
      EXPECT_NEAR(drawnAlbedo(bsdf, 8192), whole.r, 0.01);
    }
  }
}

}  // namespace
}  // namespace illum
