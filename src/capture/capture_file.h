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
  /// One a light, in place of `photographs`, where pictures have names of their own. Not written.
  std::vector<std::string> files = {};
};

struct CaptureFile {
  std::string generator;
  bool rendered = false;               ///< Capture::isRendered of what was written
  std::vector<LightFileEntry> lights;  ///< directions in the object frame
  std::vector<CaptureFileView> views;
  std::string proxy = {};  ///< a mesh in place of depth pictures; empty: none
};

std::string textOf(const CaptureFile& capture);
/// Untrusted input is safe. Throws Error naming `source` and the field.
CaptureFile captureFileFromText(std::string_view json, const std::string& source);

/// Throws Error naming the field, not the file, for what no capture is: names that leave the
/// folder, views of one name, masks or depths of some views alone.
void checkCaptureFile(const CaptureFile& capture);

/// Of one view under one light, which is the `index`-th. Throws Error (Fault::Input) if that leaves
/// the folder.
std::filesystem::path pictureOf(const CaptureFileView& view, const LightFileEntry& light,
                                int index);

}  // namespace illum
