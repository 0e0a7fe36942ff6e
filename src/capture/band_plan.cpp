#include "capture/band_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/memory.h"
#include "illum/error.h"

namespace illum {
namespace {

// Rows that are on their way into the scratch file at a time.
constexpr std::uint64_t kScratchRows = 16;

// What the photographs need, added up.
struct Needs {
  std::uint64_t stackBytes = 0;        // all of them decoded
  std::uint64_t bandRowBytes = 0;      // one upright row of each
  std::uint64_t scratchRowBytes = 0;   // of those that go to the scratch file
  std::uint64_t openDecoderBytes = 0;  // of all that are read side by side
  std::uint64_t largestDecoderBytes = 0;
  std::uint64_t largestScratchBytes = 0;  // of bringing one into the scratch file
};

Needs needsOf(const std::vector<Photograph>& photographs) {
  Needs needs;
  for (const Photograph& photograph : photographs) {
    const std::uint64_t row = uprightRowBytes(photograph);
    needs.stackBytes += photograph.bytes();
    needs.bandRowBytes += row;
    needs.largestDecoderBytes = std::max(needs.largestDecoderBytes, photograph.decoderBytes());
    if (!needsScratch(photograph)) {
      needs.openDecoderBytes += photograph.decoderBytes();
      continue;
    }
    needs.scratchRowBytes += row;
    const bool turned = !photograph.header.orientation.keepsRowOrder();
    needs.largestScratchBytes =
        std::max(needs.largestScratchBytes, photograph.decoderBytes() + kScratchRows * row +
                                                (turned ? photograph.bytes() : 0));
  }
  return needs;
}

int lanesWithin(std::uint64_t bytes, std::uint64_t each, const BandRequest& request,
                std::size_t photographs) {
  const std::uint64_t fit = bytes / std::max<std::uint64_t>(each, 1);
  return static_cast<int>(std::min<std::uint64_t>(
      {fit, static_cast<std::uint64_t>(request.threads), std::uint64_t{photographs}}));
}

std::uint64_t leastForWhole(const Needs& needs, const BandRequest& request) {
  return request.otherBytes + needs.stackBytes +
         std::max(needs.stackBytes, needs.largestDecoderBytes);
}

std::uint64_t leastForBands(const Needs& needs, const BandRequest& request) {
  const auto rows = static_cast<std::uint64_t>(std::min(request.rowStep, request.rows));
  return request.otherBytes +
         std::max(needs.openDecoderBytes + rows * needs.bandRowBytes, needs.largestScratchBytes);
}

BandPlan planWhole(const Needs& needs, const BandRequest& request, std::size_t photographs) {
  BandPlan plan;
  plan.whole = true;
  plan.rows = request.rows;
  const std::uint64_t left = request.memoryBytes - request.otherBytes - needs.stackBytes;
  plan.lanes = lanesWithin(left, needs.largestDecoderBytes, request, photographs);
  plan.residentBytes = request.otherBytes + needs.stackBytes +
                       static_cast<std::uint64_t>(plan.lanes) * needs.largestDecoderBytes;
  return plan;
}

BandPlan planRows(const Needs& needs, const BandRequest& request, std::size_t photographs) {
  BandPlan plan;
  const std::uint64_t left = request.memoryBytes - request.otherBytes;
  const auto step = static_cast<std::uint64_t>(request.rowStep);
  const std::uint64_t fit = (left - needs.openDecoderBytes) / needs.bandRowBytes / step * step;
  const auto all = static_cast<std::uint64_t>(request.rows);
  plan.rows = static_cast<int>(std::min(std::max(fit, std::min(step, all)), all));
  const auto rows = static_cast<std::uint64_t>(plan.rows);
  const std::uint64_t bands = (all + rows - 1) / rows;
  plan.scratchBytes = bands * rows * needs.scratchRowBytes;
  plan.lanes = lanesWithin(left, needs.largestScratchBytes, request, photographs);
  plan.residentBytes = request.otherBytes +
                       std::max(needs.openDecoderBytes + rows * needs.bandRowBytes,
                                static_cast<std::uint64_t>(plan.lanes) * needs.largestScratchBytes);
  return plan;
}

}  // namespace

bool needsScratch(const Photograph& photograph) {
  return !photograph.header.sequential || !photograph.header.orientation.keepsRowOrder();
}

std::size_t uprightRowBytes(const Photograph& photograph) {
  return static_cast<std::size_t>(photograph.header.upright().width) * photograph.pixelBytes();
}

BandPlan planBands(const std::vector<Photograph>& photographs, const BandRequest& request,
                   const std::string& source) {
  const Needs needs = needsOf(photographs);
  const std::uint64_t forWhole = leastForWhole(needs, request);
  const std::uint64_t forBands = leastForBands(needs, request);
  if (request.memoryBytes >= forWhole) return planWhole(needs, request, photographs.size());
  if (request.memoryBytes >= forBands) return planRows(needs, request, photographs.size());
  const Size size = photographs.front().header.upright();
  throw Error(
      Fault::Machine,
      fmt::format("{}: reading {} photographs of {}x{} pixels needs at least {} of memory, "
                  "--max-memory gives it {}",
                  source, photographs.size(), size.width, size.height,
                  textFromBytes(std::min(forWhole, forBands)), textFromBytes(request.memoryBytes)));
}

}  // namespace illum
