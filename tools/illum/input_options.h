// What several subcommands take alike: the photographs and the machine's limits.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "illum/capture.h"

namespace illum::cli {

/// The options that say how photographs are read.
struct InputOptions {
  std::string input, lightFile, mask, transfer;
  std::vector<int> crop;
  int shrink = 1;

  void addTo(CLI::App& command);
  /// Opens the capture. `memoryBytes`: what it may hold. `scratch`: where a scratch file may lie.
  std::unique_ptr<Capture> open(std::uint64_t memoryBytes, const std::filesystem::path& scratch,
                                Progress& progress) const;
};

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
