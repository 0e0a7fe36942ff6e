// Light files: every light that is read is a unit vector with a finite positive intensity.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "illum/error.h"
#include "illum/light_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  illum::LightFile file;
  try {
    file = illum::parseLightFile({reinterpret_cast<const char*>(data), size}, "lights.lp");
  } catch (const illum::Error&) {
    return 0;
  }
  if (file.entries.empty()) std::abort();
  for (const illum::LightFileEntry& entry : file.entries) {
    if (!(std::abs(illum::length(entry.light.toLight.vector()) - 1) < 1e-12)) std::abort();
    for (const float i :
         {entry.light.intensity.r, entry.light.intensity.g, entry.light.intensity.b})
      if (!(i > 0) || !std::isfinite(i)) std::abort();
  }
  return 0;
}
