#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "commands.h"
#include "core/memory.h"
#include "illum/capture_folder.h"
#include "illum/error.h"
#include "input_options.h"
#include "orderly_stop.h"
#include "terminal_progress.h"

namespace illum::cli {
namespace {

struct CaptureCommand {
  std::string input, output;
  SceneInput scene;
  MachineOptions machine;
  CaptureFolderOptions options;

  void addTo(CLI::App& command) {
    command.add_option("SCENE", input, "scene or mesh file, or builtin:NAME")->required();
    command.add_option("-o,--output", output, "folder to write");
    command.add_flag("--half", options.half, "samples of 16 bits instead of 32");
    command.add_flag("--force", options.force, "replace an existing capture");
    scene.addTo(command);
    machine.addTo(command);
  }

  int run() {
    if (input == "builtin:") return listScenes();
    if (output.empty()) throw Error(Fault::Usage, "-o is required: the folder to write");
    if (!isSceneName(input)) {
      throw inputError(input, "a scene or mesh file or builtin:NAME", "another name");
    }
    const ThreadLimit limit(machine.threads);
    TerminalProgress progress;
    stopOnSignals();
    options.memoryBytes = machine.memoryBytes();
    options.stop = stopAsked;
    const auto capture = openScene(input, scene.options(), progress);
    progress.remark(fmt::format("{}: {} views under {} lights, {} before compression", output,
                                capture->groups(), capture->lights().size(),
                                textFromBytes(captureFolderBytes(*capture, options.half))));
    if (!writeCaptureFolder(*capture, output, options, progress)) {
      fmt::print(stderr, "illum: stopped; nothing was written\n");
      return kStopped;
    }
    return kDone;
  }
};

}  // namespace

void addCapture(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("capture", "render a scene into pictures");
  const auto state = std::make_shared<CaptureCommand>();
  state->addTo(*command);
  command->callback([state, &exitCode] { exitCode = state->run(); });
}

}  // namespace illum::cli
