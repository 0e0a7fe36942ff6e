// Views and lights that nobody sampled against ray-traced truth: one slab's uv extent sampled by
// 5x5, 9x9 and 17x17 view points, one path of cameras between them, plain and depth-corrected
// interpolation (docs/quality.md, "Views that were not sampled").
//
//   illum_view_truth [SCENE [PIXELS [LIGHTS [FOLDER]]]]      FOLDER: for pictures to look at
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include "held_out.h"
#include "illum/build.h"
#include "illum/error.h"
#include "illum/lumigraph.h"
#include "illum/relight.h"
#include "render/rendered_capture.h"
#include "scene/builtin.h"
#include "scene/light_grid.h"

namespace {

using namespace illum;
using bench::Score;
namespace fs = std::filesystem;

constexpr std::array kGrids{5, 9, 17};
constexpr int kFinest = kGrids.back();
constexpr int kCameras = 4;
constexpr int kExactSamples = 8, kObjectSamples = 4, kTruthSamples = 32;  // a pixel
constexpr std::size_t kLightsOfTheViewStudy = 1;

struct Arguments {
  std::string scene = "teapot";
  int pixels = 128, lights = 32;
  fs::path folder;
};

struct Totals {
  Score plain, corrected;
  double leastCoverage = 1;
};

SynthesisOptions plain() {
  SynthesisOptions options;
  options.useDepth = false;
  return options;
}

const std::vector<DirectionalLight>& novelLights() {
  static const std::vector<DirectionalLight> lights = [] {
    std::vector<DirectionalLight> made;
    for (const Vector3 v : {Vector3{0.45, 0.55, 0.7}, {-0.6, 0.35, 0.7}}) {
      made.push_back({Direction::fromVector(v)});
    }
    return made;
  }();
  return lights;
}

std::vector<LightFileEntry> named(const std::vector<DirectionalLight>& lights) {
  std::vector<Direction> directions;
  for (const DirectionalLight& light : lights) directions.push_back(light.toLight);
  return namedLights(directions);
}

/// The finest grid's views under all lights of a capture (three channels each, then coverage),
/// rendered when somebody asks for them.
class ExactViews {
 public:
  explicit ExactViews(std::unique_ptr<Capture> capture) : capture_(std::move(capture)) {}

  const std::vector<View>& views() const { return capture_->views(); }
  int channels() const { return 3 * lights() + 1; }
  const SourceView& at(int view) {
    const auto [at, isNew] = made_.try_emplace(view);
    if (isNew) at->second = make(view);
    return at->second;
  }

 private:
  int lights() const { return static_cast<int>(capture_->lights().size()); }
  SourceView make(int view) const {
    fmt::print(stderr, "view {}\n", capture_->views()[static_cast<std::size_t>(view)].name);
    SourceView made{capture_->views()[static_cast<std::size_t>(view)],
                    Picture(capture_->size(view), channels()), bench::depthOf(*capture_, view)};
    for (int l = 0; l < lights(); ++l) {
      const Picture lit = bench::pictureOf(*capture_, view, l);
      for (int y = 0; y < lit.height(); ++y) {
        for (int x = 0; x < lit.width(); ++x) {
          for (int c = 0; c < 3; ++c) made.picture.at(x, y, 3 * l + c) = lit.at(x, y, c);
          made.picture.at(x, y, channels() - 1) = lit.at(x, y, 3);
        }
      }
    }
    return made;
  }

  std::unique_ptr<Capture> capture_;
  std::map<int, SourceView> made_;
};

/// Those of the finest grid that a coarser one has too, as that one's views.
class Coarser final : public ViewSource {
 public:
  Coarser(ExactViews& finest, int count) : finest_(finest), count_(count) {
    const int step = (kFinest - 1) / (count - 1);
    for (int i = 0; i < static_cast<int>(finest.views().size()); ++i) {
      View view = finest.views()[static_cast<std::size_t>(i)];
      auto& at = std::get<SlabView>(view.geometry);
      if (at.u % step != 0 || at.v % step != 0) continue;
      at = {at.slab, at.u / step, at.v / step};
      at.slab.uCount = at.slab.vCount = count;
      views_.push_back(view);
      indices_.push_back(i);
    }
  }

  int count() const { return count_; }
  /// Which were looked at so far, ascending.
  std::vector<int> asked() const { return {asked_.begin(), asked_.end()}; }

  const std::vector<View>& views() const override { return views_; }
  int channels() const override { return finest_.channels(); }
  bool hasDepth() const override { return true; }
  std::shared_ptr<const Picture> picture(int view) override { return unowned(at(view).picture); }
  std::shared_ptr<const Picture> depth(int view) override { return unowned(at(view).depth); }

 private:
  const SourceView& at(int view) {
    asked_.insert(view);
    return finest_.at(indices_[static_cast<std::size_t>(view)]);
  }
  static std::shared_ptr<const Picture> unowned(const Picture& picture) {
    return {std::shared_ptr<const Picture>(), &picture};
  }

  ExactViews& finest_;
  int count_;
  std::vector<View> views_;
  std::vector<int> indices_;
  std::set<int> asked_;
};

class Study {
 public:
  explicit Study(const Arguments& arguments) : arguments_(arguments) {
    const SceneCapture finest = sceneOf(kFinest, kExactSamples);
    slab_ = std::get<SlabView>(finest.setup.views.front().geometry).slab;
    for (std::size_t i = 0; i < kLightsOfTheViewStudy; ++i) {
      captured_.push_back(finest.setup.lights[1 + 4 * i].light);
    }
    for (int i = 0; i < kCameras; ++i) cameras_.push_back({fmt::format("{}", i), camera(i)});
    fmt::print(stderr, "truth: {} cameras\n", kCameras);
    truth_ = truthOf(cameras_);
  }

  void run() {
    fmt::print("builtin:{}, {} x {} pixels, {} lights of radius {:.3f}\n\n", arguments_.scene,
               slab_.size.width, slab_.size.height, arguments_.lights,
               sceneOf(5, 1).setup.lightRadiusRadians);
    ExactViews finest(renderedUnder(captured_));
    fmt::print(
        "| view points | plain | by depth | gain | of the object seen |\n|---|---|---|---|---|\n");
    std::vector<std::vector<int>> asked;
    for (const int count : kGrids) {
      Coarser source(finest, count);
      print(count, viewsAlone(source), "");
      asked.push_back(source.asked());
    }
    fmt::print(
        "\n| view points | plain | by depth | gain | of the object seen | light alone |\n"
        "|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < kGrids.size() && arguments_.lights > 0; ++i) {
      const Object object = built(kGrids[i], asked[i]);
      print(kGrids[i], viewsAndLights(object, kGrids[i]),
            fmt::format(" {:.1f} |", lightsAlone(object)));
    }
  }

 private:
  SceneCapture sceneOf(int viewPoints, int samples) const {
    CaptureOverrides overrides;
    overrides.uCount = overrides.vCount = viewPoints;
    overrides.longerSide = arguments_.pixels;
    overrides.lights = arguments_.lights;
    overrides.samplesPerPixel = samples;
    SceneCapture scene = builtinScene(arguments_.scene, overrides);
    if (scene.setup.lightRadiusRadians == 0) {
      std::vector<Direction> directions;
      for (const LightFileEntry& entry : scene.setup.lights) {
        directions.push_back(entry.light.toLight);
      }
      scene.setup.lightRadiusRadians = 0.5 * spacingRadians(directions);
    }
    return scene;
  }

  /// Round and round within the grid of view points, a little before and behind the uv plane.
  PinholeCamera camera(int i) const {
    const double turn = 2 * std::numbers::pi * (i + 0.3) / kCameras;
    const double nearer = 1 + 0.12 * std::sin(2 * turn);
    Vector3 eye = slab_.viewPoint(0.5 + 0.31 * std::cos(turn), 0.5 + 0.29 * std::sin(turn));
    eye.z *= nearer;
    const Vector3 middle{0.5 * (slab_.st.left + slab_.st.right),
                         0.5 * (slab_.st.bottom + slab_.st.top), 0};
    PinholeCamera camera;
    camera.objectFromCamera = slab_.objectFromSlab * lookAt(eye, middle, {0, 1, 0});
    camera.size = slab_.size;
    camera.focalX = camera.focalY =
        slab_.distance * nearer * slab_.size.width / (slab_.st.right - slab_.st.left);
    camera.centre = {0.5 * slab_.size.width, 0.5 * slab_.size.height};
    return camera;
  }

  struct Truth {
    std::vector<std::vector<Picture>> captured, novel;  // [view][light]
  };
  Truth truthOf(const std::vector<View>& views) const {
    SceneCapture scene = sceneOf(kFinest, kTruthSamples);
    scene.setup.views = views;
    std::vector<DirectionalLight> lights = captured_;
    lights.insert(lights.end(), novelLights().begin(), novelLights().end());
    scene.setup.lights = named(lights);
    const auto capture = renderedCapture(scene);
    Truth truth;
    for (int v = 0; v < static_cast<int>(views.size()); ++v) {
      truth.captured.emplace_back();
      truth.novel.emplace_back();
      for (int l = 0; l < static_cast<int>(lights.size()); ++l) {
        auto& pictures = l < static_cast<int>(captured_.size()) ? truth.captured : truth.novel;
        pictures.back().push_back(bench::pictureOf(*capture, v, l));
      }
    }
    return truth;
  }

  static void print(int count, const Totals& totals, const std::string& more) {
    fmt::print("| {0} x {0} | {1:.1f} | {2:.1f} | {3:.1f} | {4:.1f} % |{5}\n", count,
               totals.plain.decibels(), totals.corrected.decibels(),
               totals.corrected.decibels() - totals.plain.decibels(), 100 * totals.leastCoverage,
               more);
    std::fflush(stdout);
  }

  std::unique_ptr<Capture> renderedUnder(const std::vector<DirectionalLight>& lights) const {
    SceneCapture scene = sceneOf(kFinest, kExactSamples);
    scene.setup.lights = named(lights);
    return renderedCapture(scene);
  }

  static Picture lightOf(const Picture& all, int light) {
    Picture one(all.size(), 4);
    for (int y = 0; y < all.height(); ++y) {
      for (int x = 0; x < all.width(); ++x) {
        for (int c = 0; c < 3; ++c) one.at(x, y, c) = all.at(x, y, 3 * light + c);
        one.at(x, y, 3) = all.at(x, y, all.channels() - 1);
      }
    }
    return one;
  }

  Totals viewsAlone(Coarser& source) const {
    const int count = source.count();
    Totals totals;
    for (std::size_t v = 0; v < cameras_.size(); ++v) {
      const ViewGeometry& camera = cameras_[v].geometry;
      const Picture byDepth = synthesise(source, camera).picture;
      const Picture uncorrected = synthesise(source, camera, plain()).picture;
      for (std::size_t l = 0; l < captured_.size(); ++l) {
        const Picture& truth = truth_.captured[v][l];
        const Picture found = lightOf(byDepth, static_cast<int>(l));
        const Picture foundPlain = lightOf(uncorrected, static_cast<int>(l));
        addTo(totals, foundPlain, found, truth);
        show(fmt::format("views_{}_{}_{}_{}.png", arguments_.scene, count, v, l),
             {foundPlain, found, truth});
      }
    }
    return totals;
  }

  /// Of those views that the path asks for, which is all that it can tell of.
  Object built(int count, const std::vector<int>& views) const {
    const fs::path file =
        fs::temp_directory_path() / fmt::format("view_truth_{}_{}.illum", arguments_.scene, count);
    BuildOptions options;
    options.force = true;
    Progress silent;
    fmt::print(stderr, "building {} of {} x {}\n", views.size(), count, count);
    SceneCapture scene = sceneOf(count, kObjectSamples);
    std::vector<View> chosen;
    for (const int view : views) {
      chosen.push_back(scene.setup.views[static_cast<std::size_t>(view)]);
    }
    scene.setup.views = std::move(chosen);
    buildObject(*renderedCapture(scene), file, options, silent);
    return Object::open(file);
  }

  Totals viewsAndLights(const Object& object, int count) const {
    Lumigraph lumigraph(object);
    Totals totals;
    for (std::size_t l = 0; l < novelLights().size(); ++l) {
      lumigraph.setLights(std::span(&novelLights()[l], 1));
      for (std::size_t v = 0; v < cameras_.size(); ++v) {
        const ViewGeometry& camera = cameras_[v].geometry;
        const Picture& truth = truth_.novel[v][l];
        const Picture found = lumigraph.see(camera).picture;
        const Picture foundPlain = lumigraph.see(camera, plain()).picture;
        addTo(totals, foundPlain, found, truth);
        show(fmt::format("object_{}_{}_{}_{}.png", arguments_.scene, count, v, l),
             {foundPlain, found, truth});
      }
    }
    return totals;
  }

  /// At sampled views, under lights that were not.
  double lightsAlone(const Object& object) const {
    const std::vector<int> groups{object.groups() / 3, 2 * object.groups() / 3};
    std::vector<View> views;
    for (const int group : groups) views.push_back(object.view(group));
    const Truth truth = truthOf(views);
    const Relighter relighter(object);
    Score score;
    for (std::size_t v = 0; v < views.size(); ++v) {
      for (std::size_t l = 0; l < novelLights().size(); ++l) {
        score.add(relighter.relight(std::span(&novelLights()[l], 1), groups[v]), truth.novel[v][l]);
      }
    }
    return score.decibels();
  }

  static void addTo(Totals& totals, const Picture& plain, const Picture& byDepth,
                    const Picture& truth) {
    totals.plain.add(plain, truth);
    totals.corrected.add(byDepth, truth);
    totals.leastCoverage = std::min(totals.leastCoverage, bench::coverageShare(byDepth, truth));
  }
  void show(const std::string& name, const std::vector<Picture>& pictures) const {
    if (!arguments_.folder.empty()) bench::writeSheet(arguments_.folder / name, pictures);
  }

  Arguments arguments_;
  LightSlab slab_;
  std::vector<DirectionalLight> captured_;
  std::vector<View> cameras_;
  Truth truth_;
};

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (argc > 1) arguments.scene = argv[1];
  if (argc > 2) arguments.pixels = std::atoi(argv[2]);
  if (argc > 3) arguments.lights = std::atoi(argv[3]);
  if (argc > 4) arguments.folder = argv[4];
  try {
    if (!arguments.folder.empty()) fs::create_directories(arguments.folder);
    Study(arguments).run();
  } catch (const Error& error) {
    fmt::print(stderr, "illum_view_truth: {}\n", error.what());
    return 1;
  }
  return 0;
}
