// A set-up of lights: what is read can be written, and reads back as the same text.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "illum/error.h"
#include "illum/lighting.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  illum::Lighting lighting;
  try {
    lighting = illum::lightingFromText({reinterpret_cast<const char*>(data), size}, "setup.json");
  } catch (const illum::Error&) {
    return 0;
  }
  const std::string text = textOf(lighting);
  if (textOf(illum::lightingFromText(text, "setup.json")) != text) std::abort();
  return 0;
}
