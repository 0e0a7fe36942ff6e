// A proxy mesh, and its depth in a small view.
#include <cstdint>
#include <string_view>

#include "capture/proxy_mesh.h"
#include "illum/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const illum::ProxyMesh mesh =
        illum::proxyFromObj({reinterpret_cast<const char*>(data), size}, "proxy.obj");
    illum::PinholeCamera camera;
    camera.size = {16, 12};
    camera.focalX = camera.focalY = 14;
    camera.centre = {8, 6};
    illum::depthOfProxy(mesh, camera);
  } catch (const illum::Error&) {
  }
  return 0;
}
