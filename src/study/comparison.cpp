#include "study/comparison.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <string>

#include "core/memory.h"
#include "illum/colour.h"
#include "illum/error.h"
#include "object/manifest.h"

namespace illum {
namespace {

std::string photographsOf(Size size) {
  return "photographs of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
         " pixels";
}

void checkComparable(const Object& object, const Capture& truth) {
  if (object.size() != truth.size())
    throw inputError(object.path(), photographsOf(object.size()) + " to judge it by",
                     photographsOf(truth.size()));
  if (truth.lights().empty()) throw inputError(object.path(), "photographs to judge it by", "none");
}

/// For the object's decoded tiles: all of them if they take no more than half of the memory, else
/// one row of them, which serves all lights of a step.
std::uint64_t tileBytesOf(const Object& object, std::uint64_t memoryBytes) {
  const Size size = object.size();
  const std::uint64_t bytesPerPixel =
      static_cast<std::uint64_t>(object.planes()) * sizeof(std::uint16_t);
  const std::uint64_t all = bytesPerPixel * size.pixels();
  return all <= memoryBytes / 2 ? all
                                : bytesPerPixel * Size{size.width, object.manifest().tile}.pixels();
}

/// The alpha of any relit picture is the object's mask.
BytePicture coverageOf(const Relighter& relighter, const std::vector<Rectangle>& steps, Size size) {
  BytePicture coverage(size, 1);
  for (const Rectangle& rows : steps) {
    const Picture relit = relighter.relightRegion({}, rows);
    const auto out = coverage.samples().subspan(Size{size.width, rows.y}.pixels());
    for (std::size_t pixel = 0; pixel < rows.pixels(); ++pixel)
      out[pixel] = byteFromUnit(relit.samples()[4 * pixel + 3]);
  }
  return coverage;
}

/// Premultiplied colour is colour over black.
Picture withoutAlpha(const Picture& relit) {
  Picture rgb(relit.size(), 3);
  for (std::size_t pixel = 0; pixel < relit.size().pixels(); ++pixel)
    std::copy_n(&relit.samples()[4 * pixel], 3, &rgb.samples()[3 * pixel]);
  return rgb;
}

}  // namespace

Comparison::Comparison(const Object& object, const Capture& truth, std::uint64_t memoryBytes)
    : object_(object),
      truth_(truth),
      steps_(stepsDown(truth, object.manifest().tile)),
      memoryBytes_(memoryBytes > 0 ? memoryBytes : machineMemoryBytes() / 4),
      tileBytes_(tileBytesOf(object, memoryBytes_)),
      relighter_(object, tileBytes_) {
  checkComparable(object, truth);
  coverage_ = illum::coverageOf(truth);
  if (coverage_.empty() && object.manifest().mask)
    coverage_ = coverageOf(relighter_, steps_, truth.size());
}

ComparedBand Comparison::compared(int light, const Rectangle& rows) const {
  const DirectionalLight& source = truth_.lights().at(static_cast<std::size_t>(light)).light;
  Picture relit = relighter_.relightRegion({&source, 1}, rows);
  if (relit.channels() == 4) relit = withoutAlpha(relit);
  BytePicture bytes = displayBytes(relit);
  return {std::move(relit), std::move(bytes),
          readPhotograph(truth_, light, rows, object_.manifest().mask ? coverage_ : BytePicture())};
}

int Comparison::lightsAtOnce(std::uint64_t keptBytes) const {
  // Relit with and without alpha, samples and linear photograph in floats; two pictures in bytes.
  constexpr std::uint64_t kBytesPerPixel = (4 + 3 + 3 + 3) * sizeof(float) + 2 * 3;
  std::uint64_t largest = 1;
  for (const Rectangle& rows : steps_) largest = std::max<std::uint64_t>(largest, rows.pixels());
  const std::uint64_t held = truth_.residentBytes() + tileBytes_ + keptBytes;
  const std::uint64_t free = memoryBytes_ > held ? memoryBytes_ - held : 0;
  const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
  return static_cast<int>(std::clamp<std::uint64_t>(free / (largest * kBytesPerPixel), 1, threads));
}

void Comparison::forEachBand(
    std::span<const int> lights, std::uint64_t keptBytes, Progress& progress,
    const std::function<void(std::size_t i, const ComparedBand& band)>& use) const {
  tbb::task_arena arena(lightsAtOnce(keptBytes));
  for (const Rectangle& rows : steps_) {
    const auto underLight = [&](std::size_t i) {
      // Isolated: a thread that waits inside must not begin another light and hold two.
      tbb::this_task_arena::isolate([&] { use(i, compared(lights[i], rows)); });
      progress.advance();
    };
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, lights.size(), underLight); });
  }
}

}  // namespace illum
