#include "illum/build.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/memory.h"
#include "illum/capture_folder.h"
#include "illum/error.h"
#include "input_options.h"
#include "orderly_stop.h"
#include "terminal_progress.h"

namespace illum::cli {
namespace {

struct BuildCommand {
  InputOptions input;
  MachineOptions machine;
  BuildOptions build;
  std::string output, curve, response;
  int bits = 0, tile = 0;
  double regularizer = 0;
  bool json = false, weights = false, extension = false, sweepDepth = false;

  void addTo(CLI::App& command) {
    command.add_option("INPUT", input.input, kInputs)->required();
    command.add_option("-o,--output", output, "object to write: NAME.illum, or FOLDER/");
    addBasisOptions(command);
    addCodingOptions(command);
    input.addTo(command);
    machine.addTo(command);
    command.add_option("--holdout", build.holdout, "leave every K-th light out of the fit");
    command.add_flag("--sweep-depth", sweepDepth,
                     "find depth by comparing photographs from several places");
    command.add_flag("--resume", build.resume, "go on with a build that was interrupted");
    command.add_flag("--force", build.force, "replace an existing object");
    command.add_flag("--json", json, "print what was built as JSON");
  }

  void addBasisOptions(CLI::App& command) {
    const std::string group = "Light basis";
    command.add_option("--basis", build.basis, "learned (default), sh, hsh, dct or exact")
        ->group(group);
    auto* coefficients =
        command.add_option("--coefficients", build.coefficients, "per channel (sh, hsh, dct)")
            ->group(group);
    command.add_option("--planes", build.planes, "scalar planes in all")
        ->group(group)
        ->excludes(coefficients);
    command.add_option("--regularizer", regularizer, "strength (default: by leave-one-out)")
        ->group(group);
    command
        .add_flag("--weights,!--no-weights", weights,
                  "weight lights by solid angle (default: by leave-one-out)")
        ->group(group);
    command
        .add_flag("--extension,!--no-extension", extension,
                  "extend samples below the horizon (default: by leave-one-out)")
        ->group(group);
    command.add_flag("--projection", build.projection, "integrate instead of least squares")
        ->group(group);
    command.add_option("--response", response, "fit in linear or display values")->group(group);
  }

  void addCodingOptions(CLI::App& command) {
    const std::string group = "Coding";
    command
        .add_option("--coding", build.coding,
                    "avif (default), jpeg or png (lossless; default with exact)")
        ->group(group);
    command.add_option("--quality", build.quality, "0 to 100")->group(group);
    command.add_option("--bits", bits, "8, 10, 12 or 16 (default: chosen)")->group(group);
    command.add_option("--curve", curve, "linear or signedSqrt (default: chosen)")->group(group);
    command.add_option("--speed", build.speed, "of the AVIF coder, 0 (smallest) to 10")
        ->group(group);
    command.add_option("--tile", tile, "side of a tile in pixels")->group(group);
  }

  void finishOptions(const CLI::App& command) {
    if (command.count("--bits") > 0) build.bits = bits;
    if (command.count("--tile") > 0) build.tile = tile;
    if (command.count("--regularizer") > 0) build.regularizer = regularizer;
    if (command.count("--weights") > 0) build.solidAngleWeights = weights;
    if (command.count("--extension") > 0) build.extension = extension;
    if (!curve.empty()) build.curve = curve;
    if (!response.empty()) build.response = response;
    build.memoryBytes = machine.memoryBytes();
    build.stop = stopAsked;
  }

  void printReport(const BuildReport& report) const {
    if (json) {
      const nlohmann::ordered_json out{{"version", 1},
                                       {"object", output},
                                       {"bytes", report.bytes},
                                       {"leaveOneOutDecibels", report.leaveOneOutDecibels},
                                       {"quantisationDecibels", report.quantisationDecibels},
                                       {"choices", report.choices},
                                       {"warnings", report.warnings}};
      fmt::print("{}\n", out.dump(2));
      return;
    }
    for (const auto& choice : report.choices) fmt::print("  {}\n", choice);
    fmt::print("{}: {}", output, textFromBytes(report.bytes));
    if (!std::isnan(report.leaveOneOutDecibels))
      fmt::print(", expected quality at a new light {:.1f} dB", report.leaveOneOutDecibels);
    fmt::print("\n");
  }

  int run() {
    if (input.input == "builtin:") return listScenes();
    if (output.empty()) throw Error(Fault::Usage, "-o is required: the object to write");
    const ThreadLimit limit(machine.threads);
    TerminalProgress progress;
    stopOnSignals();
    auto scratch = std::filesystem::absolute(output).parent_path();
    if (!std::filesystem::path(output).has_filename()) scratch = scratch.parent_path();
    std::uint64_t memory = captureMemoryBytes(build.memoryBytes);
    if (sweepDepth) memory /= 2;
    auto capture = input.open(memory, scratch, progress);
    if (sweepDepth) capture = withSweptDepth(std::move(capture), memory);
    const BuildReport report = buildObject(*capture, output, build, progress);
    for (const auto& warning : report.warnings) progress.remark(warning);
    if (report.stopped) {
      fmt::print(stderr, "illum: stopped; the same command with --resume goes on\n");
      return kStopped;
    }
    printReport(report);
    return kDone;
  }
};

}  // namespace

void addBuild(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("build", "make an object from photographs or a scene");
  const auto state = std::make_shared<BuildCommand>();
  state->addTo(*command);
  command->callback([command, state, &exitCode] {
    state->finishOptions(*command);
    exitCode = state->run();
  });
}

}  // namespace illum::cli
