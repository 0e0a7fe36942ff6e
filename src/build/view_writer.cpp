#include "build/view_writer.h"

#include <algorithm>

#include "build/depth_range.h"
#include "build/poster.h"
#include "illum/picture_io.h"
#include "object/entry_name.h"

namespace illum {
namespace {

constexpr int kPosterQuality = 80;

// The view that is shown of an object: a slab's middle one, else the first.
int posterGroup(const std::vector<View>& views) {
  const auto* first = std::get_if<SlabView>(&views.front().geometry);
  if (first == nullptr) return 0;
  for (std::size_t g = 0; g < views.size(); ++g) {
    const auto* view = std::get_if<SlabView>(&views[g].geometry);
    if (view != nullptr && view->slab.name == first->slab.name &&
        view->u == view->slab.uCount / 2 && view->v == view->slab.vCount / 2)
      return static_cast<int>(g);
  }
  return 0;
}

std::vector<const PlaneOperator*> operatorsOf(const Plan& plan) {
  std::vector<const PlaneOperator*> operators;
  for (const PlannedBasis& basis : plan.bases) operators.push_back(&basis.fit.planes);
  return operators;
}

}  // namespace

ViewWriter::ViewWriter(const Capture& capture, const LightChoice& lights, const Plan& plan,
                       Manifest& manifest, const EncodeSettings& settings, int atOnce,
                       ObjectWriter& writer, Progress& progress)
    : capture_(capture),
      plan_(plan),
      manifest_(manifest),
      writer_(writer),
      progress_(progress),
      atOnce_(atOnce),
      poster_(posterGroup(capture.views())),
      tiles_(manifest, settings, writer, progress),
      queue_(manifest),
      pyramid_(manifest, [this](const PlaneRow& row) { take(row); }),
      fitter_(capture, lights.used, operatorsOf(plan), manifest, progress) {}

SampleCounts ViewWriter::writeAll() {
  chooseDepths();
  std::uint64_t pixels = 0;
  for (int group = 0; group < capture_.groups(); ++group) {
    if (isFinished(group)) continue;
    left_.push_back(group);
    pixels += capture_.size(group).pixels();
  }
  // Every pixel is fitted once and coded once.
  progress_.begin(
      capture_.isRendered() ? "rendering, fitting and coding" : "fitting and coding tiles",
      2 * pixels);
  writeTiles(tiles_, atOnce_, [this] { return nextTile(); });
  progress_.end();
  return tiles_.samples();
}

// Fits a row when the tiles of those before are on their way to be coded. Nothing at the end.
std::optional<CutTile> ViewWriter::nextTile() {
  if (queue_.empty()) {
    if (left_.empty()) return std::nullopt;
    const int group = left_.front();
    pyramid_.add(fitter_.fit(group, nextRow_));
    if (++nextRow_ == manifest_.grid(group).tilesDown(0)) {
      left_.pop_front();
      nextRow_ = 0;
    }
  }
  return queue_.next(tiles_);
}

// Before any tile, for the manifest speaks of the depths of finished views too.
void ViewWriter::chooseDepths() {
  if (!capture_.hasDepth()) return;
  progress_.begin("looking over the depths", static_cast<std::uint64_t>(capture_.groups()));
  for (int group = 0; group < capture_.groups(); ++group) {
    manifest_.groups[static_cast<std::size_t>(group)].depth = depthRangeOf(capture_, group);
    progress_.advance();
  }
  progress_.end();
}

// By an earlier run that was interrupted. All of a view or nothing: its coarser levels are made
// from all rows of the finest.
bool ViewWriter::isFinished(int group) const {
  if (group == poster_ && !writer_.has(std::string(kPosterEntry))) return false;
  bool finished = true;
  forEachTileOfGroup(manifest_, group,
                     [&](const std::string& name) { finished = finished && writer_.has(name); });
  return finished;
}

void ViewWriter::take(const PlaneRow& row) {
  queue_.add(row);
  if (row.group != poster_ || row.level + 1 < manifest_.grid(row.group).levels()) return;
  const int index = manifest_.groups[static_cast<std::size_t>(row.group)].basis;
  const PlannedBasis& basis = plan_.bases[static_cast<std::size_t>(index)];
  writer_.add(
      std::string(kPosterEntry),
      encodeJpeg(posterOf(row, basis.fit, manifest_.response, basis.directions), kPosterQuality));
}

}  // namespace illum
