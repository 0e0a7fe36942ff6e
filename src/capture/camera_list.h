// Photographs with camera poses as other programs write them: transforms.json of instant-ngp and
// nerfstudio, the text files of COLMAP. Both become a CaptureFile.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "capture/capture_file.h"

namespace illum {

inline constexpr std::string_view kTransformsFileName = "transforms.json";

/// The size of a picture of the folder, where a file of cameras does not say it.
using SizeOfPicture = std::function<Size(const std::string& name)>;

/// Frames that stand at the same place are one view under several lights; frames' positions of
/// lights (`pl_pos` or `light_position`) become directions from the origin and intensities by the
/// square of the distance, 1 in the mean. Without any, all views are seen under one light, "light",
/// from the first camera's side. Lens distortion is refused by name. Untrusted input is safe.
/// Throws Error naming `source` and the field.
CaptureFile captureFromTransforms(std::string_view json, const std::string& source,
                                  const SizeOfPicture& sizeOfPicture);

struct ColmapText {
  std::string cameras, images;          ///< the text of cameras.txt and images.txt
  std::string camerasName, imagesName;  ///< for messages
  std::string picturesFolder;           ///< where pictures are, relative to the capture's folder
};
/// Cameras of the models PINHOLE and SIMPLE_PINHOLE; others distort and are refused by name. One
/// light. As safe as captureFromTransforms.
CaptureFile captureFromColmap(const ColmapText& text);

/// Which of the files that this and capture_file.h read stands in `folder`: capture.json,
/// transforms.json, or COLMAP's cameras.txt and images.txt in it, in sparse/ or in sparse/0/ (its
/// pictures in images/, or beside the files). Empty path: none. Beside lists of other programs a
/// proxy.obj in `folder` is the mesh of what they show.
std::filesystem::path cameraListIn(const std::filesystem::path& folder);

}  // namespace illum
