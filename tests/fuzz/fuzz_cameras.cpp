// A camera or a path of cameras: what is read can be looked through, all along the path.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "illum/error.h"
#include "lumigraph/camera_path.h"

namespace {

void lookThrough(const illum::CameraPose& pose) {
  const illum::ViewGeometry view = geometryOf(pose, {8, 6});
  const illum::Size size = sizeOf(view);
  if (size.width < 1 || size.height < 1) std::abort();
  if (!(length(rayThrough(view, {0.5, 0.5}).direction) < 2)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  try {
    lookThrough(illum::cameraFromText(text, "camera.json"));
  } catch (const illum::Error&) {
  }
  try {
    illum::CameraPath path = illum::cameraPathFromText(text, "path.json");
    if (path.frames > 100) path.frames = 100;
    for (const illum::CameraPose& pose : framesOf(path)) lookThrough(pose);
  } catch (const illum::Error&) {
  }
  return 0;
}
