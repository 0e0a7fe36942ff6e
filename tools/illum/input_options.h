// What several subcommands take alike: what to read samples from, and the machine's limits.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "illum/capture.h"
#include "illum/scene.h"

namespace illum::cli {

/// The word for INPUT in help texts.
inline constexpr const char* kInputs =
    "folder of photographs with a light file, folder with a capture.json, scene or mesh file, or "
    "builtin:NAME";

/// --uv: "9x9" as columns and rows of view points. Throws Error (Fault::Usage).
std::array<int, 2> gridFrom(const std::string& text);

/// The options that say how scenes are captured, where not as they say themselves.
struct SceneInput {
  std::string uv;
  int size = 0, lights = 0, samples = 0, bounces = -1;
  double lightRadiusDegrees = -1;
  std::int64_t seed = -1;

  void addTo(CLI::App& command);
  SceneOptions options() const;
  /// The name of an option that was given; null if none was.
  const char* given() const;
};

/// The options that say what samples are read from, and how.
struct InputOptions {
  std::string input, lightFile, mask, transfer;
  std::vector<int> crop;
  int shrink = 1;
  SceneInput scene;

  void addTo(CLI::App& command);
  /// Opens the capture, whatever kind of input it is. `memoryBytes`: what it may hold. `scratch`:
  /// where a scratch file may lie.
  std::unique_ptr<Capture> open(std::uint64_t memoryBytes, const std::filesystem::path& scratch,
                                Progress& progress) const;

 private:
  PhotographOptions photographOptions() const;
};

/// Prints the built-in scenes, a line each. Returns the exit code.
int listScenes();

/// --max-memory and --threads.
struct MachineOptions {
  std::string maxMemory;
  int threads = 0;

  void addTo(CLI::App& command);
  std::uint64_t memoryBytes() const;  ///< default: a quarter of the machine
};

/// Holds the number of threads while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum::cli
