// How deep an FBX file, text or binary, nests.
#include <cstdint>
#include <span>

#include "illum/error.h"
#include "scene/fbx_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    illum::checkFbx(std::as_bytes(std::span(data, size)), "mesh.fbx");
  } catch (const illum::Error&) {
  }
  return 0;
}
