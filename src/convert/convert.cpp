#include "illum/convert.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "build/depth_range.h"
#include "build/tile_writer.h"
#include "convert/memory_plan.h"
#include "convert/new_view.h"
#include "convert/view_plan.h"
#include "core/memory.h"
#include "core/stoppable_progress.h"
#include "encode/encode_tile.h"
#include "encode/object_writer.h"
#include "illum/error.h"
#include "object/entry_name.h"

namespace illum {
namespace {

constexpr int kMaxViewPoints = 1024;  // in a row of a slab
constexpr int kDefaultSpeed = 6;

void checkOptions(const ConvertOptions& options) {
  const auto refuse = [](std::string_view option, std::string_view expected, int found) {
    throw Error(Fault::Usage, fmt::format("{}: expected {}, found {}", option, expected, found));
  };
  if (options.uCount < 0 || options.vCount < 0 || options.uCount > kMaxViewPoints ||
      options.vCount > kMaxViewPoints || (options.uCount == 0) != (options.vCount == 0)) {
    throw Error(Fault::Usage, fmt::format("--uv: expected 1x1 to {0}x{0}, found {1}x{2}",
                                          kMaxViewPoints, options.uCount, options.vCount));
  }
  if (options.quality < -1 || options.quality > 100)
    refuse("--quality", "0 to 100", options.quality);
  if (options.speed < -1 || options.speed > 10) refuse("--speed", "0 to 10", options.speed);
}

class Conversion {
 public:
  Conversion(const Object& source, const ConvertOptions& options, ObjectWriter& writer,
             StoppableProgress& progress)
      : source_(source),
        old_(source.manifest()),
        options_(options),
        writer_(writer),
        progress_(progress),
        memoryBytes_(options.memoryBytes != 0 ? options.memoryBytes : machineMemoryBytes() / 4) {
    plan();
  }

  void run(ConvertReport& report);

 private:
  void plan();
  bool changesNothing() const { return !recodes_ && options_.uCount == 0; }
  void copyEntry(const std::string& name) { writer_.add(name, source_.entry(name)); }
  void copyView(int stored, int group);
  void makeView(int group, LevelPyramid& pyramid, ConvertReport& report);
  NewViewMaker& makerOf(const std::vector<int>& groups);
  void planMemory();

  const Object& source_;
  const Manifest& old_;
  const ConvertOptions& options_;
  ObjectWriter& writer_;
  StoppableProgress& progress_;
  std::uint64_t memoryBytes_;
  std::vector<PlannedView> views_;
  Manifest manifest_;
  EncodeSettings settings_;
  bool recodes_ = false;
  ConversionMemory memory_;
  std::unique_ptr<NewViewMaker> maker_;  // of the slab at work
};

void Conversion::plan() {
  const CodingEntry& coding = old_.coding();
  const Coding wanted = options_.coding.empty() ? coding.coding : codingFromName(options_.coding);
  if (!supportsBits(wanted, coding.bits)) {
    throw Error(Fault::Input, fmt::format("{}: expected a coding that holds {} bits, found {}",
                                          source_.path().string(), coding.bits, nameOf(wanted)));
  }
  settings_.quality = options_.quality >= 0 ? options_.quality : coding.quality;
  settings_.speed = options_.speed >= 0 ? options_.speed : kDefaultSpeed;
  recodes_ = wanted != coding.coding || options_.quality >= 0;
  views_ = options_.uCount == 0 ? viewsAsTheyAre(old_)
                                : viewsOnGrid(old_, options_.uCount, options_.vCount);
  manifest_ = old_;
  manifest_.groups.clear();
  for (const PlannedView& view : views_) manifest_.groups.push_back(view.entry);
  for (BasisEntry& basis : manifest_.bases) {
    basis.coding.coding = wanted;
    basis.coding.quality = settings_.quality;
  }
  if (recodes_) {
    manifest_.provenance.emplace_back(
        "convert", fmt::format("coding {}, quality {}", nameOf(wanted), settings_.quality));
  }
  if (options_.uCount > 0) {
    manifest_.provenance.emplace_back(
        "convert",
        fmt::format("view points {}x{}, {}", options_.uCount, options_.vCount,
                    options_.useDepth && source_.hasDepth() ? "by depth" : "on the window"));
  }
  checkConsistency(manifest_);
  planMemory();
}

// What only copies entries holds but one at a time.
void Conversion::planMemory() {
  const bool newViews = std::ranges::any_of(views_, [](const auto& v) { return !v.stored; });
  if (!newViews && !recodes_) return;
  std::vector<int> planes;
  for (const BasisEntry& basis : manifest_.bases) {
    const auto& functions = basis.coding.functions;
    planes.push_back(functions.empty() ? 1 : 1 + *std::ranges::max_element(functions));
  }
  memory_ = planConversion(manifest_, planes, newViews, memoryBytes_,
                           tbb::this_task_arena::max_concurrency());
}

void Conversion::copyView(int stored, int group) {
  const TileGrid grid = old_.grid(stored);
  for (int level = 0; level < grid.levels(); ++level) {
    const int across = grid.tilesAcross(level);
    tbb::task_arena arena(memory_.tilesCoded);
    arena.execute([&] {
      tbb::parallel_for(0, across * grid.tilesDown(level), [&](int i) {
        const int x = i % across, y = i / across;
        const auto copy = [&](auto nameIn) {
          writer_.add(nameIn(manifest_, group, level, x, y),
                      source_.entry(nameIn(old_, stored, level, x, y)));
        };
        if (recodes_) {
          const CodingEntry& coding = manifest_.coding(group);
          writer_.add(planeTileName(manifest_, group, level, x, y),
                      encodeTile(source_.planeTile(stored, level, x, y), coding.coding, coding.bits,
                                 settings_));
        } else {
          copy(planeTileName);
        }
        if (old_.mask) copy(maskTileName);
        if (source_.hasDepth(stored)) copy(depthTileName);
        if (level == 0) progress_.advance(grid.tileRectangle(0, x, y).pixels());
      });
    });
  }
}

NewViewMaker& Conversion::makerOf(const std::vector<int>& groups) {
  if (!maker_ || maker_->groups() != groups) {
    maker_.reset();
    maker_ = std::make_unique<NewViewMaker>(source_, groups, memory_, progress_);
  }
  return *maker_;
}

void Conversion::makeView(int group, LevelPyramid& pyramid, ConvertReport& report) {
  const PlannedView& planned = views_[static_cast<std::size_t>(group)];
  SynthesisOptions how;
  how.useDepth = options_.useDepth;
  const NewView view = makerOf(planned.sources).make(planned.entry.view.geometry, how);
  auto& depth = manifest_.groups[static_cast<std::size_t>(group)].depth;
  depth.reset();
  if (!view.depth.empty()) {
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (const float z : view.depth) {
      if (!std::isfinite(z)) continue;
      from = std::min<double>(from, z);
      to = std::max<double>(to, z);
    }
    if (from > to) from = to = 0;
    const std::vector<View> self{planned.entry.view};
    depth = depthRangeFor(self, 0, from, to);
  }
  report.unseenPixels += view.unseenPixels;
  for (int row = 0; row < manifest_.grid(group).tilesDown(0); ++row)
    pyramid.add(view.tileRow(manifest_, group, row));
}

void Conversion::run(ConvertReport& report) {
  std::uint64_t pixels = 0;
  for (const PlannedView& view : views_) pixels += sizeOf(view.entry.view.geometry).pixels();
  progress_.begin("converting", pixels);
  TileWriter tiles(manifest_, settings_, writer_, progress_);
  TileQueue queue(manifest_);
  LevelPyramid pyramid(manifest_, [&](const PlaneRow& row) {
    queue.add(row);
    writeTiles(tiles, memory_.tilesCoded, [&]() -> std::optional<CutTile> {
      if (queue.empty()) return std::nullopt;
      return queue.next(tiles);
    });
  });
  for (std::size_t g = 0; g < views_.size(); ++g) {
    const auto group = static_cast<int>(g);
    if (views_[g].stored) {
      copyView(*views_[g].stored, group);
      ++report.keptViews;
    } else {
      makeView(group, pyramid, report);
      ++report.newViews;
    }
  }
  progress_.end();
  report.clippedSamples = tiles.samples().clipped;
  copyEntry(std::string(kBasisEntry));
  const auto names = source_.entries();
  if (std::ranges::find(names, kPosterEntry) != names.end()) copyEntry(std::string(kPosterEntry));
  if (changesNothing()) {
    copyEntry(std::string(kManifestEntry));
  } else {
    const std::string text = textOf(manifest_);
    writer_.add(std::string(kManifestEntry), std::as_bytes(std::span(text)));
  }
}

}  // namespace

ConvertReport convertObject(const Object& source, const std::filesystem::path& out,
                            const ConvertOptions& options, Progress& progress) {
  checkOptions(options);
  const bool folder = !out.has_filename();
  ObjectWriter writer(folder ? out.parent_path() : out,
                      folder ? ObjectForm::Folder : ObjectForm::Archive, "convert", false,
                      options.force);
  ConvertReport report;
  StoppableProgress stoppable(progress, options.stop);
  try {
    Conversion(source, options, writer, stoppable).run(report);
  } catch (const Stopped&) {
    report.stopped = true;
    return report;
  }
  report.bytes = writer.finish();
  return report;
}

}  // namespace illum
