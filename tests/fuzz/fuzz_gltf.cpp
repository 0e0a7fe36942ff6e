// What a glTF file, text or binary, has, and asks for beyond what is supported.
#include <cstdint>
#include <span>

#include "illum/error.h"
#include "scene/gltf_features.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    illum::gltfFeatures(std::as_bytes(std::span(data, size)), "mesh.glb");
  } catch (const illum::Error&) {
  }
  return 0;
}
