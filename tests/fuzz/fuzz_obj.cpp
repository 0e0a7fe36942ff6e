// What assimp passes over in an OBJ file.
#include <cstdint>
#include <string_view>

#include "illum/error.h"
#include "scene/obj_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    illum::checkedObjMaterials({reinterpret_cast<const char*>(data), size}, "mesh.obj");
  } catch (const illum::Error&) {
  }
  return 0;
}
