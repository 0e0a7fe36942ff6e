// Scenes that need no file.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/capture_plan.h"
#include "scene/scene.h"

namespace illum {

struct BuiltinScene {
  std::string_view name;      ///< as in "builtin:NAME"
  std::string_view sentence;  ///< what it shows, for a list
};

/// In the order in which they are listed.
std::span<const BuiltinScene> builtinScenes();

/// The scene of that name with the capture that suits it, changed by `overrides`. The same every
/// time. Throws Error (Fault::Usage) for a name that is not in the list, naming those that are.
SceneCapture builtinScene(std::string_view name, const CaptureOverrides& overrides = {});

}  // namespace illum
