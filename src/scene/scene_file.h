// Scenes from files: a scene file, or a mesh file alone.
#pragma once

#include <filesystem>

#include "illum/progress.h"
#include "scene/capture_plan.h"
#include "scene/scene.h"

namespace illum {

struct SceneFileOptions {
  CaptureOverrides overrides;
  /// More than that is refused, with the cost in words. 1e14: months of a machine with two cores.
  double maxShadowRays = 1e14;
};

/// Whether `file` is to be read as a scene: a mesh file by its name, a scene file by its name
/// (.json) and its field "illumScene".
bool isSceneFile(const std::filesystem::path& file);

/// Reads a scene file (docs/guide/scenes.md) with everything that it names, or a mesh file, which
/// is moved about the origin, scaled to reach from -1 to 1 and given a slab of 5 x 5 view points
/// in front and 64 lights. Remarks name what is left out and what was repaired. Throws Error naming
/// the file. Untrusted input is safe as far as assimp and OpenImageIO are.
SceneCapture readScene(const std::filesystem::path& file, const SceneFileOptions& options,
                       Progress& progress);

}  // namespace illum
