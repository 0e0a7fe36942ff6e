// What a scene file says, before any file that it names is opened.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "illum/camera.h"
#include "illum/colour.h"
#include "illum/vector.h"
#include "scene/light_grid.h"
#include "scene/scene.h"

namespace illum {

/// point = translate + Rz Ry Rx (scale * point)
struct PlacementRecord {
  Vector3 scale{1, 1, 1};
  Vector3 rotateDegrees;
  Vector3 translate;
};

enum class Shape { Box, Rectangle, Sphere, Teapot };

/// A mesh file, or a shape that reaches from -1 to 1.
struct MeshRecord {
  std::string name;
  std::optional<std::string> file;
  std::optional<Shape> shape;
  std::optional<std::string> material;           ///< of everything in it
  std::map<std::string, std::string> materials;  ///< name in the file -> ours
  std::optional<double> smoothDegrees;
  PlacementRecord placement;
};

struct MaterialRecord {
  Material material;  ///< without name and textures
  std::optional<std::string> baseColourTexture, metallicRoughnessTexture, normalTexture;
};

/// Hairs through points, from root to tip.
struct HairRecord {
  std::string name;
  std::optional<std::string> file;
  std::vector<std::vector<Vector3>> curves;
  std::array<double, 2> radius{0.005, 0.002};  ///< at root and tip
  std::optional<std::string> material;
  PlacementRecord placement;
};

struct FrameRecord {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row-major
  Vector3 translation;
};

/// Left, bottom, right, top; or width and height; as the file lists them.
using RectangleRecord = std::array<double, 4>;
using SizeRecord = std::array<int, 2>;

struct SlabRecord {
  std::string name = "slab";
  std::array<int, 2> viewPoints{5, 5};
  std::optional<FrameRecord> frame;
  Vector3 toward{0, 0, 1}, up{0, 1, 0};
  std::optional<double> distance;
  std::optional<RectangleRecord> uv, window;
  std::array<double, 2> spreadDegrees{28, 28};
  std::optional<SizeRecord> size;
  int longerSide = 256;
};

struct TurnRecord {
  std::string name = "turn";
  int slabs = 8;
  double elevationDegrees = 0;
  std::array<int, 2> viewPoints{5, 5};
  Vector3 up{0, 1, 0};
  std::optional<double> distance;
  std::optional<std::array<double, 2>> spreadDegrees;  ///< else the slabs meet, 28 upward
  std::optional<RectangleRecord> window;
  std::optional<SizeRecord> size;
  int longerSide = 256;
};

struct PhotographRecord {
  std::string name = "photograph";
  SizeRecord size{512, 512};
};

/// By looking (eye, target, up, field of view) or as it is (frame, focal, centre).
struct CameraRecord {
  std::string name = "camera";
  std::optional<Vector3> eye, target, up;
  std::optional<double> fieldOfViewDegrees;
  std::optional<FrameRecord> frame;
  std::optional<std::array<double, 2>> focal, centre;
  SizeRecord size{512, 512};
};

struct PanoramaRecord {
  std::string name = "panorama";
  Panorama::Projection projection = Panorama::Projection::Equirectangular;
  Vector3 eye;
  Vector3 toward{0, 0, -1}, up{0, 1, 0};  ///< `toward`: where the picture's centre looks
  std::array<double, 2> azimuthDegrees{-180, 180};
  std::optional<std::array<double, 2>> elevationDegrees, heights;
  SizeRecord size{1024, 512};
};

/// Exactly one of them.
struct ViewEntryRecord {
  std::optional<SlabRecord> slab;
  std::optional<TurnRecord> turn;
  std::optional<PhotographRecord> photograph;
  std::optional<CameraRecord> camera;
  std::optional<PanoramaRecord> panorama;
};

/// At most one of the first four; none of them: a Fibonacci grid of 64.
struct LightsRecord {
  std::optional<int> fibonacci;
  std::optional<std::array<int, 2>> polar;
  std::vector<Vector3> directions;
  std::optional<std::string> file;
  std::optional<LightRegion> region;
  std::optional<double> radiusDegrees;
};

struct SceneDescription {
  std::string comment;
  bool normalise = false;
  std::vector<MeshRecord> meshes;
  std::vector<HairRecord> hair;
  std::map<std::string, MaterialRecord> materials;
  std::vector<ViewEntryRecord> views;
  LightsRecord lights;
  int samples = 4, bounces = 1;
  double filterRadius = 0.75;
  std::uint64_t seed = 0;
};

}  // namespace illum
