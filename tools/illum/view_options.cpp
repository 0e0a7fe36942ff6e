#include "view_options.h"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "illum/error.h"
#include "lumigraph/camera_path.h"
#include "lumigraph/default_focus.h"
#include "lumigraph/view_projector.h"
#include "numbers.h"

namespace illum::cli {
namespace {

constexpr int kLongestSide = 1 << 16;  // of a synthesised picture

std::vector<View> viewsOf(const Object& object) {
  std::vector<View> views;
  for (int group = 0; group < object.groups(); ++group) views.push_back(object.view(group));
  return views;
}

Size sizeFrom(const std::string& text) {
  Size size;
  int end = 0;
  const int found = std::sscanf(text.c_str(), "%dx%d%n", &size.width, &size.height, &end);
  if (found != 2 || static_cast<std::size_t>(end) != text.size() || size.width < 1 ||
      size.height < 1 || size.width > kLongestSide || size.height > kLongestSide) {
    throw Error(Fault::Usage, fmt::format("--size: expected columns and rows, 1 to {}, such as "
                                          "640x480, found \"{}\"",
                                          kLongestSide, text));
  }
  return size;
}

LookAt lookFrom(const Numbers& numbers, Direction up) {
  LookAt look;
  look.eye = numbers.vector(0);
  look.target = numbers.vector(3);
  look.up = up.vector();
  if (numbers.count() == 7) look.fieldOfViewDegrees = numbers[6];
  try {
    checkPose(look);
  } catch (const Error& error) {
    throw Error(Fault::Usage, fmt::format("--camera: {}", error.what()));
  }
  return look;
}

// The slab whose window and depths the choice is about.
std::optional<LightSlab> slabOf(const Object& object, const ViewChoice& choice) {
  if (choice.slab) return choice.slab;
  const auto* first = std::get_if<SlabView>(&object.view(0).geometry);
  return first != nullptr ? std::optional(first->slab) : std::nullopt;
}

}  // namespace

void ViewOptions::addTo(CLI::App& command) {
  const std::string group = "Views";
  auto* named = command.add_option(
      "--view", view,
      "u,v from 0 to 1 of a slab, slab:u,v, or a view's name (default: the middle)");
  auto* free = command.add_option("--camera", camera,
                                  "ex,ey,ez,tx,ty,tz[,degrees]: eye, target, angle of view from "
                                  "bottom to top (default: 40); or a file of JSON");
  free->excludes(named);
  command
      .add_option("--size", size, "WxH of pictures of --camera and --path (default: as the views)")
      ->group(group);
  command
      .add_option("--aperture", aperture,
                  "radius on the plane of a slab's view points, with "
                  "--focus")
      ->group(group);
  command
      .add_option("--focus", focus,
                  "what is sharp, instead of by depth: z in the slab's frame, "
                  "else the distance before the camera")
      ->group(group);
  command.add_flag("--no-depth", noDepth, "interpolate between views as if depth was not known")
      ->group(group);
  command
      .add_option("--blend", blend,
                  "views that a pixel is blended of, where views are no slab's "
                  "(default: 4)")
      ->group(group);
  named->group(group);
  free->group(group);
  addPathOptions(command);
}

void ViewOptions::addPathOptions(CLI::App& command) {
  const std::string group = "Films";
  auto* way = command
                  .add_option("--path", path,
                              "a numbered picture for each camera of a way: orbit, from --view or "
                              "--camera on, or a file of JSON")
                  ->group(group);
  command.add_option("--frames", frames, "how many pictures (orbit: 36)")->needs(way)->group(group);
  command.add_option("--arc", arcDegrees, "of an orbit, in degrees (default: 360)")
      ->needs(way)
      ->group(group);
  command.add_option("--elevation", elevationDegrees, "of an orbit (default: that of its start)")
      ->needs(way)
      ->group(group);
}

CameraPose ViewOptions::pose(Direction up) const {
  const Numbers numbers("--camera",
                        "ex,ey,ez,tx,ty,tz, ex,ey,ez,tx,ty,tz,degrees or a file of JSON", camera);
  if (numbers.count() == 6 || numbers.count() == 7) return lookFrom(numbers, up);
  if (numbers.count() > 0 || !camera.ends_with(".json")) throw numbers.wrong();
  return readCamera(camera);
}

Size ViewOptions::pictureSize(const Object& object) const {
  return size.empty() ? sizeOf(middleView(viewsOf(object)).geometry) : sizeFrom(size);
}

ViewGeometry ViewOptions::geometry(const CameraPose& from, const Object& object) const {
  if (!size.empty() && !std::holds_alternative<LookAt>(from)) {
    throw Error(Fault::Usage, fmt::format("--size: expected none, as {} says how large its picture "
                                          "is, found \"{}\"",
                                          path.empty() ? camera : path, size));
  }
  return geometryOf(from, pictureSize(object));
}

LookAt ViewOptions::orbitStart(const Object& object, Direction up) const {
  const std::vector<View> views = viewsOf(object);
  if (camera.empty()) {
    return lookOf(view.empty() ? middleView(views) : viewNamed(views, view), views, up.vector());
  }
  const CameraPose from = pose(up);
  if (const auto* look = std::get_if<LookAt>(&from)) return *look;
  return lookOf({std::nullopt, geometryOf(from, {}), {}}, views, up.vector());
}

std::vector<CameraPose> ViewOptions::pathPoses(const Object& object, Direction up) const {
  if (path != "orbit") {
    if (!path.ends_with(".json")) throw wrongOption("--path", "orbit or a file of JSON", path);
    CameraPath way = readCameraPath(path);
    if (frames && *frames < 1)
      throw wrongOption("--frames", "at least 1", fmt::format("{}", *frames));
    if (frames) way.frames = *frames;
    return framesOf(way);
  }
  OrbitOptions options{frames.value_or(36), arcDegrees, elevationDegrees};
  const LookAt start = orbitStart(object, up);
  const bool outward = std::holds_alternative<Panorama>(object.view(0).geometry);
  return outward ? turnRound(start, options) : orbit(start, options);
}

std::vector<ViewGeometry> ViewOptions::pathGeometries(const Object& object, Direction up) const {
  std::vector<ViewGeometry> geometries;
  for (const CameraPose& at : pathPoses(object, up)) geometries.push_back(geometry(at, object));
  return geometries;
}

ViewChoice ViewOptions::choice(const Object& object, Direction up) const {
  if (!size.empty() && camera.empty())
    throw Error(Fault::Usage, "--size: expected --camera or --path beside it, found neither");
  if (!camera.empty()) return {std::nullopt, geometry(pose(up), object), {}};
  const std::vector<View> views = viewsOf(object);
  ViewChoice chosen = view.empty() ? middleView(views) : viewNamed(views, view);
  // What is to be out of focus is not a picture that the object has.
  if (chosen.group && (aperture > 0 || focus)) {
    if (const auto* at = std::get_if<SlabView>(&chosen.geometry)) {
      const auto share = [](int place, int count) {
        return count > 1 ? place / (count - 1.0) : 0.5;
      };
      chosen.geometry =
          pinholeOf(at->slab, share(at->u, at->slab.uCount), share(at->v, at->slab.vCount));
      chosen.group.reset();
    }
  }
  return chosen;
}

Plane ViewOptions::focalPlane(const Object& object, const ViewChoice& choice) const {
  if (const auto slab = slabOf(object, choice)) {
    Plane plane = windowOf(*slab);
    plane.point = plane.point + *focus * plane.normal;
    return plane;
  }
  const ViewProjector eye(choice.geometry);
  if (eye.wraps() || !(*focus > 0)) {
    throw Error(Fault::Usage,
                fmt::format("--focus: expected a distance above 0 before a camera, found {}{}",
                            *focus, eye.wraps() ? " and a panorama" : ""));
  }
  return {eye.eye() + *focus * eye.axis(), eye.axis()};
}

SynthesisOptions ViewOptions::synthesis(const Object& object, const ViewChoice& choice) const {
  SynthesisOptions options;
  const bool isSlab = std::holds_alternative<SlabView>(object.view(0).geometry);
  const auto refuse = [](const char* sentence) { throw Error(Fault::Usage, sentence); };
  if (aperture != 0 && !isSlab) refuse("--aperture: expected an object of slabs, found another");
  if (blend != 0 && isSlab) refuse("--blend: expected an object without slabs, found slabs");
  if (aperture != 0 && !focus && !noDepth && object.hasDepth())
    refuse("--aperture: expected --focus or --no-depth, as with depth all is in focus");
  options.apertureRadius = aperture;
  options.useDepth = !noDepth;
  if (blend != 0) options.blendedViews = blend;
  if (focus) options.focus = focalPlane(object, choice);
  return options;
}

}  // namespace illum::cli
