#include "input_options.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/memory.h"
#include "illum/error.h"

namespace illum::cli {

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
}

std::unique_ptr<Capture> InputOptions::open(std::uint64_t memoryBytes,
                                            const std::filesystem::path& scratch,
                                            Progress& progress) const {
  PhotographOptions options;
  options.lightFile = lightFile;
  options.mask = mask;
  options.memoryBytes = memoryBytes;
  options.scratch = scratch;
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
  return openPhotographs(input, options, progress);
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
