// Captures of many views as folders of pictures: FOLDER/capture.json and what it names, or another
// program's list of cameras (docs/guide/capture.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "illum/capture.h"
#include "illum/progress.h"

namespace illum {

/// Whether a folder says where its pictures were taken from: by a capture.json, a transforms.json
/// (nerfstudio, instant-ngp), or the text files of COLMAP in it, in sparse/ or in sparse/0/.
bool isCaptureFolder(const std::filesystem::path& folder);

/// Opens such a folder. Of the options only memoryBytes and scratch count. Throws Error. `progress`
/// must outlive the capture.
std::unique_ptr<Capture> openCaptureFolder(const std::filesystem::path& folder,
                                           const PhotographOptions& options, Progress& progress);

/// The same views with a depth for each pixel, found by comparing each view's picture with those of
/// the four about it (plane sweep), when it is read. Holds at most `memoryBytes` besides. Throws
/// Error for captures that have depth, are rendered, or are not of cameras and slabs at two places
/// at least, and (Fault::Machine) where that is not enough memory.
std::unique_ptr<Capture> withSweptDepth(std::unique_ptr<Capture> capture,
                                        std::uint64_t memoryBytes);

struct CaptureFolderOptions {
  bool half = false;              ///< samples as halves instead of floats; mask and depth stay
  bool force = false;             ///< replace a capture that is there
  std::uint64_t memoryBytes = 0;  ///< for pictures on their way; 0: a quarter of the machine
  /// Asked, from any thread, whenever progress is made; true stops the work, and nothing of it
  /// remains.
  std::function<bool()> stop;
};

/// What the pictures take before they are compressed.
std::uint64_t captureFolderBytes(const Capture& capture, bool half);

/// Writes every sample of `capture`, which must be linear, into a new folder, which comes to be all
/// at once. Opening it again gives the same views, lights and (unless halved) samples; intensities
/// are 1, because samples are divided by theirs. Returns false if it was stopped. Throws Error.
bool writeCaptureFolder(const Capture& capture, const std::filesystem::path& folder,
                        const CaptureFolderOptions& options, Progress& progress);

}  // namespace illum
