#include "illum/relight.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <vector>

#include "commands.h"
#include "core/memory.h"
#include "illum/error.h"
#include "illum/light_file.h"
#include "illum/lumigraph.h"
#include "illum/normals.h"
#include "illum/picture_io.h"
#include "input_options.h"
#include "light_options.h"
#include "picture_folder.h"
#include "terminal_progress.h"
#include "view_options.h"

namespace illum::cli {
namespace {

namespace fs = std::filesystem;

/// What stands still while lights change: a view that is stored, or a camera that looks at all.
class Sight {
 public:
  virtual ~Sight() = default;
  virtual Picture under(const Illumination& lights) = 0;
};

class StoredView final : public Sight {
 public:
  StoredView(const Object& object, std::uint64_t memoryBytes, int group, int level,
             PrepareOptions options)
      : relighter_(object, memoryBytes),
        group_(group),
        level_(level),
        options_(std::move(options)) {}
  Picture under(const Illumination& lights) override {
    const PreparedLights prepared = relighter_.prepare(lights, group_, options_);
    if (prepared.environmentError() > options_.environmentError) {
      TerminalProgress().remark(fmt::format(
          "the environment's {} directions leave an error of {:.1f} % of the picture's brightness; "
          "{:.1f} % was aimed at",
          prepared.passes(), 100 * prepared.environmentError(), 100 * options_.environmentError));
    }
    return relighter_.relight(prepared, level_);
  }

 private:
  Relighter relighter_;
  int group_, level_;
  PrepareOptions options_;
};

class SynthesisedSight final : public Sight {
 public:
  SynthesisedSight(const Object& object, std::uint64_t memoryBytes, ViewGeometry camera,
                   const SynthesisOptions& options)
      : lumigraph_(object, memoryBytes), camera_(std::move(camera)), options_(options) {}
  Picture under(const Illumination& lights) override {
    lumigraph_.setLights(lights);
    return lumigraph_.see(camera_, options_).picture;
  }

 private:
  Lumigraph lumigraph_;
  ViewGeometry camera_;
  SynthesisOptions options_;
};

// What synthesis holds for each pixel of its picture, besides the views.
constexpr std::uint64_t kSynthesisBytes = 128;

void checkRoom(Size size, std::uint64_t memoryBytes) {
  if (size.pixels() <= memoryBytes / (2 * kSynthesisBytes)) return;
  throw Error(
      Fault::Usage,
      fmt::format("expected a picture for which --max-memory has room, found {}x{} pixels, "
                  "which take {}",
                  size.width, size.height, textFromBytes(4 * kSynthesisBytes * size.pixels())));
}

bool showsNothing(const Picture& rgba) {
  for (std::size_t i = 3; i < rgba.samples().size(); i += 4) {
    if (rgba.samples()[i] > 0) return false;
  }
  return true;
}

struct RelightCommand {
  MachineOptions machine;
  LightOptions lights;
  ViewOptions views;
  std::string object, output, lightFile, heights, format = "png";
  double exposureStops = 0;
  int level = 0;
  bool force = false;

  void addTo(CLI::App& command) {
    command.add_option("OBJECT", object, ".illum file or folder")->required();
    command.add_option("-o,--output", output, "picture, or folder with --lights or --path")
        ->required();
    command.add_option("--lights", lightFile, "light file: a picture for each of its lines");
    command.add_option("--height", heights,
                       "for lights near a photograph: a picture of z, in units of the object, or "
                       "auto: integrated from the object's own normals");
    command.add_option("--exposure", exposureStops, "in stops");
    command.add_option("--level", level, "0 is full size, each further one half");
    command.add_option("--format", format, "png (default), jpg or exr, with --lights or --path");
    command.add_flag("--force", force, "write into a folder that is not empty");
    views.addTo(command);
    lights.addTo(command);
    machine.addTo(command);
  }

  PictureFolder folder() const { return {output, format, force, exposureStops}; }

  // A picture for each line of the light file.
  void relightEach(Sight& sight) const {
    const LightFile file = readLightFile(lightFile);
    std::set<std::string> stems;
    for (const auto& entry : file.entries) {
      const std::string stem = fs::path(entry.name).stem().string();
      if (!stems.insert(stem).second) {
        throw inputError(lightFile, "a different stem in every name",
                         fmt::format("\"{}\" twice", stem));
      }
    }
    const PictureFolder pictures = folder();
    TerminalProgress progress;
    for (const auto& remark : file.remarks) progress.remark(remark);
    progress.begin("relighting", file.entries.size());
    for (const auto& entry : file.entries) {
      pictures.write(fs::path(entry.name).stem().string(), sight.under({{entry.light}, {}, {}}));
      progress.advance();
    }
    progress.end();
  }

  // A picture for each camera of the path.
  void followPath(const Object& opened, const Illumination& illumination) const {
    const std::vector<ViewGeometry> way = views.pathGeometries(opened, lights.upward());
    const std::uint64_t memoryBytes = machine.memoryBytes() / 2;
    std::uint64_t pixels = 0;
    for (const ViewGeometry& camera : way) {
      checkRoom(sizeOf(camera), memoryBytes);
      pixels = std::max(pixels, sizeOf(camera).pixels());
    }
    const SynthesisOptions synthesis = views.synthesis(opened, {std::nullopt, way.front(), {}});
    Lumigraph lumigraph(opened, memoryBytes - kSynthesisBytes * pixels);
    lumigraph.setLights(illumination);
    const PictureFolder pictures = folder();
    TerminalProgress progress;
    progress.begin("relighting", way.size());
    std::vector<std::size_t> empty;
    for (std::size_t k = 0; k < way.size(); ++k) {
      const Picture picture = lumigraph.see(way[k], synthesis).picture;
      pictures.write(fmt::format("frame_{:05}", k), picture);
      if (showsNothing(picture)) empty.push_back(k);
      progress.advance();
    }
    progress.end();
    if (!empty.empty()) {
      progress.remark(
          fmt::format("{} of {} pictures show nothing, frame_{:05} the first of them: no "
                      "view looked there",
                      empty.size(), way.size(), empty.front()));
    }
  }

  PrepareOptions prepareOptions(const Object& opened, int group, std::uint64_t memoryBytes) const {
    PrepareOptions options;
    if (heights == "auto") {
      options.heights = std::make_shared<const Picture>(
          photographHeights(opened, group, {NormalOptions::Method::Robust, memoryBytes}));
    } else if (!heights.empty()) {
      options.heights = std::make_shared<const Picture>(readPicture(heights));
    }
    return options;
  }

  bool isPath() const { return !views.path.empty(); }

  void checkUsage() const {
    if (lights.empty() == lightFile.empty()) {
      throw Error(Fault::Usage,
                  fmt::format("relight: expected either lights (--light, --point, --spot, --env, "
                              "--sky, --lighting) or --lights, found {}",
                              lights.empty() ? "neither" : "both"));
    }
    if (!isPath()) return;
    if (!lightFile.empty())
      throw Error(Fault::Usage, "relight: expected either --path or --lights, found both");
    if (level != 0 || !heights.empty()) {
      throw Error(Fault::Usage, fmt::format("relight: expected either --path or {}, found both",
                                            level != 0 ? "--level" : "--height"));
    }
  }

  std::unique_ptr<Sight> sightOf(const Object& opened) const {
    const std::uint64_t memoryBytes = machine.memoryBytes() / 2;
    const ViewChoice choice = views.choice(opened, lights.upward());
    const SynthesisOptions synthesis = views.synthesis(opened, choice);
    if (choice.group) {
      return std::make_unique<StoredView>(opened, memoryBytes, *choice.group, level,
                                          prepareOptions(opened, *choice.group, memoryBytes));
    }
    if (level != 0 || !heights.empty()) {
      throw Error(Fault::Usage,
                  fmt::format("{}: expected a view that the object has, found one between them",
                              level != 0 ? "--level" : "--height"));
    }
    checkRoom(sizeOf(choice.geometry), memoryBytes);
    return std::make_unique<SynthesisedSight>(
        opened, memoryBytes - kSynthesisBytes * sizeOf(choice.geometry).pixels(), choice.geometry,
        synthesis);
  }

  int run() const {
    checkUsage();
    const ThreadLimit limit(machine.threads);
    const Lighting lighting = lights.lighting();
    const bool single = lightFile.empty() && !isPath();
    if (single) pictureFormat(output);
    const Object opened = Object::open(object);
    if (isPath()) {
      followPath(opened, illuminationOf(lighting));
    } else if (single) {
      writePicture(output, sightOf(opened)->under(illuminationOf(lighting)), exposureStops);
    } else {
      relightEach(*sightOf(opened));
    }
    return kDone;
  }
};

}  // namespace

void addRelight(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("relight", "make pictures under new lights");
  const auto state = std::make_shared<RelightCommand>();
  state->addTo(*command);
  command->callback([state, &exitCode] { exitCode = state->run(); });
}

}  // namespace illum::cli
