#include "illum/relight.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>

#include "commands.h"
#include "illum/error.h"
#include "illum/light_file.h"
#include "illum/picture_io.h"
#include "input_options.h"
#include "light_options.h"
#include "terminal_progress.h"

namespace illum::cli {
namespace {

namespace fs = std::filesystem;

struct RelightCommand {
  MachineOptions machine;
  LightOptions lights;
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
    lights.addTo(command);
    machine.addTo(command);
  }

  void relightEach(const Relighter& relighter) const {
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
      const auto picture = relighter.relight(std::span(&entry.light, 1), 0, level);
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
    const Relighter relighter(Object::open(object), machine.memoryBytes() / 2);
    if (lightFile.empty()) {
      const auto prepared = relighter.prepare(illuminationOf(lighting), 0, prepareOptions());
      writePicture(output, relighter.relight(prepared, level), exposureStops);
    } else {
      relightEach(relighter);
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
