#include "render/surface_point.h"

#include <array>
#include <string>

#include "illum/error.h"
#include "render/dielectric.h"

namespace illum {
namespace {

// The error of an interpolated position, in units of the largest coordinate: a few roundings.
constexpr float kClearance = 0x1p-17f;
// Smallest cosine between what is seen and a shading normal.
constexpr float kLeastCosine = 1e-3f;

struct Barycentric {
  float a, b, c;  // sum is 1
};

Float3 float3(const std::array<float, 3>& p) {
  return {p[0], p[1], p[2]};
}
Float3 interpolated(Float3 a, Float3 b, Float3 c, Barycentric at) {
  return at.a * a + at.b * b + at.c * c;
}

float unit(float x) {
  return std::clamp(x, 0.0f, 1.0f);
}
LinearRgb unit(LinearRgb c) {
  return {unit(c.r), unit(c.g), unit(c.b)};
}
LinearRgb product(LinearRgb a, LinearRgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

float largest(Float3 p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

// A triangle's corners, looked up once.
struct Triangle {
  const TriangleMesh& mesh;
  std::array<std::uint32_t, 3> corners;
  std::array<Float3, 3> positions;

  Triangle(const TriangleMesh& of, std::uint32_t index) : mesh(of), corners(of.triangles[index]) {
    for (std::size_t k = 0; k < 3; ++k) positions[k] = float3(of.positions[corners[k]]);
  }
  Float3 position(Barycentric at) const {
    return interpolated(positions[0], positions[1], positions[2], at);
  }
  // `otherwise` serves for slivers whose own is lost in rounding.
  Float3 normal(Float3 otherwise) const {
    const Float3 normal = cross(positions[1] - positions[0], positions[2] - positions[0]);
    const float size = length(normal);
    return normalised(size > 0 && std::isfinite(1 / size) ? normal : otherwise);
  }
  TexturePoint texcoord(Barycentric at) const {
    if (mesh.texcoords.empty()) return {};
    const auto& a = mesh.texcoords[corners[0]];
    const auto& b = mesh.texcoords[corners[1]];
    const auto& c = mesh.texcoords[corners[2]];
    return {at.a * a[0] + at.b * b[0] + at.c * c[0], at.a * a[1] + at.b * b[1] + at.c * c[1]};
  }
  LinearRgb colour(Barycentric at) const {
    if (mesh.colours.empty()) return {1, 1, 1};
    return at.a * mesh.colours[corners[0]] + at.b * mesh.colours[corners[1]] +
           at.c * mesh.colours[corners[2]];
  }
};

// How texture coordinates lie in space: p = dpdu * u + dpdv * v along the triangle, and the
// gradients of u and v within it. Zero where the coordinates are degenerate.
struct TextureFrame {
  Float3 dpdu, dpdv, gradientU, gradientV;

  explicit TextureFrame(const Triangle& triangle, Float3 normal) {
    if (triangle.mesh.texcoords.empty()) return;
    const auto& a = triangle.mesh.texcoords[triangle.corners[0]];
    const auto& b = triangle.mesh.texcoords[triangle.corners[1]];
    const auto& c = triangle.mesh.texcoords[triangle.corners[2]];
    const Float3 edge1 = triangle.positions[1] - triangle.positions[0];
    const Float3 edge2 = triangle.positions[2] - triangle.positions[0];
    const float u1 = b[0] - a[0], v1 = b[1] - a[1], u2 = c[0] - a[0], v2 = c[1] - a[1];
    const float determinant = u1 * v2 - u2 * v1, area = dot(cross(edge1, edge2), normal);
    if (determinant != 0) {
      dpdu = (1 / determinant) * (v2 * edge1 - v1 * edge2);
      dpdv = (1 / determinant) * (u1 * edge2 - u2 * edge1);
    }
    if (area != 0) {
      const Float3 dual1 = (1 / area) * cross(edge2, normal);
      const Float3 dual2 = (1 / area) * cross(normal, edge1);
      gradientU = u1 * dual1 + u2 * dual2;
      gradientV = v1 * dual1 + v2 * dual2;
    }
  }

  TexturePoint inTexture(Float3 displacement) const {
    return {dot(displacement, gradientU), dot(displacement, gradientV)};
  }
};

// Where a beam of this width meets a plane: longer where it comes in aslant.
TextureFootprint footprintOf(const TextureFrame& frame, Float3 normal, Float3 direction,
                             float width) {
  const float cosine = dot(direction, normal);
  const Float3 inPlane = direction - cosine * normal;
  const float sine = length(inPlane);
  const Float3 along = sine > 1e-4f ? (1 / sine) * inPlane : Frame(normal).x;
  const float stretch = 1 / std::max(std::abs(cosine), 0.02f);
  return {frame.inTexture(0.5f * width * stretch * along),
          frame.inTexture(0.5f * width * cross(normal, along))};
}

// The normal that a tangent-space map says (glTF 2.0: x along u, y along v).
Float3 mappedNormal(const Texel& texel, const TextureFrame& frame, Float3 normal) {
  const Float3 inFrame{2 * texel[0] - 1, 2 * texel[1] - 1, 2 * texel[2] - 1};
  const Float3 along = frame.dpdu - dot(frame.dpdu, normal) * normal;
  if (!(length(along) > 0)) return normal;
  const Float3 tangent = normalised(along);
  const Float3 across = cross(normal, tangent);
  const float side = dot(across, frame.dpdv) < 0 ? -1.0f : 1.0f;
  const Float3 mapped = inFrame.x * tangent + (side * inFrame.y) * across + inFrame.z * normal;
  return length(mapped) > 1e-3f ? normalised(mapped) : normal;
}

// Turns a shading normal as little as needed for `toViewer` to be above its horizon.
Float3 facing(Float3 normal, Float3 toViewer) {
  const float cosine = dot(normal, toViewer);
  if (cosine >= kLeastCosine) return normal;
  return normalised(normal + (2 * kLeastCosine - cosine) * toViewer);
}

Error brokenMesh(const std::string& kind, const std::string& name, const std::string& what) {
  return {Fault::Input, kind + " \"" + name + "\": " + what};
}

template <std::size_t N>
bool isFinite(const std::array<float, N>& values) {
  return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
}
bool isFinite(const LinearRgb& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

void checkMesh(const TriangleMesh& mesh, std::size_t materials) {
  const std::size_t count = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
  if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= materials) {
    throw brokenMesh(
        "mesh", mesh.name,
        "expected one of the scene's materials, found number " + std::to_string(mesh.material));
  }
  if (!fits(mesh.normals.size()) || !fits(mesh.texcoords.size()) || !fits(mesh.colours.size())) {
    throw brokenMesh("mesh", mesh.name,
                     "expected as many normals, texture coordinates and colours as vertices");
  }
  const auto finite = [](const auto& v) { return isFinite(v); };
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite) ||
      !std::all_of(mesh.normals.begin(), mesh.normals.end(), finite) ||
      !std::all_of(mesh.texcoords.begin(), mesh.texcoords.end(), finite) ||
      !std::all_of(mesh.colours.begin(), mesh.colours.end(), finite)) {
    throw brokenMesh("mesh", mesh.name, "expected finite numbers, found an infinity or NaN");
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= count) {
        throw brokenMesh("mesh", mesh.name,
                         "expected vertices below " + std::to_string(count) + ", found number " +
                             std::to_string(corner));
      }
    }
  }
}

void checkCurves(const CurveSet& curves, std::size_t materials) {
  const auto points = static_cast<std::uint32_t>(curves.points.size());
  if (curves.material < 0 || static_cast<std::size_t>(curves.material) >= materials) {
    throw brokenMesh(
        "curves", curves.name,
        "expected one of the scene's materials, found number " + std::to_string(curves.material));
  }
  if (!curves.colours.empty() && curves.colours.size() != curves.firstPoints.size()) {
    throw brokenMesh("curves", curves.name, "expected as many colours as curves");
  }
  std::uint32_t last = 0;
  for (const std::uint32_t first : curves.firstPoints) {
    if (first < last || first > points) {
      throw brokenMesh("curves", curves.name, "expected curves one behind the other");
    }
    last = first;
  }
  for (const auto& point : curves.points) {
    if (!isFinite(point) || point[3] < 0) {
      throw brokenMesh("curves", curves.name,
                       "expected finite points and radii that are not negative");
    }
  }
}

void checkMaterial(const Material& material, std::size_t textures) {
  for (const int texture :
       {material.baseColourTexture, material.metallicRoughnessTexture, material.normalTexture}) {
    if (texture < -1 || texture >= static_cast<int>(textures)) {
      throw brokenMesh(
          "material", material.name,
          "expected one of the scene's textures, found number " + std::to_string(texture));
    }
  }
  const bool finite = isFinite(material.baseColour) && std::isfinite(material.metallic) &&
                      std::isfinite(material.roughness) && std::isfinite(material.specular) &&
                      std::isfinite(material.ior) && std::isfinite(material.alphaCutoff);
  if (!finite || material.ior < 1) {
    throw brokenMesh("material", material.name,
                     "expected finite numbers and a refractive index of at least 1");
  }
}

void checkScene(const Scene& scene) {
  for (const Texture& texture : scene.textures) {
    if (texture.texels.empty()) throw brokenMesh("texture", texture.name, "it has no texels");
  }
  for (const Material& material : scene.materials) checkMaterial(material, scene.textures.size());
  for (const TriangleMesh& mesh : scene.meshes) checkMesh(mesh, scene.materials.size());
  for (const CurveSet& curves : scene.curves) checkCurves(curves, scene.materials.size());
}

}  // namespace

SceneSurfaces::SceneSurfaces(const Scene& scene) {
  checkScene(scene);
  scene_.materials = scene.materials;
  scene_.meshes = scene.meshes;
  scene_.curves = scene.curves;
  textures_.reserve(scene.textures.size());
  for (const Texture& texture : scene.textures) textures_.emplace_back(texture);
  for (const CurveSet& curves : scene.curves) {
    segments_.push_back(segmentsOf(curves));
    auto& curveOf = curveOfSegment_.emplace_back();
    if (curves.colours.empty()) continue;
    std::uint32_t curve = 0;
    for (const std::uint32_t point : segments_.back()) {
      while (curve + 1 < curves.firstPoints.size() && curves.firstPoints[curve + 1] <= point) {
        ++curve;
      }
      curveOf.push_back(curve);
    }
  }
}

SurfacePoint SceneSurfaces::at(const Hit& hit, const BeamRay& beam) const {
  SurfacePoint point =
      hit.geometry < scene_.meshes.size() ? onTriangle(hit, beam) : onCurve(hit, beam);
  point.beamWidth = beam.width + beam.spread * hit.distance;
  return point;
}

SurfacePoint SceneSurfaces::onTriangle(const Hit& hit, const BeamRay& beam) const {
  const TriangleMesh& mesh = scene_.meshes[hit.geometry];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  const Triangle triangle(mesh, hit.primitive);
  const Barycentric where{1 - hit.u - hit.v, hit.u, hit.v};
  const Float3 outward = triangle.normal(hit.normal);

  SurfacePoint point;
  point.position = triangle.position(where);
  point.fromBehind = dot(outward, beam.direction) > 0;
  point.geometricNormal = point.fromBehind ? -outward : outward;
  for (const Float3& corner : triangle.positions) {
    point.clearance = std::max(point.clearance, kClearance * largest(corner));
  }

  const TextureFrame frame(triangle, outward);
  const TexturePoint texcoord = triangle.texcoord(where);
  const TextureFootprint footprint =
      footprintOf(frame, outward, beam.direction, beam.width + beam.spread * hit.distance);
  const auto texelOf = [&](int texture) {
    return textures_[static_cast<std::size_t>(texture)].mean(texcoord, footprint);
  };

  point.kind = material.kind;
  point.colour = product(material.baseColour, triangle.colour(where));
  if (material.baseColourTexture >= 0) {
    const Texel texel = texelOf(material.baseColourTexture);
    point.colour = product(point.colour, {texel[0], texel[1], texel[2]});
  }
  point.colour = unit(point.colour);
  point.metallic = material.metallic;
  point.roughness = material.roughness;
  if (material.metallicRoughnessTexture >= 0) {
    const Texel texel = texelOf(material.metallicRoughnessTexture);
    point.roughness *= texel[1];
    point.metallic *= texel[2];
  }
  point.metallic = unit(point.metallic);
  point.roughness = unit(point.roughness);
  point.specular = unit(material.specular);
  point.ior = material.ior;

  Float3 normal = outward;
  if (!mesh.normals.empty()) {
    const Float3 smooth = interpolated(float3(mesh.normals[triangle.corners[0]]),
                                       float3(mesh.normals[triangle.corners[1]]),
                                       float3(mesh.normals[triangle.corners[2]]), where);
    if (length(smooth) > 1e-6f) normal = normalised(smooth);
    if (dot(normal, outward) < 0) normal = -normal;
  }
  if (material.normalTexture >= 0) {
    normal = mappedNormal(texelOf(material.normalTexture), frame, normal);
  }
  if (point.fromBehind) normal = -normal;
  point.shadingNormal = facing(normal, -beam.direction);
  return point;
}

SurfacePoint SceneSurfaces::onCurve(const Hit& hit, const BeamRay& beam) const {
  const std::size_t set = hit.geometry - scene_.meshes.size();
  const CurveSet& curves = scene_.curves[set];
  const Material& material = scene_.materials[static_cast<std::size_t>(curves.material)];
  const std::uint32_t first = segments_[set][hit.primitive];

  // The uniform cubic B-spline's blending functions and their derivatives.
  const float t = hit.u, s = 1 - t;
  const std::array<float, 4> blend{s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                                   (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
  const std::array<float, 4> slope{-s * s / 2, (3 * t * t - 4 * t) / 2, (4 * s - 3 * s * s) / 2,
                                   t * t / 2};
  SurfacePoint point;
  Float3 along;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& control = curves.points[first + k];
    along = along + slope[k] * Float3{control[0], control[1], control[2]};
    point.hairRadius += blend[k] * control[3];
  }
  point.position = beam.origin + hit.distance * beam.direction;
  const Float3 outward = normalised(hit.normal);
  point.geometricNormal = dot(outward, beam.direction) > 0 ? -outward : outward;
  point.shadingNormal = facing(point.geometricNormal, -beam.direction);
  point.tangent = length(along) > 0 ? normalised(along) : Frame(outward).x;
  point.clearance = kClearance * (largest(point.position) + hit.distance);
  point.kind = Material::Kind::Hair;
  point.colour = material.baseColour;
  if (!curves.colours.empty()) {
    point.colour = product(point.colour, curves.colours[curveOfSegment_[set][hit.primitive]]);
  }
  point.colour = unit(point.colour);
  point.roughness = unit(material.roughness);
  point.specular = unit(material.specular);
  return point;
}

RayTree::Filtered SceneSurfaces::filtered() const {
  RayTree::Filtered filtered;
  for (const TriangleMesh& mesh : scene_.meshes) {
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    filtered.holes.push_back(material.alphaCutoff > 0 && material.baseColourTexture >= 0);
    filtered.glass.push_back(material.kind == Material::Kind::Glass);
  }
  return filtered;
}

bool SceneSurfaces::isHole(std::uint32_t geometry, std::uint32_t triangle, float u, float v) const {
  const TriangleMesh& mesh = scene_.meshes[geometry];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  if (!(material.alphaCutoff > 0) || material.baseColourTexture < 0) return false;
  const TexturePoint at = Triangle(mesh, triangle).texcoord({1 - u - v, u, v});
  const auto& texture = textures_[static_cast<std::size_t>(material.baseColourTexture)];
  return texture.bilinear(at)[3] < material.alphaCutoff;
}

std::optional<OpticalDepth> SceneSurfaces::lossThrough(std::uint32_t geometry,
                                                       std::uint32_t triangle, float u, float v,
                                                       float cosine) const {
  const TriangleMesh& mesh = scene_.meshes[geometry];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  const Triangle corners(mesh, triangle);
  const Barycentric where{1 - u - v, u, v};
  LinearRgb colour = product(material.baseColour, corners.colour(where));
  if (material.baseColourTexture >= 0) {
    const auto& texture = textures_[static_cast<std::size_t>(material.baseColourTexture)];
    const Texel texel = texture.bilinear(corners.texcoord(where));
    colour = product(colour, {texel[0], texel[1], texel[2]});
  }
  const float passes = 1 - dielectricReflectance(cosine, material.ior);
  const auto depth = [&](float c) {
    // What is darker than 2^-60 is black; sums over a few surfaces stay within 32 bits.
    const float bits = -std::log2(std::max(unit(c) * passes, 0x1p-60f));
    return static_cast<std::int32_t>(std::lround(bits * 0x1p20f));
  };
  const OpticalDepth loss{depth(colour.r), depth(colour.g), depth(colour.b)};
  return loss;
}

std::uint64_t SceneSurfaces::bytes() const {
  std::uint64_t bytes = 0;
  for (const TexturePyramid& texture : textures_) bytes += texture.bytes();
  for (const TriangleMesh& mesh : scene_.meshes) {
    bytes += mesh.positions.size() * sizeof(mesh.positions[0]) +
             mesh.normals.size() * sizeof(mesh.normals[0]) +
             mesh.texcoords.size() * sizeof(mesh.texcoords[0]) +
             mesh.colours.size() * sizeof(mesh.colours[0]) +
             mesh.triangles.size() * sizeof(mesh.triangles[0]);
  }
  for (const CurveSet& curves : scene_.curves) {
    bytes += curves.points.size() * (sizeof(curves.points[0]) + 2 * sizeof(std::uint32_t)) +
             curves.colours.size() * sizeof(curves.colours[0]);
  }
  return bytes;
}

}  // namespace illum
