// The fields of a scene file: their names, limits and meaning. One description drives the reader
// (scene/strict_reader.h) and the schema (scene/schema_writer.h).
#pragma once

#include "scene/field_about.h"
#include "scene/scene_description.h"

namespace illum::scenefile {

inline constexpr double kFar = 1e9;  // of a coordinate: float keeps enough of it
inline constexpr double kTiny = 1e-9;
inline constexpr int kMaxViewPoints = 1024;  // in a row or column of a slab
inline constexpr int kMaxPictureSide = 65536;
inline constexpr int kMaxGridLights = 100'000;
inline constexpr std::size_t kMaxRecords = 10'000;  // of meshes, hairs, materials, views
inline constexpr std::size_t kMaxCurves = 200'000;  // written into a scene file
inline constexpr std::size_t kMaxCurvePoints = 1000;

template <typename Visitor>
void describe(Visitor& v, FrameRecord& frame) {
  v.numbers({"rotation", "rows of a rotation matrix, object from frame"}, frame.rotation, -1.000001,
            1.000001);
  v.triple({"translation", "the frame's origin in the object"}, frame.translation, -kFar, kFar);
}

template <typename Visitor>
void describePlacement(Visitor& v, PlacementRecord& placement) {
  v.spread({"scale", "applied first; one factor, or one for each axis"}, placement.scale, -kFar,
           kFar);
  v.triple({"rotateDegrees", "then turned about x, then y, then z, right-handed"},
           placement.rotateDegrees, -36000, 36000);
  v.triple({"translate", "then moved"}, placement.translate, -kFar, kFar);
}

template <typename Visitor>
void describe(Visitor& v, MeshRecord& mesh) {
  v.text({"name", "for messages"}, mesh.name);
  v.text({"file", "a mesh file (.gltf, .glb, .obj, .ply, .fbx), beside the scene file"}, mesh.file);
  v.choice({"shape", "a shape that reaches from -1 to 1, in place of a file"}, mesh.shape,
           {{Shape::Box, "box"},
            {Shape::Rectangle, "rectangle"},
            {Shape::Sphere, "sphere"},
            {Shape::Teapot, "teapot"}});
  v.text({"material", "of everything in it, one of 'materials'"}, mesh.material);
  v.texts({"materials", "replaces the file's materials: name in the file, one of 'materials'"},
          mesh.materials);
  v.number({"smoothDegrees",
            "where a file has no normals: edges flatter than this are smooth (glTF 0, others 60)"},
           mesh.smoothDegrees, 0, 175);
  describePlacement(v, mesh.placement);
}

template <typename Visitor>
void describe(Visitor& v, MaterialRecord& record) {
  Material& material = record.material;
  v.choice({"kind", "metallic-roughness surface, ideal mirror, glass, or the material of hair"},
           material.kind,
           {{Material::Kind::Surface, "surface"},
            {Material::Kind::Mirror, "mirror"},
            {Material::Kind::Glass, "glass"},
            {Material::Kind::Hair, "hair"}});
  v.colour({"baseColour", "linear Rec.709; grey, or red, green, blue"}, material.baseColour, 0, 1);
  v.number({"metallic", "0 for a dielectric, 1 for a metal"}, material.metallic, 0, 1);
  v.number({"roughness", "perceptual: its square is the alpha of GGX"}, material.roughness, 0, 1);
  v.number({"specular", "of a dielectric: reflectance at normal incidence is 0.08 times this"},
           material.specular, 0, 1);
  v.number({"ior", "refractive index of glass"}, material.ior, 1, 4);
  v.number({"alphaCutoff", "texels of baseColourTexture with less alpha are holes; 0: none are"},
           material.alphaCutoff, 0, 1);
  v.text({"baseColourTexture", "a picture, multiplied by baseColour"}, record.baseColourTexture);
  v.text({"metallicRoughnessTexture", "roughness in green, metallic in blue, multiplied alike"},
         record.metallicRoughnessTexture);
  v.text({"normalTexture", "normals in tangent space, y up"}, record.normalTexture);
}

template <typename Visitor>
void describe(Visitor& v, HairRecord& hair) {
  v.text({"name", "for messages"}, hair.name);
  v.text({"file", "a text of hairs: a line for each point, a blank line after each hair"},
         hair.file);
  v.polylines({"curves", "in place of a file: lists of points from root to tip"}, hair.curves,
              kMaxCurves, kMaxCurvePoints, kFar);
  v.numbers({"radius", "at root and tip"}, hair.radius, 0, kFar);
  v.text({"material", "one of 'materials'"}, hair.material);
  describePlacement(v, hair.placement);
}

template <typename Visitor>
void describeSize(Visitor& v, SizeRecord& size) {
  v.integers({"size", "width and height in pixels"}, size, 1, kMaxPictureSide);
}

template <typename Visitor>
void describe(Visitor& v, SlabRecord& slab) {
  v.text({"name", "of the slab, for --view NAME:u,v"}, slab.name);
  v.integers({"viewPoints", "columns and rows of the uv grid"}, slab.viewPoints, 1, kMaxViewPoints);
  v.record({"frame", "the slab's own frame; else it looks at the middle of the scene"}, slab.frame);
  v.triple({"toward", "direction from the object to the view points"}, slab.toward, -kFar, kFar);
  v.triple({"up", "what is up in the window"}, slab.up, -kFar, kFar);
  v.number({"distance", "from the window to the view points; else 4 radii of the scene"},
           slab.distance, kTiny, kFar);
  v.numbers({"uv", "left, bottom, right, top of the view points' plane; else by spreadDegrees"},
            slab.uv, -kFar, kFar);
  v.numbers({"spreadDegrees", "angles between the outermost view points, across and upward"},
            slab.spreadDegrees, 0, 170);
  v.numbers({"window", "left, bottom, right, top; else what the views see of the scene"},
            slab.window, -kFar, kFar);
  v.integers({"size", "width and height of the window in pixels; else by longerSide"}, slab.size, 1,
             kMaxPictureSide);
  v.integer({"longerSide", "of the window, in pixels"}, slab.longerSide, 1, kMaxPictureSide);
}

template <typename Visitor>
void describe(Visitor& v, TurnRecord& turn) {
  v.text({"name", "of the slabs, followed by their number"}, turn.name);
  v.integer({"slabs", "how many stand around the object"}, turn.slabs, 1, 360);
  v.number({"elevationDegrees", "of the slabs above the object's equator"}, turn.elevationDegrees,
           -85, 85);
  v.integers({"viewPoints", "columns and rows of each uv grid"}, turn.viewPoints, 1,
             kMaxViewPoints);
  v.triple({"up", "what is up in the windows"}, turn.up, -kFar, kFar);
  v.number({"distance", "from the windows to the view points; else 4 radii of the scene"},
           turn.distance, kTiny, kFar);
  v.numbers({"spreadDegrees", "angles between a slab's outermost view points; else the slabs meet"},
            turn.spreadDegrees, 0, 170);
  v.numbers({"window", "left, bottom, right, top; else what the views see of the scene"},
            turn.window, -kFar, kFar);
  v.integers({"size", "width and height of the windows in pixels; else by longerSide"}, turn.size,
             1, kMaxPictureSide);
  v.integer({"longerSide", "of the windows, in pixels"}, turn.longerSide, 1, kMaxPictureSide);
}

template <typename Visitor>
void describe(Visitor& v, PhotographRecord& photograph) {
  v.text({"name", "of the view"}, photograph.name);
  describeSize(v, photograph.size);
}

template <typename Visitor>
void describe(Visitor& v, CameraRecord& camera) {
  v.text({"name", "of the view"}, camera.name);
  v.triple({"eye", "where the camera stands; else in front of the scene"}, camera.eye, -kFar, kFar);
  v.triple({"target", "what it looks at; else the middle of the scene"}, camera.target, -kFar,
           kFar);
  v.triple({"up", "what is up in the picture"}, camera.up, -kFar, kFar);
  v.number({"fieldOfViewDegrees", "across the longer side"}, camera.fieldOfViewDegrees, 0.01, 170);
  v.record({"frame", "the camera's frame, looking along its -z, in place of eye, target and up"},
           camera.frame);
  v.numbers({"focal", "focal lengths in pixels, with 'frame'"}, camera.focal, kTiny, kFar);
  v.numbers({"centre", "the principal point in pixels from the top left, with 'frame'"},
            camera.centre, -kFar, kFar);
  describeSize(v, camera.size);
}

template <typename Visitor>
void describe(Visitor& v, PanoramaRecord& panorama) {
  v.text({"name", "of the view"}, panorama.name);
  v.choice({"projection", "rows even in elevation, or in height on a cylinder of radius 1"},
           panorama.projection,
           {{Panorama::Projection::Equirectangular, "equirectangular"},
            {Panorama::Projection::Cylindrical, "cylindrical"}});
  v.triple({"eye", "the point around which everything is seen"}, panorama.eye, -kFar, kFar);
  v.triple({"toward", "where the picture's centre looks"}, panorama.toward, -kFar, kFar);
  v.triple({"up", "what is up"}, panorama.up, -kFar, kFar);
  v.numbers({"azimuthDegrees", "left and right edge, growing to the right of 'toward'"},
            panorama.azimuthDegrees, -720, 720);
  v.numbers({"elevationDegrees", "bottom and top edge of an equirectangular picture"},
            panorama.elevationDegrees, -90, 90);
  v.numbers({"heights", "bottom and top edge of a cylindrical picture"}, panorama.heights, -1000,
            1000);
  describeSize(v, panorama.size);
}

template <typename Visitor>
void describe(Visitor& v, ViewEntryRecord& view) {
  v.record({"slab", "a light slab: a grid of view points before a window"}, view.slab);
  v.record({"turn", "several slabs around the object"}, view.turn);
  v.record({"photograph", "one view along -z without perspective, showing x and y from -1 to 1"},
           view.photograph);
  v.record({"camera", "a pinhole camera"}, view.camera);
  v.record({"panorama", "all that is around a point"}, view.panorama);
}

template <typename Visitor>
void describe(Visitor& v, LightsRecord& lights) {
  v.integer({"fibonacci", "so many, evenly spread (64 where nothing is said)"}, lights.fibonacci, 1,
            kMaxGridLights);
  v.integers({"polar", "rings between +z and the region's edge, and lights to a ring"},
             lights.polar, 1, kMaxGridLights);
  v.triples({"directions", "from the object to the lights"}, lights.directions, kMaxGridLights,
            kFar);
  v.text({"file", "a light file (.lp)"}, lights.file);
  v.choice({"region",
            "of fibonacci and polar: the half before the window (the choice for views "
            "from one side), or all around (for turns and panoramas)"},
           lights.region,
           {{LightRegion::Hemisphere, "hemisphere"}, {LightRegion::Sphere, "sphere"}});
  v.number({"radiusDegrees", "of the disc that each light is; else half their spacing"},
           lights.radiusDegrees, 0, 89.9);
}

template <typename Visitor>
void describe(Visitor& v, SceneDescription& scene) {
  v.version({"illumScene", "the version of this format"}, 1);
  v.text({"comment", "for people"}, scene.comment);
  v.flag({"normalise", "moves the scene about the origin and scales it to reach from -1 to 1"},
         scene.normalise);
  v.records({"meshes", "what there is to see"}, scene.meshes, kMaxRecords);
  v.records({"hair", "curves"}, scene.hair, kMaxRecords);
  v.dictionary({"materials", "by name"}, scene.materials, kMaxRecords);
  v.records({"views", "from where it is seen: each has one field; one slab in front if none"},
            scene.views, kMaxRecords);
  v.part({"lights", "under which it is seen one after another"}, scene.lights);
  v.integer({"samples", "camera rays to a pixel"}, scene.samples, 1, 65536);
  v.integer({"bounces", "interreflections"}, scene.bounces, 0, 64);
  v.number({"filterRadius", "of the pixel filter, in pixels"}, scene.filterRadius, 0.01, 4);
  v.integer({"seed", "of the random numbers"}, scene.seed, 0, 9007199254740991);
}

}  // namespace illum::scenefile
