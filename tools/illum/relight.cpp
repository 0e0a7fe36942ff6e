#include "illum/relight.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>

#include "commands.h"
#include "core/memory.h"
#include "illum/error.h"
#include "illum/light_file.h"
#include "illum/lumigraph.h"
#include "illum/picture_io.h"
#include "input_options.h"
#include "light_options.h"
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
    return relighter_.relight(relighter_.prepare(lights, group_, options_), level_);
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
    command.add_option("-o,--output", output, "picture, or folder with --lights")->required();
    command.add_option("--lights", lightFile, "light file: a picture for each of its lines");
    command.add_option("--height", heights,
                       "picture of z, in units of the object, for lights near a photograph");
    command.add_option("--exposure", exposureStops, "in stops");
    command.add_option("--level", level, "0 is full size, each further one half");
    command.add_option("--format", format, "png (default), jpg or exr, with --lights");
    command.add_flag("--force", force, "write into a folder that is not empty");
    views.addTo(command);
    lights.addTo(command);
    machine.addTo(command);
  }

  void relightEach(Sight& sight) const {
    if (format != "png" && format != "jpg" && format != "exr") {
      throw Error(Fault::Usage,
                  fmt::format("--format: expected png, jpg or exr, found \"{}\"", format));
    }
    const LightFile file = readLightFile(lightFile);
    const fs::path folder = output;
    std::set<std::string> stems;
    for (const auto& entry : file.entries) {
      const std::string stem = fs::path(entry.name).stem().string();
      if (!stems.insert(stem).second) {
        throw inputError(lightFile, "a different stem in every name",
                         fmt::format("\"{}\" twice", stem));
      }
    }
    if (fs::exists(folder) && (!fs::is_directory(folder) || (!force && !fs::is_empty(folder)))) {
      throw Error(Fault::Input, fmt::format("{}: exists already; --force writes into it", output));
    }
    fs::create_directories(folder);
    TerminalProgress progress;
    for (const auto& remark : file.remarks) progress.remark(remark);
    progress.begin("relighting", file.entries.size());
    for (const auto& entry : file.entries) {
      const Picture picture = sight.under({{entry.light}, {}, {}});
      const std::string stem = fs::path(entry.name).stem().string();
      writePicture(folder / fmt::format("{}.{}", stem, format), picture, exposureStops);
      progress.advance();
    }
    progress.end();
  }

  PrepareOptions prepareOptions() const {
    PrepareOptions options;
    if (!heights.empty()) options.heights = std::make_shared<const Picture>(readPicture(heights));
    return options;
  }

  std::unique_ptr<Sight> sightOf(const Object& opened) const {
    const std::uint64_t memoryBytes = machine.memoryBytes() / 2;
    const ViewChoice choice = views.choice(opened, lights.upward());
    const SynthesisOptions synthesis = views.synthesis(opened, choice);
    if (choice.group) {
      return std::make_unique<StoredView>(opened, memoryBytes, *choice.group, level,
                                          prepareOptions());
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
    if (lights.empty() == lightFile.empty()) {
      throw Error(Fault::Usage,
                  fmt::format("relight: expected either lights (--light, --point, --spot, --env, "
                              "--sky, --lighting) or --lights, found {}",
                              lights.empty() ? "neither" : "both"));
    }
    const ThreadLimit limit(machine.threads);
    const Lighting lighting = lights.lighting();
    if (lightFile.empty()) pictureFormat(output);
    const auto sight = sightOf(Object::open(object));
    if (lightFile.empty()) {
      writePicture(output, sight->under(illuminationOf(lighting)), exposureStops);
    } else {
      relightEach(*sight);
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
