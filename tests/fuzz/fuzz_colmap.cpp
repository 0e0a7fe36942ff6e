// COLMAP's cameras.txt and images.txt, the one before and the other after the first '@'.
#include <cstdint>
#include <string_view>

#include "capture/camera_list.h"
#include "illum/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t middle = bytes.find('@');
  if (middle == std::string_view::npos) return 0;
  illum::ColmapText text;
  text.cameras = bytes.substr(0, middle);
  text.images = bytes.substr(middle + 1);
  text.camerasName = "cameras.txt";
  text.imagesName = "images.txt";
  try {
    const illum::CaptureFile capture = illum::captureFromColmap(text);
    for (const auto& view : capture.views) pictureOf(view, capture.lights.front(), 0);
  } catch (const illum::Error&) {
  }
  return 0;
}
