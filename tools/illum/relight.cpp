#include "illum/relight.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "commands.h"
#include "illum/error.h"
#include "illum/light_file.h"
#include "illum/picture_io.h"
#include "input_options.h"
#include "terminal_progress.h"

namespace illum::cli {
namespace {

namespace fs = std::filesystem;

// "x,y,z" or "x,y,z,r,g,b"
DirectionalLight lightFromText(const std::string& text) {
  std::vector<double> numbers;
  for (const auto& part : CLI::detail::split(text, ',')) {
    double number = 0;
    const bool fine = CLI::detail::lexical_cast(part, number) && std::isfinite(number);
    if (!fine) {
      numbers.clear();
      break;
    }
    numbers.push_back(number);
  }
  if (numbers.size() != 3 && numbers.size() != 6) {
    throw Error(Fault::Usage,
                fmt::format("--light: expected x,y,z or x,y,z,r,g,b, found \"{}\"", text));
  }
  DirectionalLight light;
  try {
    light.toLight = Direction::fromVector({numbers[0], numbers[1], numbers[2]});
  } catch (const Error&) {
    throw Error(Fault::Usage, fmt::format("--light: expected a direction, found \"{}\"", text));
  }
  if (numbers.size() == 6) {
    light.intensity = {static_cast<float>(numbers[3]), static_cast<float>(numbers[4]),
                       static_cast<float>(numbers[5])};
  }
  return light;
}

struct RelightCommand {
  MachineOptions machine;
  std::string object, output, lightFile, format = "png";
  std::vector<std::string> lights;
  double exposureStops = 0;
  int level = 0;
  bool force = false;

  void addTo(CLI::App& command) {
    command.add_option("OBJECT", object, ".illum file or folder")->required();
    command.add_option("-o,--output", output, "picture, or folder with --lights")->required();
    auto* one =
        command.add_option("--light", lights, "x,y,z[,r,g,b] toward the light; repeat for several")
            ->expected(1)
            ->take_all();
    command.add_option("--lights", lightFile, "light file: a picture for each of its lines")
        ->excludes(one);
    command.add_option("--exposure", exposureStops, "in stops");
    command.add_option("--level", level, "0 is full size, each further one half");
    command.add_option("--format", format, "png (default), jpg or exr, with --lights");
    command.add_flag("--force", force, "write into a folder that is not empty");
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

  int run() const {
    if (lights.empty() && lightFile.empty()) {
      throw Error(Fault::Usage, "relight: expected --light or --lights, found neither");
    }
    const ThreadLimit limit(machine.threads);
    std::vector<DirectionalLight> directional;
    for (const auto& text : lights) directional.push_back(lightFromText(text));
    if (lightFile.empty()) pictureFormat(output);
    const Relighter relighter(Object::open(object), machine.memoryBytes() / 2);
    if (lightFile.empty()) {
      writePicture(output, relighter.relight(directional, 0, level), exposureStops);
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
