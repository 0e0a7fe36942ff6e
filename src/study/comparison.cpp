#include "study/comparison.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <string>

#include "core/memory.h"
#include "illum/colour.h"
#include "illum/error.h"
#include "object/manifest.h"
#include "study/evaluation_text.h"

namespace illum {
namespace {

std::string photographsOf(Size size) {
  return "photographs of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
         " pixels";
}

/// How far two poses that were written down once may lie apart after rounding: radians, and a share
/// of the distance from the origin.
constexpr double kSamePose = 1e-4;

/// Whether both look through their corners alike.
bool seeTheSame(const ViewGeometry& a, const ViewGeometry& b) {
  const Size size = sizeOf(a);
  const double width = size.width, height = size.height;
  for (const PixelPosition corner :
       {PixelPosition{0, 0}, {width, 0}, {0, height}, {width, height}}) {
    const Ray one = rayThrough(a, corner), other = rayThrough(b, corner);
    if (length(one.direction - other.direction) > kSamePose ||
        length(one.origin - other.origin) > kSamePose * (1 + length(one.origin)))
      return false;
  }
  return true;
}

std::string quoted(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  return "\"" + printableName(name, kLongest) + "\"";
}

/// The object's view of that name.
int viewOfName(const Object& object, const View& wanted) {
  for (int group = 0; group < object.groups(); ++group)
    if (object.view(group).name == wanted.name) return group;
  const bool one = object.groups() == 1;
  throw inputError(
      object.path(), "a view " + quoted(wanted.name) + " as the capture has",
      one ? "only " + quoted(object.view(0).name)
          : "none of that name among its " + std::to_string(object.groups()) + " views");
}

void checkSize(const Object& object, const Capture& truth, ViewPair pair) {
  const Size expected = object.size(pair.object), found = truth.size(pair.truth);
  if (expected == found) return;
  const std::string& name = object.view(pair.object).name;
  const std::string judged = truth.groups() == 1 ? "it" : "its view " + quoted(name);
  throw inputError(object.path(), photographsOf(expected) + " to judge " + judged + " by",
                   photographsOf(found));
}

/// For the object's decoded tiles: all of them if they take no more than half of the memory, else
/// one row of them, which serves all lights of a step.
std::uint64_t tileBytesOf(const Object& object, int group, std::uint64_t memoryBytes) {
  const Size size = object.size(group);
  const std::uint64_t bytesPerPixel =
      static_cast<std::uint64_t>(object.planes(group)) * sizeof(std::uint16_t);
  const std::uint64_t all = bytesPerPixel * size.pixels();
  return all <= memoryBytes / 2 ? all
                                : bytesPerPixel * Size{size.width, object.manifest().tile}.pixels();
}

/// The alpha of any relit picture is the object's mask.
BytePicture coverageOf(const Relighter& relighter, int group, const std::vector<Rectangle>& steps) {
  BytePicture coverage({steps.back().width, steps.back().bottom()}, 1);
  for (const Rectangle& rows : steps) {
    const Picture relit = relighter.relightRegion({}, rows, group);
    const auto out = coverage.samples().subspan(Size{rows.width, rows.y}.pixels());
    for (std::size_t pixel = 0; pixel < rows.pixels(); ++pixel)
      out[pixel] = byteFromUnit(relit.samples()[4 * pixel + 3]);
  }
  return coverage;
}

const BytePicture kNoCoverage;

/// Premultiplied colour is colour over black.
Picture withoutAlpha(const Picture& relit) {
  Picture rgb(relit.size(), 3);
  for (std::size_t pixel = 0; pixel < relit.size().pixels(); ++pixel)
    std::copy_n(&relit.samples()[4 * pixel], 3, &rgb.samples()[3 * pixel]);
  return rgb;
}

}  // namespace

std::vector<ViewPair> comparableViews(const Object& object, const Capture& truth) {
  if (truth.lights().empty()) throw inputError(object.path(), "photographs to judge it by", "none");
  const bool oneEach = object.groups() == 1 && truth.groups() == 1;
  std::vector<ViewPair> pairs;
  for (int i = 0; i < truth.groups(); ++i) {
    const View& view = truth.views()[static_cast<std::size_t>(i)];
    const ViewPair pair{i, oneEach ? 0 : viewOfName(object, view)};
    checkSize(object, truth, pair);
    // An object converted to another grid of view points has the old names for new places.
    if (!oneEach && !seeTheSame(object.view(pair.object).geometry, view.geometry))
      throw inputError(object.path(), "its view " + quoted(view.name) + " where the capture has it",
                       "it elsewhere");
    pairs.push_back(pair);
  }
  return pairs;
}

Comparison::Comparison(const Object& object, const Capture& truth, ViewPair view,
                       std::uint64_t memoryBytes)
    : object_(object),
      truth_(truth),
      view_(view),
      steps_(stepsDown(truth, view.truth, object.manifest().tile)),
      memoryBytes_(memoryBytes > 0 ? memoryBytes : machineMemoryBytes() / 4),
      tileBytes_(tileBytesOf(object, view.object, memoryBytes_)),
      relighter_(object, tileBytes_) {
  coverage_ = illum::coverageOf(truth, view.truth);
  if (coverage_.empty() && object.manifest().mask)
    coverage_ = coverageOf(relighter_, view.object, steps_);
}

ComparedBand Comparison::compared(int light, const Rectangle& rows,
                                  std::span<const float> samples) const {
  const DirectionalLight& source = truth_.lights().at(static_cast<std::size_t>(light)).light;
  Picture relit = relighter_.relightRegion({&source, 1}, rows, view_.object);
  if (relit.channels() == 4) relit = withoutAlpha(relit);
  BytePicture bytes = displayBytes(relit);
  const BytePicture& coverage = object_.manifest().mask ? coverage_ : kNoCoverage;
  return {std::move(relit), std::move(bytes),
          samples.empty() ? readPhotograph(truth_, view_.truth, light, rows, coverage)
                          : photographOf(samples, truth_, light, rows, coverage)};
}

/// Samples as Capture::read() gives them of `rows`, computed row by row on all threads.
std::vector<float> Comparison::rendered(std::span<const int> lights, const Rectangle& rows) const {
  const auto width = static_cast<std::size_t>(rows.width);
  std::vector<float> samples(3 * lights.size() * rows.pixels());
  tbb::parallel_for(0, rows.height, [&](int y) {
    std::vector<float> row(3 * lights.size() * width);
    truth_.read(view_.truth, {rows.x, rows.y + y, rows.width, 1}, lights, row);
    float* to = samples.data() + static_cast<std::size_t>(y) * width;
    for (auto from = row.begin(); from != row.end(); from += rows.width, to += rows.pixels())
      std::copy_n(from, width, to);
  });
  return samples;
}

Comparison::AtOnce Comparison::lightsAtOnce(std::size_t lights, std::uint64_t keptBytes) const {
  // Relit with and without alpha, samples and linear photograph in floats; two pictures in bytes.
  constexpr std::uint64_t kBytesPerPixel = (4 + 3 + 3 + 3) * sizeof(float) + 2 * 3;
  // The samples of all, and once more in the rows that are being rendered.
  constexpr std::uint64_t kRenderedBytesPerPixel = 2 * 3 * sizeof(float);
  std::uint64_t largest = 1;
  for (const Rectangle& rows : steps_) largest = std::max<std::uint64_t>(largest, rows.pixels());
  const std::uint64_t held = truth_.residentBytes() + tileBytes_ + keptBytes;
  std::uint64_t free = memoryBytes_ > held ? memoryBytes_ - held : 0;
  AtOnce atOnce{lights};
  if (truth_.isRendered()) {
    const std::uint64_t each = largest * kRenderedBytesPerPixel;
    atOnce.read = std::clamp<std::uint64_t>(free / 2 / each, 1, lights);
    free -= std::min(free, atOnce.read * each);
  }
  const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
  atOnce.compared =
      static_cast<int>(std::clamp<std::uint64_t>(free / (largest * kBytesPerPixel), 1, threads));
  return atOnce;
}

void Comparison::forEachBand(
    std::span<const int> lights, std::uint64_t keptBytes, Progress& progress,
    const std::function<void(std::size_t i, const ComparedBand& band)>& use) const {
  if (lights.empty()) return;
  const AtOnce atOnce = lightsAtOnce(lights.size(), keptBytes);
  tbb::task_arena arena(atOnce.compared);
  std::vector<float> samples;
  for (const Rectangle& rows : steps_) {
    for (std::size_t first = 0; first < lights.size(); first += atOnce.read) {
      const std::span<const int> some =
          lights.subspan(first, std::min(atOnce.read, lights.size() - first));
      if (truth_.isRendered()) samples = rendered(some, rows);
      const std::size_t each = samples.size() / some.size();
      const auto underLight = [&](std::size_t i) {
        // Isolated: a thread that waits inside must not begin another light and hold two.
        tbb::this_task_arena::isolate([&] {
          use(first + i, compared(some[i], rows, std::span(samples).subspan(i * each, each)));
        });
        progress.advance();
      };
      arena.execute([&] { tbb::parallel_for(std::size_t{0}, some.size(), underLight); });
    }
  }
}

}  // namespace illum
