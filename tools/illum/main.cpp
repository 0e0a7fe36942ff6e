// illum: from photographs and scenes to relightable objects and back to pictures. Exit codes: 0
// done, 1 the input is at fault, 2 wrong usage, 3 a fault of the machine, 130 stopped by Ctrl-C.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "commands.h"
#include "illum/error.h"
#include "illum/version.h"

namespace {

int complain(int code, const std::string& sentence) {
  fmt::print(stderr, "illum: {}\n", sentence);
  return code;
}

int run(int argc, char** argv) {
  CLI::App program("Image-based objects whose light can be changed.", "illum");
  program.set_version_flag("--version", std::string("illum ") + illum::kVersion);
  program.require_subcommand(1);
  int exitCode = illum::cli::kDone;
  illum::cli::addBuild(program, exitCode);
  illum::cli::addCapture(program, exitCode);
  illum::cli::addRelight(program, exitCode);
  illum::cli::addConvert(program, exitCode);
  illum::cli::addEvaluate(program, exitCode);
  illum::cli::addNormals(program, exitCode);
  illum::cli::addInfo(program, exitCode);
  illum::cli::addVerify(program, exitCode);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return complain(static_cast<int>(illum::Fault::Usage), error.what());
  }
  // A full disk behind a pipe or file shows only when the last bytes leave.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw illum::Error(illum::Fault::Machine, "standard output: cannot write all of it");
  }
  return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
  const int machine = static_cast<int>(illum::Fault::Machine);
  // A file over the limit of its size is then an error of write(), with a sentence, not a kill.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const illum::Error& error) {
    return complain(static_cast<int>(error.fault()), error.what());
  } catch (const std::bad_alloc&) {
    return complain(machine, "out of memory; a smaller --max-memory or --tile may help");
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(machine, error.what());
  } catch (const std::exception& error) {
    return complain(machine, error.what());
  }
}
