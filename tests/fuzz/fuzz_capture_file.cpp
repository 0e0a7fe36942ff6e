// capture.json: what is read can be written, and reads back as the same text.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "capture/capture_file.h"
#include "illum/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  illum::CaptureFile capture;
  try {
    capture =
        illum::captureFileFromText({reinterpret_cast<const char*>(data), size}, "capture.json");
    for (const auto& view : capture.views) pictureOf(view, capture.lights.front(), 0);
  } catch (const illum::Error&) {
    return 0;
  }
  const std::string text = illum::textOf(capture);
  if (illum::textOf(illum::captureFileFromText(text, "capture.json")) != text) std::abort();
  return 0;
}
