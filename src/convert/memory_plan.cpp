#include "convert/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "build/plane_row.h"
#include "build/tile_writer.h"
#include "core/memory.h"
#include "illum/error.h"

namespace illum {
namespace {

// The program itself and its libraries.
constexpr std::uint64_t kProgramBytes = std::uint64_t{160} << 20;
// Of each pixel of a view that is being made: points, ranges and meshes of depth.
constexpr std::uint64_t kSynthesisBytes = 128;
// Floats of each pixel and plane meanwhile: two sums, two pictures of the result, and of the views
// that it is made from the one at work and the one before.
constexpr std::uint64_t kCopies = 6;
// Of each pixel, beside planes: coverage, weights.
constexpr std::uint64_t kBesidePlanes = 3;

// What making a view takes beside the views that are kept.
struct Needs {
  std::uint64_t program = 0;
  std::uint64_t view = 0;  ///< the new one, all of its planes
  std::uint64_t perPart = 0, perPlane = 0;
  std::uint64_t decode = 0;  ///< a tile
  std::uint64_t row = 0, code = 0;

  std::uint64_t forPlanes(int planes) const {
    const std::uint64_t making = perPart + perPlane * static_cast<std::uint64_t>(planes) + decode;
    return program + view + std::max(making, row + code);
  }
};

Needs needsOf(const Manifest& manifest, std::span<const int> planesOfBases, bool newViews) {
  Needs needs;
  needs.program = kProgramBytes;
  needs.code = tileCodingBytes(manifest, planesOfBases);
  if (!newViews) return needs;
  needs.row = planeRowBytes(manifest, planesOfBases);
  for (int g = 0; g < static_cast<int>(manifest.groups.size()); ++g) {
    const GroupEntry& group = manifest.groups[static_cast<std::size_t>(g)];
    const std::uint64_t pixels = sizeOf(group.view.geometry).pixels();
    const auto planes =
        static_cast<std::uint64_t>(planesOfBases[static_cast<std::size_t>(group.basis)]);
    const auto stored = static_cast<std::uint64_t>(manifest.coding(g).planes());
    const std::uint64_t tile = manifest.grid(g).tileRectangle(0, 0, 0).pixels();
    needs.view = std::max(needs.view, pixels * (planes + kBesidePlanes) * sizeof(float));
    needs.perPlane = std::max(needs.perPlane, pixels * kCopies * sizeof(float));
    needs.perPart = std::max(needs.perPart,
                             pixels * (kSynthesisBytes + kCopies * kBesidePlanes * sizeof(float)));
    // Codes, the picture that a decoder makes of them, and the file.
    needs.decode = std::max(needs.decode, tile * stored * 6);
  }
  return needs;
}

}  // namespace

ConversionMemory planConversion(const Manifest& manifest, std::span<const int> planesOfBases,
                                bool newViews, std::uint64_t memoryBytes, int threads) {
  const Needs needs = needsOf(manifest, planesOfBases, newViews);
  const int all = *std::max_element(planesOfBases.begin(), planesOfBases.end());
  ConversionMemory memory;
  // In as few parts as fit: each decodes its views again.
  for (int parts = 1;; ++parts) {
    memory.planesAtOnce = (all + parts - 1) / parts;
    if (needs.forPlanes(memory.planesAtOnce) <= memoryBytes) break;
    if (memory.planesAtOnce > 1) continue;
    throw Error(Fault::Machine,
                fmt::format("--max-memory {}: converting this object needs at least {}",
                            textFromBytes(memoryBytes), textFromBytes(needs.forPlanes(1))));
  }
  const std::uint64_t left = memoryBytes - needs.forPlanes(memory.planesAtOnce);
  const auto sideBySide = [&](std::uint64_t each) {
    const std::uint64_t more = left / 4 / std::max<std::uint64_t>(1, each);
    return static_cast<int>(
        std::min<std::uint64_t>(1 + more, static_cast<std::uint64_t>(std::max(1, threads))));
  };
  memory.viewBytes = left / 2;
  memory.tilesDecoded = sideBySide(needs.decode);
  memory.tilesCoded = sideBySide(needs.code);
  return memory;
}

}  // namespace illum
