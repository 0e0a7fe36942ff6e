// object.json: what is read can be written, and reads back as the same text.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "illum/error.h"
#include "object/manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  illum::Manifest manifest;
  try {
    manifest = illum::manifestFromText({reinterpret_cast<const char*>(data), size}, "object.json");
  } catch (const illum::Error&) {
    return 0;
  }
  const std::string text = illum::textOf(manifest);
  if (illum::textOf(illum::manifestFromText(text, "object.json")) != text) std::abort();
  return 0;
}
