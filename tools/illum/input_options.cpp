#include "input_options.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>

#include "commands.h"
#include "core/memory.h"
#include "illum/capture_folder.h"
#include "illum/error.h"

namespace illum::cli {

std::array<int, 2> gridFrom(const std::string& text) {
  std::array<int, 2> counts{};
  int end = 0;
  const int found = std::sscanf(text.c_str(), "%dx%d%n", &counts[0], &counts[1], &end);
  if (found != 2 || static_cast<std::size_t>(end) != text.size() || counts[0] < 1 ||
      counts[1] < 1) {
    throw Error(Fault::Usage,
                fmt::format("--uv: expected columns and rows such as 9x9, found \"{}\"", text));
  }
  return counts;
}

void SceneInput::addTo(CLI::App& command) {
  const std::string group = "Scenes";
  command.add_option("--uv", uv, "view points of each slab, such as 9x9")->group(group);
  command.add_option("--size", size, "longer side of a view in pixels")->group(group);
  command.add_option("--light-count", lights, "so many lights, evenly spread")->group(group);
  command.add_option("--light-radius", lightRadiusDegrees, "of the lights' discs, in degrees")
      ->group(group);
  command.add_option("--samples", samples, "paths for each pixel")->group(group);
  command.add_option("--bounces", bounces, "interreflections")->group(group);
  command.add_option("--seed", seed, "of the random numbers")->group(group);
}

SceneOptions SceneInput::options() const {
  constexpr double kRadiansPerDegree = 0.017453292519943295;
  const auto given = [](int value, int none) {
    return value == none ? std::nullopt : std::optional<int>(value);
  };
  SceneOptions options;
  if (!uv.empty()) {
    const auto counts = gridFrom(uv);
    options.uCount = counts[0];
    options.vCount = counts[1];
  }
  options.longerSide = given(size, 0);
  options.lights = given(lights, 0);
  options.samplesPerPixel = given(samples, 0);
  options.bounces = given(bounces, -1);
  if (lightRadiusDegrees != -1) {
    options.lightRadiusRadians = lightRadiusDegrees * kRadiansPerDegree;
  }
  if (seed >= 0) options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

const char* SceneInput::given() const {
  if (!uv.empty()) return "--uv";
  if (size != 0) return "--size";
  if (lights != 0) return "--light-count";
  if (lightRadiusDegrees != -1) return "--light-radius";
  if (samples != 0) return "--samples";
  if (bounces != -1) return "--bounces";
  return seed >= 0 ? "--seed" : nullptr;
}

void InputOptions::addTo(CLI::App& command) {
  const std::string group = "Photographs";
  command.add_option("--light-file", lightFile, "light file, if not the one in the folder")
      ->group(group);
  command.add_option("--mask", mask, "picture that is white where the object is")->group(group);
  command.add_option("--crop", crop, "x,y,width,height in upright pixels")
      ->delimiter(',')
      ->expected(4)
      ->group(group);
  command.add_option("--shrink", shrink, "scale down by this whole factor")->group(group);
  command.add_option("--transfer", transfer, "what pixel values are: linear or srgb")->group(group);
  scene.addTo(command);
}

PhotographOptions InputOptions::photographOptions() const {
  PhotographOptions options;
  options.lightFile = lightFile;
  options.mask = mask;
  options.shrink = shrink;
  if (shrink < 1) {
    throw Error(Fault::Usage, fmt::format("--shrink: expected at least 1, found {}", shrink));
  }
  if (!crop.empty()) {
    options.crop = Rectangle{crop[0], crop[1], crop[2], crop[3]};
    if (crop[0] < 0 || crop[1] < 0 || crop[2] < 1 || crop[3] < 1) {
      throw Error(Fault::Usage, "--crop: expected x,y >= 0 and width,height >= 1");
    }
  }
  if (transfer == "linear") options.transfer = Transfer::Linear;
  if (transfer == "srgb") options.transfer = Transfer::Display;
  if (!transfer.empty() && !options.transfer) {
    throw Error(Fault::Usage,
                fmt::format("--transfer: expected linear or srgb, found \"{}\"", transfer));
  }
  return options;
}

std::unique_ptr<Capture> InputOptions::open(std::uint64_t memoryBytes,
                                            const std::filesystem::path& scratch,
                                            Progress& progress) const {
  if (isSceneName(input)) return openScene(input, scene.options(), progress);
  if (const char* option = scene.given()) {
    throw Error(Fault::Usage, fmt::format("{}: expected a scene to be rendered, found pictures, {}",
                                          option, input));
  }
  PhotographOptions options = photographOptions();
  options.memoryBytes = memoryBytes;
  options.scratch = scratch;
  return isCaptureFolder(input) ? openCaptureFolder(input, options, progress)
                                : openPhotographs(input, options, progress);
}

int listScenes() {
  for (const SceneName& scene : builtinSceneNames()) {
    fmt::print("builtin:{:<10} {}\n", scene.name, scene.sentence);
  }
  return kDone;
}

void MachineOptions::addTo(CLI::App& command) {
  const std::string group = "Machine";
  command
      .add_option("--max-memory", maxMemory,
                  "most memory to use, such as 2G (default: a quarter of the machine's)")
      ->group(group);
  command.add_option("--threads", threads, "threads (default: all)")->group(group);
}

std::uint64_t MachineOptions::memoryBytes() const {
  return maxMemory.empty() ? machineMemoryBytes() / 4 : bytesFromText(maxMemory);
}

struct ThreadLimit::State {
  explicit State(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads < 0) {
    throw Error(Fault::Usage, fmt::format("--threads: expected at least 1, found {}", threads));
  }
  if (threads > 0) state_ = std::make_unique<State>(threads);
}
ThreadLimit::~ThreadLimit() = default;

}  // namespace illum::cli
