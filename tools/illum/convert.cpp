#include "illum/convert.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "commands.h"
#include "illum/error.h"
#include "input_options.h"
#include "orderly_stop.h"
#include "terminal_progress.h"

namespace illum::cli {
namespace {

struct ConvertCommand {
  std::string input, output, uv;
  MachineOptions machine;
  ConvertOptions options;
  bool noDepth = false;

  void addTo(CLI::App& command) {
    command.add_option("OBJECT", input, ".illum file or folder")->required();
    command.add_option("OUTPUT", output, "object to write: NAME.illum, or FOLDER/")->required();
    command.add_option("--uv", uv, "other view points of each slab, such as 5x5");
    command.add_flag("--no-depth", noDepth, "new view points as if depth was not known");
    command.add_option("--coding", options.coding, "avif, jpeg or png (default: as it is)");
    command.add_option("--quality", options.quality, "0 to 100 (default: as it is)");
    command.add_option("--speed", options.speed, "of the AVIF coder, 0 (smallest) to 10");
    command.add_flag("--force", options.force, "replace an existing object");
    machine.addTo(command);
  }

  int run() {
    if (!uv.empty()) {
      const auto counts = gridFrom(uv);
      options.uCount = counts[0];
      options.vCount = counts[1];
    }
    options.useDepth = !noDepth;
    options.memoryBytes = machine.memoryBytes();
    options.stop = stopAsked;
    const ThreadLimit limit(machine.threads);
    TerminalProgress progress;
    stopOnSignals();
    const ConvertReport report = convertObject(Object::open(input), output, options, progress);
    if (report.stopped) {
      fmt::print(stderr, "illum: stopped; nothing was written\n");
      return kStopped;
    }
    if (report.unseenPixels > 0) {
      progress.remark(fmt::format("{} pixels of new views were seen from nowhere and are guessed",
                                  report.unseenPixels));
    }
    if (report.clippedSamples > 0) {
      progress.remark(
          fmt::format("{} plane samples lay outside the quantiser's range and took its "
                      "nearest end",
                      report.clippedSamples));
    }
    return kDone;
  }
};

}  // namespace

void addConvert(CLI::App& program, int& exitCode) {
  auto* command =
      program.add_subcommand("convert", "another form, coding or grid of view points of an object");
  const auto state = std::make_shared<ConvertCommand>();
  state->addTo(*command);
  command->callback([state, &exitCode] { exitCode = state->run(); });
}

}  // namespace illum::cli
