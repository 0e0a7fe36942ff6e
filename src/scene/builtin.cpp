#include "scene/builtin.h"

#include <fmt/format.h>

#include <array>

#include "illum/error.h"
#include "scene/builtin_parts.h"

namespace illum {
namespace {

struct Listed {
  BuiltinScene about;
  PlannedScene (*make)();
};

constexpr std::array kListed{
    Listed{{"box", "a box that casts its shadow on a plane"}, boxOnPlane},
    Listed{{"teapot", "the Utah teapot, glazed"}, utahTeapot},
    Listed{{"bust", "a marble head and shoulders"}, sculptedBust},
    Listed{{"cornell", "the Cornell box, open to the viewer: colours that walls give each other"},
           cornellBox},
    Listed{{"bear", "a bear with a fur of thousands of hairs"}, furryBear},
    Listed{{"coin", "a worn silver coin, photographed from one place"}, wornCoin},
};

constexpr auto kScenes = [] {
  std::array<BuiltinScene, kListed.size()> scenes{};
  for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i] = kListed[i].about;
  return scenes;
}();

}  // namespace

std::span<const BuiltinScene> builtinScenes() {
  return kScenes;
}

SceneCapture builtinScene(std::string_view name, const CaptureOverrides& overrides) {
  std::string known;
  for (const Listed& listed : kListed) {
    if (listed.about.name == name) {
      PlannedScene planned = listed.make();
      apply(overrides, planned.plan);
      CaptureSetup setup = captureSetup(planned.plan, planned.scene);
      return {std::move(planned.scene), std::move(setup)};
    }
    known += fmt::format("{}builtin:{}", known.empty() ? "" : ", ", listed.about.name);
  }
  throw Error(Fault::Usage, fmt::format("builtin:{}: expected one of {}", name, known));
}

}  // namespace illum
