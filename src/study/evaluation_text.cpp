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

/// The same for each view; its lights in the order of Evaluation::lights.
Json jsonOfViews(const Evaluation& evaluation) {
  Json json = Json::array();
  for (const ViewResult& view : evaluation.views)
    json.push_back({{"name", view.name},
                    {"size", {view.size.width, view.size.height}},
                    {"used", jsonOf(view.used, evaluation.hasMask)},
                    {"heldOut", jsonOf(view.heldOut, evaluation.hasMask)},
                    {"lights", Json::array()}});
  for (const PictureResult& picture : evaluation.pictures) {
    Json figures{{"name", evaluation.lights[static_cast<std::size_t>(picture.light)].name}};
    addFigures(picture, evaluation.hasMask, figures);
    json[static_cast<std::size_t>(picture.view)]["lights"].push_back(std::move(figures));
  }
  return json;
}

bool hasManyViews(const Evaluation& evaluation) {
  return evaluation.views.size() > 1;
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
  const bool views = hasManyViews(evaluation);
  std::string text = views ? "worst pictures\n" : "worst lights\n";
  const auto order = worstFirst(evaluation);
  for (std::size_t i = 0; i < std::min(kWorstShown, order.size()); ++i) {
    const PictureResult& picture = evaluation.pictures[order[i]];
    const LightResult& light = evaluation.lights[static_cast<std::size_t>(picture.light)];
    text += row("  " + printableName(light.name, kNameWidth - 2), light.heldOut ? "out" : "used",
                picture.all, figureText(picture.linearPsnrDecibels, 2));
    if (!views) continue;
    const std::string& view = evaluation.views[static_cast<std::size_t>(picture.view)].name;
    text.insert(text.size() - 1, "  in " + printableName(view, kNameWidth));
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
  std::vector<std::size_t> order(evaluation.pictures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return evaluation.pictures[a].all.psnrDecibels < evaluation.pictures[b].all.psnrDecibels;
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
  if (hasManyViews(evaluation)) json["views"] = jsonOfViews(evaluation);
  // Names come from files and need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string tableOf(const Evaluation& evaluation) {
  const std::string of =
      hasManyViews(evaluation) ? fmt::format("mean of {} views", evaluation.views.size()) : "";
  std::string text = fmt::format("{:<28} {:>6} {:>9} {:>8} {:>8} {:>12}\n", of, "lights", "PSNR dB",
                                 "SSIM", "rms %", "linear dB");
  text += summaryRows("held out", evaluation.heldOut, evaluation.hasMask);
  text += summaryRows("used", evaluation.used, evaluation.hasMask);
  text += worstRows(evaluation);
  text += fmt::format("{} bytes ({}), {:.2f} bits a pixel\n", evaluation.bytes,
                      textFromBytes(evaluation.bytes), evaluation.bitsPerPixel);
  return text;
}

}  // namespace illum
