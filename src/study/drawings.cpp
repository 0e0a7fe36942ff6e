#include "study/drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "study/evaluation_text.h"
#include "study/html_text.h"

namespace illum {
namespace {

struct Rgb {
  double r, g, b;
};

/// Nine equidistant samples of "viridis" (N. Smith and S. van der Walt, 2015; dedicated to the
/// public).
constexpr std::array<Rgb, 9> kRamp{{{68, 1, 84},
                                    {71, 45, 123},
                                    {59, 82, 139},
                                    {44, 114, 142},
                                    {33, 145, 140},
                                    {40, 174, 128},
                                    {94, 201, 98},
                                    {173, 220, 48},
                                    {253, 231, 37}}};

constexpr double kLeastRangeDecibels = 3;

double positionIn(const DecibelRange& range, double decibels) {
  return (decibels - range.low) / (range.high - range.low);
}

std::string titleOf(const LightResult& light) {
  return fmt::format("<title>{} · {} dB{}</title>", htmlText(light.name),
                     figureText(light.all.psnrDecibels, 2), light.heldOut ? " · held out" : "");
}

/// A light's mark, the same in every drawing: a coloured dot, with a ring around it if held out.
std::string mark(const LightResult& light, const DecibelRange& range, double x, double y,
                 double radius) {
  std::string ring;
  if (light.heldOut)
    ring = fmt::format(R"(<circle class="ring" cx="{:.1f}" cy="{:.1f}" r="{:.1f}"/>)", x, y,
                       radius + 2.5);
  return fmt::format(
             R"(<g>{}{}<circle class="dot" cx="{:.1f}" cy="{:.1f}" r="{:.1f}" fill="{}"/></g>)",
             titleOf(light), ring, x, y, radius,
             rampColour(positionIn(range, light.all.psnrDecibels))) +
         "\n";
}

/// Many lights get smaller dots.
double dotRadius(std::size_t lights) {
  return std::clamp(50 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, lights))), 2.0,
                    6.0);
}

constexpr double kDiscRadius = 146;
constexpr double kDiscSide = 320;

/// The horizon and the circles of 30 and 60 degrees above it, seen along z, with the two axes.
/// `caption`: below it; may be empty.
std::string discGrid(double centreX, std::string_view caption) {
  const double centreY = kDiscSide / 2;
  std::string svg;
  for (const double elevationDegrees : {0.0, 30.0, 60.0}) {
    const double radius = kDiscRadius * std::cos(elevationDegrees * std::numbers::pi / 180);
    svg += fmt::format(R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="{:.1f}"/>)",
                       elevationDegrees == 0 ? "horizon" : "grid", centreX, centreY, radius);
  }
  svg += fmt::format(R"(<path class="grid" d="M{:.1f} {:.1f}h{:.1f}M{:.1f} {:.1f}v{:.1f}"/>)",
                     centreX - kDiscRadius, centreY, 2 * kDiscRadius, centreX,
                     centreY - kDiscRadius, 2 * kDiscRadius);
  if (!caption.empty())
    svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", centreX,
                       kDiscSide + 12, caption);
  return svg + "\n";
}

/// `behind`: the lights with z < 0 instead of the others.
std::string discMarks(const Evaluation& evaluation, const DecibelRange& range, double centreX,
                      bool behind) {
  const double radius = dotRadius(evaluation.lights.size());
  std::string svg;
  for (const LightResult& light : evaluation.lights) {
    if ((light.direction.z() < 0) != behind) continue;
    svg += mark(light, range, centreX + kDiscRadius * light.direction.x(),
                kDiscSide / 2 - kDiscRadius * light.direction.y(), radius);
  }
  return svg;
}

/// The plot of PSNR against the number of the light.
struct PlotScale {
  double left = 44, right = 872, top = 14, bottom = 196;
  double low = 0, high = 1, step = 1;

  double x(std::size_t index, std::size_t count) const {
    return left + (static_cast<double>(index) + 0.5) / static_cast<double>(count) * (right - left);
  }
  double y(double decibels) const {
    return bottom - (decibels - low) / (high - low) * (bottom - top);
  }
};

PlotScale plotScale(const DecibelRange& range) {
  PlotScale scale;
  for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    scale.step = step;
    scale.low = step * std::floor(range.low / step);
    scale.high = step * std::ceil(range.high / step);
    if (scale.high - scale.low <= 6 * step) break;
  }
  return scale;
}

std::string plotGrid(const PlotScale& scale) {
  std::string svg;
  for (double level = scale.low; level <= scale.high + scale.step / 2; level += scale.step)
    svg += fmt::format(
        R"(<path class="grid" d="M{0:.1f} {1:.1f}H{2:.1f}"/><text x="{3:.1f}" y="{4:.1f}" text-anchor="end">{5:.0f}</text>)",
        scale.left, scale.y(level), scale.right, scale.left - 8, scale.y(level) + 4, level);
  return svg + "\n";
}

std::string meanLine(const PlotScale& scale, const ErrorSummary& summary, std::string_view label,
                     std::string_view cssClass, double labelOffset) {
  if (summary.lights == 0 || !std::isfinite(summary.all.psnrDecibels)) return {};
  const double y = scale.y(summary.all.psnrDecibels);
  return fmt::format(
             R"(<path class="{}" d="M{:.1f} {:.1f}H{:.1f}"/><text x="{:.1f}" y="{:.1f}">{} {}</text>)",
             cssClass, scale.left, y, scale.right, scale.right + 8, y + labelOffset, label,
             figureText(summary.all.psnrDecibels, 1)) +
         "\n";
}

/// Labels of close lines move apart: the higher one up, the lower one down.
std::string meanLines(const PlotScale& scale, const Evaluation& evaluation) {
  const double used = evaluation.used.all.psnrDecibels;
  const double heldOut = evaluation.heldOut.all.psnrDecibels;
  const bool close = std::abs(scale.y(used) - scale.y(heldOut)) < 16;
  const double up = close ? -4 : 4, down = close ? 12 : 4;
  return meanLine(scale, evaluation.used, "used", "mean", used >= heldOut ? up : down) +
         meanLine(scale, evaluation.heldOut, "held out", "mean dashed",
                  used >= heldOut ? down : up);
}

}  // namespace

DecibelRange decibelRange(const Evaluation& evaluation) {
  std::vector<double> figures;
  for (const LightResult& light : evaluation.lights)
    if (std::isfinite(light.all.psnrDecibels)) figures.push_back(light.all.psnrDecibels);
  if (figures.empty()) return {};
  const auto [low, high] = std::minmax_element(figures.begin(), figures.end());
  const double middle = (*low + *high) / 2;
  const double half = std::max(kLeastRangeDecibels, *high - *low) / 2;
  return {middle - half, middle + half};
}

std::string rampColour(double t) {
  const double clamped = t > 0 ? std::min(t, 1.0) : 0;
  const double position = clamped * (kRamp.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kRamp.size() - 2);
  const double part = position - static_cast<double>(below);
  const Rgb &a = kRamp[below], &b = kRamp[below + 1];
  const auto mix = [part](double from, double to) {
    return static_cast<int>(std::lround(from + part * (to - from)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b));
}

std::string domeDrawing(const Evaluation& evaluation) {
  const DecibelRange range = decibelRange(evaluation);
  const bool behind = std::any_of(evaluation.lights.begin(), evaluation.lights.end(),
                                  [](const LightResult& light) { return light.direction.z() < 0; });
  std::string svg = fmt::format(
      R"(<svg class="dome" viewBox="0 0 {:.0f} {:.0f}" role="img" aria-label="Light directions coloured by PSNR">)",
      behind ? 2 * kDiscSide : kDiscSide, kDiscSide);
  svg += discGrid(kDiscSide / 2, behind ? "from the front" : "") +
         discMarks(evaluation, range, kDiscSide / 2, false);
  if (behind)
    svg += discGrid(1.5 * kDiscSide, "from behind") +
           discMarks(evaluation, range, 1.5 * kDiscSide, true);
  return svg + "</svg>\n";
}

std::string lightPlot(const Evaluation& evaluation) {
  const DecibelRange range = decibelRange(evaluation);
  const PlotScale scale = plotScale(range);
  const std::size_t count = evaluation.lights.size();
  std::string svg =
      "<svg class=\"plot\" viewBox=\"0 0 960 208\" role=\"img\" aria-label=\"PSNR of every "
      "light\">\n";
  svg += plotGrid(scale) + meanLines(scale, evaluation);
  for (std::size_t i = 0; i < count; ++i) {
    const double decibels = evaluation.lights[i].all.psnrDecibels;
    if (!std::isfinite(decibels)) continue;
    svg += mark(evaluation.lights[i], range, scale.x(i, count), scale.y(decibels),
                std::min(4.5, dotRadius(count)));
  }
  return svg + "</svg>\n";
}

std::string rampLegend(const Evaluation& evaluation) {
  constexpr int kSteps = 48;
  const DecibelRange range = decibelRange(evaluation);
  std::string svg =
      R"(<svg class="ramp" viewBox="0 0 240 34" role="img" aria-label="Colour scale">)";
  for (int step = 0; step < kSteps; ++step)
    svg += fmt::format(R"(<rect x="{}" y="0" width="5.5" height="10" fill="{}"/>)", 5 * step,
                       rampColour((step + 0.5) / kSteps));
  svg += fmt::format(
      R"(<text x="0" y="27">{:.1f} dB</text><text x="240" y="27" text-anchor="end">{:.1f} dB</text>)",
      range.low, range.high);
  return svg + "</svg>\n";
}

}  // namespace illum
