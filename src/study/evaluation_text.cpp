#include "study/evaluation_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/memory.h"
#include "illum/evaluate.h"

namespace illum {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kJsonVersion = 1;
constexpr std::size_t kWorstShown = 5;
constexpr std::size_t kNameWidth = 28;

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json jsonOf(const PictureError& error) {
  return {{"psnr", numberOrNull(error.psnrDecibels)},
          {"ssim", numberOrNull(error.ssim)},
          {"rms", numberOrNull(error.rms)}};
}

/// What a summary and a single light have in common.
template <typename Figures>
void addFigures(const Figures& figures, bool hasMask, Json& json) {
  json.update(jsonOf(figures.all));
  json["linear"] = {{"psnr", numberOrNull(figures.linearPsnrDecibels)},
                    {"rms", numberOrNull(figures.linearRms)}};
  json["masked"] = hasMask ? jsonOf(figures.masked) : Json();
}

Json jsonOf(const ErrorSummary& summary, bool hasMask) {
  Json json{{"lights", summary.lights}};
  if (summary.lights > 0) {
    addFigures(summary, hasMask, json);
  } else {
    for (const char* figure : {"psnr", "ssim", "rms", "linear", "masked"}) json[figure] = Json();
  }
  return json;
}

Json jsonOf(const LightResult& light, bool hasMask) {
  Json json{{"name", light.name},
            {"direction", {light.direction.x(), light.direction.y(), light.direction.z()}},
            {"heldOut", light.heldOut}};
  addFigures(light, hasMask, json);
  return json;
}

std::string row(std::string_view label, std::string_view lights, const PictureError& error,
                std::string_view linear) {
  return fmt::format("{:<28} {:>6} {:>9} {:>8} {:>8} {:>12}\n", label, lights,
                     figureText(error.psnrDecibels, 2), figureText(error.ssim, 4),
                     figureText(100 * error.rms, 2), linear);
}

std::string summaryRows(std::string_view label, const ErrorSummary& summary, bool hasMask) {
  if (summary.lights == 0) return {};
  std::string text = row(label, std::to_string(summary.lights), summary.all,
                         figureText(summary.linearPsnrDecibels, 2));
  if (hasMask) text += row("  inside the mask", "", summary.masked, "");
  return text;
}

std::string worstRows(const Evaluation& evaluation) {
  std::string text;
  const auto order = worstFirst(evaluation);
  for (std::size_t i = 0; i < std::min(kWorstShown, order.size()); ++i) {
    const LightResult& light = evaluation.lights[order[i]];
    text += row("  " + printableName(light.name, kNameWidth - 2), light.heldOut ? "out" : "used",
                light.all, figureText(light.linearPsnrDecibels, 2));
  }
  return text;
}

}  // namespace

std::string figureText(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

std::string printableName(std::string_view name, std::size_t limit) {
  std::string text;
  for (const char character : name) {
    const auto byte = static_cast<unsigned char>(character);
    text += byte < 0x20 || byte == 0x7f ? '?' : character;
  }
  if (text.size() <= limit) return text;
  // Not within a character: UTF-8 continuation bytes are 10xxxxxx.
  std::size_t end = limit - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::vector<std::size_t> worstFirst(const Evaluation& evaluation) {
  std::vector<std::size_t> order(evaluation.lights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return evaluation.lights[a].all.psnrDecibels < evaluation.lights[b].all.psnrDecibels;
  });
  return order;
}

std::string jsonOf(const Evaluation& evaluation) {
  Json json{{"version", kJsonVersion},
            {"bytes", evaluation.bytes},
            {"bitsPerPixel", numberOrNull(evaluation.bitsPerPixel)},
            {"mask", evaluation.hasMask},
            {"used", jsonOf(evaluation.used, evaluation.hasMask)},
            {"heldOut", jsonOf(evaluation.heldOut, evaluation.hasMask)},
            {"lights", Json::array()}};
  for (const LightResult& light : evaluation.lights)
    json["lights"].push_back(jsonOf(light, evaluation.hasMask));
  // Names come from files and need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string tableOf(const Evaluation& evaluation) {
  std::string text = fmt::format("{:<28} {:>6} {:>9} {:>8} {:>8} {:>12}\n", "", "lights", "PSNR dB",
                                 "SSIM", "rms %", "linear dB");
  text += summaryRows("held out", evaluation.heldOut, evaluation.hasMask);
  text += summaryRows("used", evaluation.used, evaluation.hasMask);
  text += "worst lights\n" + worstRows(evaluation);
  text += fmt::format("{} bytes ({}), {:.2f} bits a pixel\n", evaluation.bytes,
                      textFromBytes(evaluation.bytes), evaluation.bitsPerPixel);
  return text;
}

}  // namespace illum
