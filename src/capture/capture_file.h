// capture.json: which pictures of a folder show which view under which light.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "illum/camera.h"
#include "illum/light_file.h"

namespace illum {

inline constexpr std::string_view kCaptureFileName = "capture.json";

/// A view and its pictures, named relative to the folder with `/` between parts.
struct CaptureFileView {
  View view;
  /// {light} stands for a light's name, {index} for its place in the list, of four digits at least.
  std::string photographs;
  std::string mask, depth;  ///< empty: none
};

struct CaptureFile {
  std::string generator;
  bool rendered = false;               ///< Capture::isRendered of what was written
  std::vector<LightFileEntry> lights;  ///< directions in the object frame
  std::vector<CaptureFileView> views;
};

std::string textOf(const CaptureFile& capture);
/// Untrusted input is safe. Throws Error naming `source` and the field.
CaptureFile captureFileFromText(std::string_view json, const std::string& source);

/// `pattern` for one light. Throws Error (Fault::Input) if that leaves the folder.
std::filesystem::path pictureOf(const std::string& pattern, const LightFileEntry& light, int index);

}  // namespace illum
