// transforms.json: whatever is taken makes a capture.json that is taken too.
#include <cstdint>
#include <string_view>

#include "capture/camera_list.h"
#include "illum/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  illum::CaptureFile capture;
  try {
    capture = illum::captureFromTransforms({reinterpret_cast<const char*>(data), size}, "t.json",
                                           [](const std::string&) {
                                             return illum::Size{64, 48};
                                           });
  } catch (const illum::Error&) {
    return 0;
  }
  for (auto& view : capture.views) view.photographs = view.files.front();
  try {
    illum::captureFileFromText(illum::textOf(capture), "capture.json");
  } catch (const illum::Error&) {
    // Names may be longer, and lights more, than capture.json allows.
  }
  return 0;
}
