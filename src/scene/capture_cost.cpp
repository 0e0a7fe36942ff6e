#include "scene/capture_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "illum/error.h"

namespace illum {
namespace {

constexpr double kMaxViews = 65536, kMaxLights = 100'000;
constexpr double kRaysPerSecond = 5e6;  // of a machine with two cores

double pixelsOf(Size size) {
  return static_cast<double>(size.width) * size.height;
}

/// Views and pixels of one plan.
std::pair<double, double> countsOf(const SlabPlan& slab) {
  const double views = static_cast<double>(slab.uCount) * slab.vCount;
  return {views, views * pixelsOf(slab.size.value_or(Size{slab.longerSide, slab.longerSide}))};
}
std::pair<double, double> countsOf(const TurnPlan& turn) {
  const auto [views, pixels] = countsOf(turn.slab);
  return {turn.slabs * views, turn.slabs * pixels};
}
std::pair<double, double> countsOf(const PhotographPlan& plan) {
  return {1, pixelsOf(plan.size)};
}
std::pair<double, double> countsOf(const CameraPlan& plan) {
  return {1, pixelsOf(plan.size)};
}
std::pair<double, double> countsOf(const FixedPlan& plan) {
  return {1, pixelsOf(sizeOf(plan.view.geometry))};
}

double countOf(const LightPlan& plan) {
  if (const auto* grid = std::get_if<FibonacciGrid>(&plan.lights)) return grid->count;
  if (const auto* grid = std::get_if<PolarGrid>(&plan.lights))
    return static_cast<double>(grid->thetaCount) * grid->phiCount;
  return static_cast<double>(std::get<std::vector<LightFileEntry>>(plan.lights).size());
}

/// The largest unit of which there is at least one; `units` in growing order.
std::string inUnits(double value,
                    std::initializer_list<std::pair<double, std::string_view>> units) {
  std::pair<double, std::string_view> unit = *units.begin();
  for (const auto& candidate : units)
    if (value >= candidate.first) unit = candidate;
  return fmt::format("{:.3g} {}", value / unit.first, unit.second);
}

}  // namespace

CaptureCost costOf(const CapturePlan& plan) {
  CaptureCost cost;
  for (const ViewPlan& view : plan.views) {
    const auto [views, pixels] = std::visit([](const auto& v) { return countsOf(v); }, view);
    cost.views += views;
    cost.pixels += pixels;
  }
  cost.lights = countOf(plan.lights);
  cost.samples = plan.samplesPerPixel;
  cost.vertices = 1.0 + plan.bounces;
  return cost;
}

std::string textOf(const CaptureCost& cost) {
  const std::string time = inUnits(
      cost.shadowRays() / kRaysPerSecond,
      {{1, "seconds"}, {60, "minutes"}, {3600, "hours"}, {86400, "days"}, {31557600, "years"}});
  const std::string bytes = inUnits(cost.photographBytes(), {{1, "bytes"},
                                                             {1024.0, "KiB"},
                                                             {1048576.0, "MiB"},
                                                             {1073741824.0, "GiB"},
                                                             {1099511627776.0, "TiB"},
                                                             {1125899906842624.0, "PiB"},
                                                             {1152921504606846976.0, "EiB"}});
  return fmt::format(
      "{:.6g} views of {:.6g} pixels x {:.6g} lights x {:.6g} samples x {:.6g} path "
      "vertices = {:.3g} shadow rays, about {} on two cores, and {} of photographs",
      cost.views, cost.pixels / std::max(1.0, cost.views), cost.lights, cost.samples, cost.vertices,
      cost.shadowRays(), time, bytes);
}

void checkCost(const CapturePlan& plan, double maxShadowRays) {
  const CaptureCost cost = costOf(plan);
  std::string expected;
  if (cost.views > kMaxViews) expected = fmt::format("at most {} views", kMaxViews);
  if (cost.lights > kMaxLights) expected = fmt::format("at most {} lights", kMaxLights);
  if (!(cost.shadowRays() <= maxShadowRays))
    expected = fmt::format("a capture of at most {:.3g} shadow rays", maxShadowRays);
  if (!expected.empty())
    throw Error(Fault::Input, fmt::format("expected {}, found {}", expected, textOf(cost)));
}

}  // namespace illum
