#include "view_options.h"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "illum/error.h"
#include "lumigraph/camera_pose.h"
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
  command.add_option("--size", size, "WxH of --camera's picture (default: that of the views)")
      ->needs(free)
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
}

ViewGeometry ViewOptions::cameraGeometry(const Object& object, Direction up) const {
  const Size standard = sizeOf(middleView(viewsOf(object)).geometry);
  const Numbers numbers("--camera",
                        "ex,ey,ez,tx,ty,tz, ex,ey,ez,tx,ty,tz,degrees or a file of JSON", camera);
  if (numbers.count() > 0) {
    if (numbers.count() != 6 && numbers.count() != 7) throw numbers.wrong();
    return geometryOf(lookFrom(numbers, up), size.empty() ? standard : sizeFrom(size));
  }
  if (!camera.ends_with(".json")) throw numbers.wrong();
  const CameraPose pose = readCamera(camera);
  if (!size.empty() && !std::holds_alternative<LookAt>(pose)) {
    throw Error(Fault::Usage,
                fmt::format("--size: {} says already how large its picture is", camera));
  }
  return geometryOf(pose, size.empty() ? standard : sizeFrom(size));
}

ViewChoice ViewOptions::choice(const Object& object, Direction up) const {
  if (!camera.empty()) return {std::nullopt, cameraGeometry(object, up), {}};
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
