// A scene in memory, ready to be ray traced: everything in the object frame.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "illum/camera.h"
#include "illum/colour.h"
#include "illum/light_file.h"
#include "illum/picture.h"

namespace illum {

/// A picture on a surface. Row 0 is at texture coordinate v = 1 (v up); repeats in both directions.
struct Texture {
  std::string name;  ///< for messages
  Picture texels;    ///< linear; 1, 3 or 4 channels, alpha straight; level 0
};

/// What a surface is made of. Metallic-roughness as in glTF 2.0 (GGX, Walter et al. 2007; Schlick's
/// Fresnel), or one of the two ideal kinds.
struct Material {
  enum class Kind {
    Surface,  ///< metallic-roughness
    Mirror,   ///< ideal reflection, tinted by baseColour
    Glass,    ///< ideal dielectric of `ior`; what passes is tinted by baseColour once a surface
    Hair      ///< of curves: Kajiya and Kay 1989, baseColour diffuse, `specular` for the highlight
  } kind = Kind::Surface;
  std::string name;
  LinearRgb baseColour{0.8f, 0.8f, 0.8f};  ///< in [0, 1]; times texture times vertex colour
  float metallic = 0, roughness = 1;       ///< perceptual; GGX alpha = roughness^2
  float specular = 0.5f;                   ///< dielectric F0 = 0.08 * specular (0.04 at 0.5)
  float ior = 1.5f;                        ///< glass
  float alphaCutoff = 0;                   ///< > 0: texels of baseColour alpha below it are holes
  /// Indices into Scene::textures; -1: none.
  int baseColourTexture = -1;
  int metallicRoughnessTexture = -1;  ///< roughness in G, metallic in B (glTF)
  int normalTexture = -1;             ///< tangent space, +Y up (glTF); values in [0, 1]
};

struct TriangleMesh {
  std::string name;
  int material = 0;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;            ///< as many as positions, or none: flat
  std::vector<std::array<float, 2>> texcoords;          ///< as many as positions, or none
  std::vector<LinearRgb> colours;                       ///< as many as positions, or none: white
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Round cubic B-spline curves (hair). A curve of n points has n - 3 segments.
struct CurveSet {
  std::string name;
  int material = 0;
  std::vector<std::array<float, 4>> points;  ///< x, y, z, radius
  std::vector<std::uint32_t> firstPoints;    ///< of each curve; the last ends with `points`
  std::vector<LinearRgb> colours;            ///< one a curve, or none: white
};

struct Bounds {
  Vector3 low, high;
};

struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<TriangleMesh> meshes;
  std::vector<CurveSet> curves;
};

/// Of all points; a curve's radii included. Empty scenes have low > high.
Bounds boundsOf(const Scene& scene);

/// How a scene is captured: the views, the lights, how carefully.
struct CaptureSetup {
  std::vector<View> views;
  /// Directions in the object frame, intensity 1; names "light_0007".
  std::vector<LightFileEntry> lights;
  double lightRadiusRadians = 0;  ///< of the disc that each light is, in [0, pi/2)
  int samplesPerPixel = 4;        ///< >= 1
  int bounces = 1;                ///< interreflections after the first hit, >= 0
  double filterRadius = 0.75;  ///< of the pixel filter, in pixels, in (0, 4]; 0.5 is nearly a box
  std::uint64_t seed = 0;
};

struct SceneCapture {
  Scene scene;
  CaptureSetup setup;
};

}  // namespace illum
