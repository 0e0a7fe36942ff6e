// The text of a scene file, and the plan of its capture.
#include <cstdint>
#include <string_view>

#include "illum/error.h"
#include "scene/scene_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    illum::planOf(illum::sceneFromText({reinterpret_cast<const char*>(data), size}, "scene.json"));
  } catch (const illum::Error&) {
  }
  return 0;
}
