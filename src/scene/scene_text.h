// The text of a scene file. docs/guide/scenes.md is its manual, docs/scene.schema.json its schema.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/capture_plan.h"
#include "scene/scene_description.h"

namespace illum {

inline constexpr std::uint64_t kMaxSceneTextBytes = std::uint64_t{16} << 20;

/// Reads the text of a scene file; opens none. Checks all that can be checked without the files
/// that it names, names of materials included. Untrusted input is safe. Throws Error naming
/// `source` and the field.
SceneDescription sceneFromText(std::string_view json, const std::string& source);

/// The views and all about the capture but the lights of a light file, which stay a grid. Throws
/// Error naming the field.
CapturePlan planOf(const SceneDescription& description);

/// docs/scene.schema.json, from the same description as the reader.
std::string sceneSchema();

}  // namespace illum
