#include "illum/evaluate.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "core/files.h"
#include "input_options.h"
#include "terminal_progress.h"

namespace illum::cli {
namespace {

struct EvaluateCommand {
  InputOptions input;
  MachineOptions machine;
  std::string object, html;
  bool json = false;

  void addTo(CLI::App& command) {
    command.add_option("OBJECT", object, ".illum file or folder")->required();
    command.add_option("--against", input.input, std::string("the truth: ") + kInputs)->required();
    command.add_flag("--json", json, "print the figures as JSON");
    command.add_option("--html", html, "write a report with pictures");
    input.addTo(command);
    machine.addTo(command);
  }

  int run() const {
    const ThreadLimit limit(machine.threads);
    TerminalProgress progress;
    const Object opened = Object::open(object);
    const auto scratch = std::filesystem::absolute(object).parent_path();
    const std::uint64_t memoryBytes = machine.memoryBytes();
    const auto truth = input.open(memoryBytes / 2, scratch, progress);
    const Evaluation evaluation = evaluate(opened, *truth, progress, memoryBytes);
    if (!html.empty())
      writeFileAtomically(html, htmlReport(opened, *truth, evaluation, memoryBytes));
    fmt::print("{}", json ? jsonOf(evaluation) : tableOf(evaluation));
    return kDone;
  }
};

}  // namespace

void addEvaluate(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("evaluate", "judge an object against photographs");
  const auto state = std::make_shared<EvaluateCommand>();
  state->addTo(*command);
  command->callback([state, &exitCode] { exitCode = state->run(); });
}

}  // namespace illum::cli
