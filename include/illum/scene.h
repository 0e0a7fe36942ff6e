// Three-dimensional scenes as a source of samples: rendered when they are read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "illum/capture.h"
#include "illum/progress.h"

namespace illum {

/// What is asked for in place of what a scene says about its capture.
struct SceneOptions {
  std::optional<int> uCount, vCount;  ///< view points of slabs
  std::optional<int> longerSide;      ///< of every view, in pixels
  std::optional<int> lights;          ///< so many, evenly spread
  std::optional<int> samplesPerPixel, bounces;
  std::optional<double> lightRadiusRadians;
  std::optional<std::uint64_t> seed;
};

struct SceneName {
  std::string name;      ///< as in "builtin:NAME"
  std::string sentence;  ///< what it shows
};
/// The scenes that need no file.
std::vector<SceneName> builtinSceneNames();

/// Whether openScene is meant: "builtin:NAME", or a file whose ending is that of a scene or a mesh.
bool isSceneName(const std::filesystem::path& scene);

/// Opens "builtin:NAME", a scene file or a mesh file. Samples are rendered when they are read, in
/// the thread that reads; the same samples every time, whatever else is read. Throws Error.
std::unique_ptr<Capture> openScene(const std::filesystem::path& scene, const SceneOptions& options,
                                   Progress& progress);

}  // namespace illum
