// What a glTF file, text or binary, has, and asks for beyond what is supported; its texture
// coordinates of bytes and shorts.
#include <cstdint>
#include <span>

#include "illum/error.h"
#include "scene/gltf_features.h"
#include "scene/gltf_texcoords.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto file = std::as_bytes(std::span(data, size));
    if (illum::gltfFeatures(file, "mesh.glb").meshes.packedTexcoords)
      illum::withFloatTexcoords(file, "nowhere/mesh.glb");
  } catch (const illum::Error&) {
  }
  return 0;
}
