// A hair file, and the curves of its hairs.
#include <cstdint>
#include <string_view>

#include "illum/error.h"
#include "scene/hair_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    illum::CurveSet curves;
    for (const auto& hair :
         illum::hairsFromText({reinterpret_cast<const char*>(data), size}, "hair.txt"))
      illum::addHair(curves, hair, {0.01, 0.001});
  } catch (const illum::Error&) {
  }
  return 0;
}
