#include <algorithm>

#include "illum/scene.h"
#include "render/rendered_capture.h"
#include "scene/builtin.h"

namespace illum {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

CaptureOverrides overridesOf(const SceneOptions& options) {
  CaptureOverrides overrides;
  overrides.uCount = options.uCount;
  overrides.vCount = options.vCount;
  overrides.longerSide = options.longerSide;
  overrides.lights = options.lights;
  overrides.samplesPerPixel = options.samplesPerPixel;
  overrides.bounces = options.bounces;
  overrides.lightRadiusRadians = options.lightRadiusRadians;
  overrides.seed = options.seed;
  return overrides;
}

}  // namespace

std::vector<SceneName> builtinSceneNames() {
  std::vector<SceneName> names;
  for (const BuiltinScene& scene : builtinScenes()) {
    names.push_back({std::string(scene.name), std::string(scene.sentence)});
  }
  return names;
}

bool isSceneName(const std::filesystem::path& scene) {
  return scene.native().starts_with(kBuiltin);
}

std::unique_ptr<Capture> openScene(const std::filesystem::path& scene, const SceneOptions& options,
                                   [[maybe_unused]] Progress& progress) {
  const std::string name = scene.native();
  return renderedCapture(builtinScene(name.substr(kBuiltin.size()), overridesOf(options)));
}

}  // namespace illum
