#include "render/rendered_capture.h"

#include <utility>

#include "illum/error.h"
#include "render/renderer.h"

namespace illum {
namespace {

RenderSettings settingsOf(const CaptureSetup& setup) {
  return {setup.lightRadiusRadians, setup.samplesPerPixel, setup.bounces, setup.filterRadius,
          setup.seed};
}

class RenderedCapture final : public Capture {
 public:
  explicit RenderedCapture(const SceneCapture& scene)
      : renderer_(scene.scene, settingsOf(scene.setup)),
        views_(scene.setup.views),
        lights_(scene.setup.lights),
        fingerprint_(sceneFingerprint(scene)) {}

  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return Transfer::Linear; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return true; }
  bool hasDepth() const override { return true; }
  bool isRendered() const override { return true; }

  void read(int group, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override {
    std::vector<RenderLight> asked;
    asked.reserve(lights.size());
    for (const int l : lights) {
      asked.push_back({lights_.at(static_cast<std::size_t>(l)).light.toLight, l});
    }
    renderer_.render(view(group), rectangle, asked, samples);
  }
  void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const override {
    renderer_.trace(view(group), rectangle, coverage, {});
  }
  void readDepth(int group, const Rectangle& rectangle, std::span<float> depth) const override {
    renderer_.trace(view(group), rectangle, {}, depth);
  }

  int bandRows() const override {
    int rows = 1;
    for (const View& view : views_) rows = std::max(rows, sizeOf(view.geometry).height);
    return rows;
  }
  std::uint64_t residentBytes() const override { return renderer_.residentBytes(); }
  std::string fingerprint() const override { return fingerprint_; }

 private:
  const View& view(int group) const { return views_.at(static_cast<std::size_t>(group)); }

  Renderer renderer_;
  std::vector<View> views_;
  std::vector<LightFileEntry> lights_;
  std::string fingerprint_;
};

}  // namespace

std::unique_ptr<Capture> renderedCapture(const SceneCapture& scene) {
  if (scene.setup.views.empty()) throw Error(Fault::Input, "the scene has no views");
  if (scene.setup.lights.empty()) throw Error(Fault::Input, "the scene has no lights");
  return std::make_unique<RenderedCapture>(scene);
}

}  // namespace illum
