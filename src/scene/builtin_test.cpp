// Every built-in scene is whole, in the picture, and the same every time.
#include "scene/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scene/shapes.h"

namespace illum {
namespace {

bool isFinite(const std::array<float, 3>& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

std::string nameOf(const testing::TestParamInfo<BuiltinScene>& info) {
  return std::string(info.param.name);
}

class Builtin : public testing::TestWithParam<BuiltinScene> {
 protected:
  SceneCapture made() const { return builtinScene(GetParam().name); }
};
INSTANTIATE_TEST_SUITE_P(All, Builtin, testing::ValuesIn(builtinScenes()), nameOf);

void expectIndex(int index, std::size_t size) {
  EXPECT_GE(index, -1);
  EXPECT_LT(index, static_cast<int>(size));
}

void expectWellFormed(const TriangleMesh& mesh, const Scene& scene) {
  SCOPED_TRACE(mesh.name);
  EXPECT_GT(mesh.triangles.size(), 0u);
  EXPECT_GE(mesh.material, 0);
  expectIndex(mesh.material, scene.materials.size());
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  if (!mesh.texcoords.empty()) {
    EXPECT_EQ(mesh.texcoords.size(), mesh.positions.size());
  }
  EXPECT_TRUE(std::ranges::all_of(mesh.positions, isFinite));
  EXPECT_TRUE(std::ranges::all_of(mesh.normals, [](const auto& n) {
    return std::abs(length(vectorOf(n)) - 1) < 1e-3;
  })) << "unit normals";
  EXPECT_TRUE(std::ranges::all_of(mesh.triangles, [&](const auto& t) {
    return std::max({t[0], t[1], t[2]}) < mesh.positions.size();
  }));
}

void expectWellFormed(const CurveSet& set, const Scene& scene) {
  EXPECT_GE(set.material, 0);
  expectIndex(set.material, scene.materials.size());
  EXPECT_TRUE(std::ranges::all_of(set.points, [](const auto& p) {
    return isFinite({p[0], p[1], p[2]}) && p[3] > 0 && std::isfinite(p[3]);
  }));
  EXPECT_EQ(set.colours.size(), set.firstPoints.size());
  for (std::size_t i = 0; i < set.firstPoints.size(); ++i) {
    const std::size_t end =
        i + 1 < set.firstPoints.size() ? set.firstPoints[i + 1] : set.points.size();
    ASSERT_GE(end, set.firstPoints[i] + 4u) << "a cubic needs four points, curve " << i;
  }
}

TEST_P(Builtin, IsWellFormed) {
  const Scene scene = made().scene;
  for (const TriangleMesh& mesh : scene.meshes) expectWellFormed(mesh, scene);
  for (const CurveSet& set : scene.curves) expectWellFormed(set, scene);
  for (const Material& material : scene.materials) {
    for (const int texture :
         {material.baseColourTexture, material.metallicRoughnessTexture, material.normalTexture})
      expectIndex(texture, scene.textures.size());
    for (const float c : {material.baseColour.r, material.baseColour.g, material.baseColour.b})
      EXPECT_TRUE(c >= 0 && c <= 1) << material.name;
  }
  for (const Texture& texture : scene.textures) {
    EXPECT_TRUE(std::ranges::all_of(texture.texels.samples(), [](float t) {
      return t >= 0 && t <= 1;
    })) << texture.name;
  }
}

/// Of the triangles whose normals can be told apart, how many have vertices' normals on their side.
double shareFacingTheirNormals(const TriangleMesh& mesh) {
  std::size_t agree = 0, all = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = vectorOf(mesh.positions[t[0]]), b = vectorOf(mesh.positions[t[1]]);
    const Vector3 face = cross(b - a, vectorOf(mesh.positions[t[2]]) - a);
    Vector3 normal;
    for (const std::uint32_t corner : t) normal = normal + vectorOf(mesh.normals[corner]);
    if (length(face) < 1e-12) continue;
    ++all;
    agree += dot(face, normal) > 0 ? 1 : 0;
  }
  return static_cast<double>(agree) / static_cast<double>(all);
}

TEST_P(Builtin, TrianglesFaceTheSideOfTheirNormals) {
  for (const TriangleMesh& mesh : made().scene.meshes)
    EXPECT_GT(shareFacingTheirNormals(mesh), 0.98) << mesh.name;  // creases between locks
}

/// Grounds go on beyond the picture; all else is wholly in every view.
TEST_P(Builtin, IsInThePicture) {
  const SceneCapture capture = made();
  const auto expectSeen = [&](const View& view, Vector3 point) {
    const Size size = sizeOf(view.geometry);
    const auto at = pixelOf(view.geometry, point);
    return at && at->x >= 0 && at->y >= 0 && at->x <= size.width && at->y <= size.height;
  };
  for (const View& view : capture.setup.views) {
    SCOPED_TRACE(view.name);
    for (const TriangleMesh& mesh : capture.scene.meshes) {
      if (mesh.name == "plane" || mesh.name == "table") continue;
      EXPECT_TRUE(std::ranges::all_of(mesh.positions, [&](const auto& p) {
        return expectSeen(view, vectorOf(p));
      })) << mesh.name;
    }
    for (const CurveSet& set : capture.scene.curves) {
      EXPECT_TRUE(std::ranges::all_of(set.points, [&](const auto& p) {
        return expectSeen(view, {p[0], p[1], p[2]});
      }));
    }
  }
}

TEST_P(Builtin, IsTheSameEveryTime) {
  const Scene one = made().scene, other = made().scene;
  ASSERT_EQ(one.meshes.size(), other.meshes.size());
  for (std::size_t i = 0; i < one.meshes.size(); ++i) {
    EXPECT_EQ(one.meshes[i].positions, other.meshes[i].positions);
    EXPECT_EQ(one.meshes[i].normals, other.meshes[i].normals);
    EXPECT_EQ(one.meshes[i].triangles, other.meshes[i].triangles);
  }
  ASSERT_EQ(one.curves.size(), other.curves.size());
  for (std::size_t i = 0; i < one.curves.size(); ++i) {
    EXPECT_EQ(one.curves[i].points, other.curves[i].points);
    EXPECT_EQ(one.curves[i].firstPoints, other.curves[i].firstPoints);
  }
  for (std::size_t i = 0; i < one.textures.size(); ++i)
    EXPECT_EQ(one.textures[i].texels, other.textures[i].texels);
}

// --- what single scenes promise ---

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Edges that are not passed as often one way as the other.
std::size_t openEdges(const TriangleMesh& mesh) {
  std::map<Edge, int> balance;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a < b) {
        ++balance[{a, b}];
      } else {
        --balance[{b, a}];
      }
    }
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

double volumeOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += dot(vectorOf(mesh.positions[t[0]]),
               cross(vectorOf(mesh.positions[t[1]]), vectorOf(mesh.positions[t[2]])));
  }
  return sum / 6;
}

TEST(BuiltinBust, IsOneClosedSculpture) {
  const Scene scene = builtinScene("bust").scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(openEdges(scene.meshes[0]), 0u);
  EXPECT_GT(volumeOf(scene.meshes[0]), 2);
}

TEST(BuiltinCornell, IsSeenFromInsideOnly) {
  const SceneCapture capture = builtinScene("cornell");
  for (const View& view : capture.setup.views) {
    const auto& seen = std::get<SlabView>(view.geometry);
    const Vector3 eye = seen.slab.objectFromSlab.point(
        seen.slab.viewPoint(seen.u / (seen.slab.uCount - 1.0), seen.v / (seen.slab.vCount - 1.0)));
    for (const TriangleMesh& mesh : capture.scene.meshes) {
      if (mesh.name == "tall" || mesh.name == "short") continue;
      for (const auto& t : mesh.triangles) {
        const Vector3 a = vectorOf(mesh.positions[t[0]]), b = vectorOf(mesh.positions[t[1]]);
        const Vector3 face = cross(b - a, vectorOf(mesh.positions[t[2]]) - a);
        EXPECT_GT(dot(face, eye - a), 0) << mesh.name << " from " << view.name;
      }
    }
  }
}

TEST(BuiltinBear, HasThousandsOfHairsThatGrowOnIt) {
  const Scene scene = builtinScene("bear").scene;
  ASSERT_EQ(scene.curves.size(), 1u);
  const CurveSet& fur = scene.curves[0];
  EXPECT_GT(fur.firstPoints.size(), 10000u);
  constexpr std::size_t kEvery = 97;
  for (std::size_t i = 0; i < fur.firstPoints.size(); i += kEvery) {
    const auto& p = fur.points[fur.firstPoints[i] + 1];  // the spline begins here
    double nearest = 1;
    for (const TriangleMesh& mesh : scene.meshes) {
      for (const auto& q : mesh.positions)
        nearest = std::min(nearest, length(Vector3{p[0], p[1], p[2]} - vectorOf(q)));
    }
    EXPECT_LT(nearest, 0.06) << "hair " << i;
  }
}

TEST(BuiltinCoin, LiesOnTheTableWithItsFaceUp) {
  const SceneCapture capture = builtinScene("coin");
  ASSERT_EQ(capture.setup.views.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<OrthographicView>(capture.setup.views[0].geometry));
  const TriangleMesh& face = capture.scene.meshes.at(0);
  ASSERT_EQ(face.name, "face");
  for (std::size_t i = 0; i < face.positions.size(); ++i) {
    ASSERT_GT(face.normals[i][2], 0);
    ASSERT_GT(face.positions[i][2], 0);
    ASSERT_LT(face.positions[i][2], 0.25);
  }
}

TEST(BuiltinList, UnknownNamesAreRefused) {
  for (const char* name : {"", "Box", "bears", "builtin:box"})
    EXPECT_THROW(builtinScene(name), std::exception) << name;
}

}  // namespace
}  // namespace illum
