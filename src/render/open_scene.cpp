#include <algorithm>

#include "illum/scene.h"
#include "render/rendered_capture.h"
#include "scene/builtin.h"
#include "scene/scene_file.h"

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
  return scene.native().starts_with(kBuiltin) || isSceneFile(scene);
}

std::unique_ptr<Capture> openScene(const std::filesystem::path& scene, const SceneOptions& options,
                                   Progress& progress) {
  const std::string& name = scene.native();
  if (name.starts_with(kBuiltin)) {
    return renderedCapture(builtinScene(name.substr(kBuiltin.size()), overridesOf(options)));
  }
  SceneFileOptions fileOptions;
  fileOptions.overrides = overridesOf(options);
  return renderedCapture(readScene(scene, fileOptions, progress));
}

}  // namespace illum
