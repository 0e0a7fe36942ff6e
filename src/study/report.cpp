#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/data_uri.h"
#include "core/memory.h"
#include "illum/evaluate.h"
#include "illum/picture_io.h"
#include "object/manifest.h"
#include "study/comparison.h"
#include "study/drawings.h"
#include "study/evaluation_text.h"
#include "study/html_text.h"
#include "study/report_pictures.h"
#include "study/report_style.h"

namespace illum {
namespace {

constexpr std::size_t kShown = 3;
constexpr int kJpegQuality = 88;

std::string_view nameOf(Response response) {
  switch (response) {
    case Response::Linear:
      return "linear light";
    case Response::Display:
      return "display-referred";
    case Response::Cone:
      return "non-negative linear light";
  }
  return "";
}

std::string counted(int count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

bool hasManyViews(const Evaluation& evaluation) {
  return evaluation.views.size() > 1;
}

const LightResult& lightOf(const Evaluation& evaluation, const PictureResult& picture) {
  return evaluation.lights[static_cast<std::size_t>(picture.light)];
}

const ViewResult& viewOf(const Evaluation& evaluation, const PictureResult& picture) {
  return evaluation.views[static_cast<std::size_t>(picture.view)];
}

std::string sizeText(Size size) {
  return fmt::format("{} × {}", size.width, size.height);
}

/// The size of the views, or that of the smallest and the largest.
std::string sizesText(const Evaluation& evaluation) {
  const auto [least, most] = std::minmax_element(
      evaluation.views.begin(), evaluation.views.end(),
      [](const auto& a, const auto& b) { return a.size.pixels() < b.size.pixels(); });
  const std::string low = sizeText(least->size), high = sizeText(most->size);
  return low == high ? low : low + " to " + high;
}

std::string header(const Object& object, const Evaluation& evaluation) {
  const Manifest& manifest = object.manifest();
  const std::string name = object.path().filename().string();
  std::string about =
      fmt::format("{} pixels · {}", sizesText(evaluation), counted(object.planes(), "plane"));
  if (hasManyViews(evaluation))
    about = fmt::format("{} views of {}", evaluation.views.size(), about);
  for (const BasisEntry& basis : manifest.bases) about += " · basis " + basis.name;
  about += fmt::format(" · {}, {} bits, {} · judged under {}", nameOf(manifest.coding().coding),
                       manifest.coding().bits, nameOf(manifest.response),
                       counted(static_cast<int>(evaluation.lights.size()), "light"));
  return "<h1>" + htmlText(name) + "</h1>\n<p class=\"quiet\">" + htmlText(about) + "</p>\n";
}

std::string stat(std::string_view value, std::string_view unit, std::string_view label) {
  return fmt::format(R"(<div class="stat"><b>{} <small>{}</small></b><span>{}</span></div>)", value,
                     unit, label) +
         "\n";
}

/// What matters most, large: what the object does with light that it never saw.
std::string stats(const Evaluation& evaluation) {
  std::string html = "<div class=\"stats\">\n";
  const auto psnr = [&](const ErrorSummary& summary, std::string_view label) {
    if (summary.lights == 0) return;
    html += stat(figureText(summary.all.psnrDecibels, 2), "dB",
                 fmt::format("PSNR, {} {}", counted(summary.lights, "light"), label));
  };
  psnr(evaluation.heldOut, "held out");
  psnr(evaluation.used, "used");
  const bool any = evaluation.heldOut.lights > 0;
  const ErrorSummary& first = any ? evaluation.heldOut : evaluation.used;
  html += stat(figureText(first.all.ssim, 3), "", any ? "SSIM, held out" : "SSIM, used");
  html += stat(textFromBytes(evaluation.bytes), "",
               fmt::format("{} bits a pixel", figureText(evaluation.bitsPerPixel, 2)));
  return html + "</div>\n";
}

std::string cells(const PictureError& error) {
  return fmt::format("<td>{}</td><td>{}</td><td>{}</td>", figureText(error.psnrDecibels, 2),
                     figureText(error.ssim, 4), figureText(100 * error.rms, 2));
}

std::string summaryRow(std::string_view label, const ErrorSummary& summary, bool hasMask) {
  if (summary.lights == 0) return {};
  std::string row =
      fmt::format("<tr><td>{}</td><td>{}</td>{}<td>{}</td></tr>\n", label, summary.lights,
                  cells(summary.all), figureText(summary.linearPsnrDecibels, 2));
  if (hasMask)
    row += fmt::format("<tr><td>{}, inside the mask</td><td></td>{}<td></td></tr>\n", label,
                       cells(summary.masked));
  return row;
}

std::string summaryTable(const Evaluation& evaluation) {
  return "<div class=\"scroll\"><table>\n<tr><th></th><th>lights</th><th>PSNR, dB</th><th>SSIM</th>"
         "<th>rms, %</th><th>linear PSNR, dB</th></tr>\n" +
         summaryRow("Held out", evaluation.heldOut, evaluation.hasMask) +
         summaryRow("Used", evaluation.used, evaluation.hasMask) + "</table></div>\n";
}

std::string lightSection(const Evaluation& evaluation) {
  const bool behind = std::any_of(evaluation.lights.begin(), evaluation.lights.end(),
                                  [](const LightResult& light) { return light.direction.z() < 0; });
  std::string html = fmt::format("<h2>Every light</h2>\n<div class=\"lights{}\">\n<div>{}</div>\n",
                                 behind ? " both" : "", domeDrawing(evaluation));
  html +=
      "<div><p>Where each light stood, seen from the camera; the outer circle is the horizon, "
      "the inner ones 30° and 60° above it.</p>\n" +
      rampLegend(evaluation);
  if (evaluation.heldOut.lights > 0)
    html +=
        "<p><svg class=\"key\" viewBox=\"0 0 240 24\"><circle class=\"ring\" cx=\"10\" cy=\"12\" "
        "r=\"7\"/><text x=\"26\" y=\"16\">held out: never seen by the fit</text></svg></p>\n";
  return html + "</div></div>\n" +
         "<p class=\"quiet\" style=\"margin-top:24px\">PSNR in decibels, in the order of the light "
         "file" +
         (hasManyViews(evaluation) ? ", each the mean over the views" : "") + "</p>\n" +
         "<div class=\"scroll\">" + lightPlot(evaluation) + "</div>\n";
}

std::string imageTag(const BytePicture& picture, std::string_view caption) {
  return fmt::format(
             R"(<figure><img width="{}" height="{}" alt="{}" src="{}"><figcaption>{}</figcaption></figure>)",
             picture.width(), picture.height(), caption,
             dataUri("image/jpeg", encodeJpeg(picture, kJpegQuality)), caption) +
         "\n";
}

/// Height above the picture's plane, and the way around it from the right over the top, below 360.
std::string directionText(Direction direction) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const double azimuth = std::round(kDegrees * direction.phiRadians());
  return fmt::format("elevation {:.0f}°, azimuth {:.0f}°", 90 - kDegrees * direction.thetaRadians(),
                     azimuth < 0 ? azimuth + 360 : azimuth);
}

/// Photograph, relit picture and error, side by side.
std::string trio(const Evaluation& evaluation, const PictureResult& picture,
                 const ReportPictures& pictures) {
  const LightResult& light = lightOf(evaluation, picture);
  const std::string view =
      hasManyViews(evaluation)
          ? "<span>view " + htmlText(viewOf(evaluation, picture).name) + "</span>"
          : "";
  std::string html = fmt::format(
      "<section class=\"trio\">\n<header><b>{}</b>{}<span>{} dB</span><span>SSIM {}</span>"
      "<span class=\"quiet\">{}</span>{}</header>\n",
      htmlText(light.name), view, figureText(picture.all.psnrDecibels, 2),
      figureText(picture.all.ssim, 3), directionText(light.direction),
      light.heldOut ? "<span class=\"tag\">held out</span>" : "");
  html += imageTag(pictures.photograph, "Photograph") + imageTag(pictures.relit, "Relit") +
          imageTag(pictures.error, fmt::format("Error × {}", kErrorGain));
  return html + "</section>\n";
}

/// The worst pictures, then the best of the others, best first: indices.
std::vector<std::size_t> picturesToShow(const Evaluation& evaluation) {
  const std::vector<std::size_t> order = worstFirst(evaluation);
  const std::size_t worst = std::min(kShown, order.size());
  const std::size_t best = std::min(kShown, order.size() - worst);
  std::vector<std::size_t> shown(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(worst));
  shown.insert(shown.end(), order.rbegin(), order.rbegin() + static_cast<std::ptrdiff_t>(best));
  return shown;
}

/// Makes the pictures of all that are shown, reading no view more than once.
class ShownPictures {
 public:
  ShownPictures(const Object& object, const Capture& truth, std::uint64_t memoryBytes)
      : object_(object),
        truth_(truth),
        views_(comparableViews(object, truth)),
        memoryBytes_(memoryBytes) {}

  std::vector<ReportPictures> of(const Evaluation& evaluation,
                                 const std::vector<std::size_t>& shown) const {
    std::vector<ReportPictures> pictures(shown.size());
    for (std::size_t view = 0; view < views_.size(); ++view) {
      std::vector<std::size_t> places;
      std::vector<int> lights;
      for (std::size_t i = 0; i < shown.size(); ++i) {
        const PictureResult& picture = evaluation.pictures[shown[i]];
        if (picture.view != static_cast<int>(view)) continue;
        places.push_back(i);
        lights.push_back(picture.light);
      }
      if (lights.empty()) continue;
      const Comparison comparison(object_, truth_, views_[view], memoryBytes_);
      std::vector<ReportPictures> made = reportPictures(comparison, lights);
      for (std::size_t i = 0; i < places.size(); ++i) pictures[places[i]] = std::move(made[i]);
    }
    return pictures;
  }

 private:
  const Object& object_;
  const Capture& truth_;
  std::vector<ViewPair> views_;
  std::uint64_t memoryBytes_;
};

std::string pictureSections(const ShownPictures& source, const Evaluation& evaluation) {
  const std::vector<std::size_t> shown = picturesToShow(evaluation);
  const std::vector<ReportPictures> pictures = source.of(evaluation, shown);
  const std::string_view what = hasManyViews(evaluation) ? "pictures" : "lights";
  std::string html =
      shown.size() == 1 ? "<h2>The light</h2>\n" : fmt::format("<h2>Worst {}</h2>\n", what);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (i == kShown) html += fmt::format("<h2>Best {}</h2>\n", what);
    html += trio(evaluation, evaluation.pictures[shown[i]], pictures[i]);
  }
  return html;
}

std::string viewRow(const ViewResult& view, const Evaluation& evaluation) {
  std::string row =
      fmt::format("<tr><td>{}</td><td>{}</td>", htmlText(view.name), sizeText(view.size));
  for (const ErrorSummary* summary : {&view.heldOut, &view.used}) {
    if (summary->lights == 0) continue;
    row += cells(summary->all);
    if (evaluation.hasMask) row += "<td>" + figureText(summary->masked.psnrDecibels, 2) + "</td>";
  }
  return row + "</tr>\n";
}

std::string viewTable(const Evaluation& evaluation) {
  if (!hasManyViews(evaluation)) return {};
  std::string html =
      "<details><summary>Every view</summary>\n<div class=\"scroll\"><table>\n<tr><th>view</th>"
      "<th>pixels</th>";
  const auto columns = [&](const ErrorSummary& summary, std::string_view which) {
    if (summary.lights == 0) return;
    html += fmt::format("<th>{0}: PSNR, dB</th><th>SSIM</th><th>rms, %</th>", which);
    if (evaluation.hasMask) html += "<th>PSNR in mask, dB</th>";
  };
  columns(evaluation.heldOut, "held out");
  columns(evaluation.used, "used");
  html += "</tr>\n";
  for (const ViewResult& view : evaluation.views) html += viewRow(view, evaluation);
  return html + "</table></div></details>\n";
}

std::string lightTable(const Evaluation& evaluation) {
  std::string html = hasManyViews(evaluation)
                         ? "<details><summary>Every light, the mean over the views</summary>"
                         : "<details><summary>All figures</summary>";
  html +=
      "\n<div class=\"scroll\"><table>\n<tr><th>light</th>"
      "<th>x</th><th>y</th><th>z</th><th></th><th>PSNR, dB</th><th>SSIM</th><th>rms, %</th>"
      "<th>linear PSNR, dB</th>";
  html += evaluation.hasMask ? "<th>PSNR in mask, dB</th></tr>\n" : "</tr>\n";
  for (const LightResult& light : evaluation.lights) {
    html += fmt::format(
        "<tr><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{}</td>{}"
        "<td>{}</td>",
        htmlText(light.name), light.direction.x(), light.direction.y(), light.direction.z(),
        light.heldOut ? "held out" : "", cells(light.all), figureText(light.linearPsnrDecibels, 2));
    if (evaluation.hasMask) html += "<td>" + figureText(light.masked.psnrDecibels, 2) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table></div></details>\n";
}

/// What the object says about how it was made.
std::string provenance(const Manifest& manifest) {
  if (manifest.provenance.empty()) return {};
  std::string html = "<details><summary>How the object was made</summary>\n<table>\n";
  for (const auto& [key, value] : manifest.provenance)
    html += "<tr><td>" + htmlText(key) + "</td><td>" + htmlText(value) + "</td></tr>\n";
  return html + "</table></details>\n";
}

std::string footer(const Evaluation& evaluation) {
  const bool views = hasManyViews(evaluation);
  return fmt::format(
      "<footer>PSNR, SSIM and rms compare the 8-bit sRGB pictures, per {} over all pixels and "
      "channels; a row is the mean over its {}. SSIM after Wang et al. 2004 on luma. rms is in "
      "per cent of white. Linear PSNR compares unclamped linear light with a peak of 1. The bytes "
      "are those of the whole file. Pictures are reduced to fit; errors are enlarged.</footer>\n",
      views ? "view and light" : "light", views ? "views and lights" : "lights");
}

}  // namespace

std::string htmlReport(const Object& object, const Capture& truth, const Evaluation& evaluation,
                       std::uint64_t memoryBytes) {
  const ShownPictures pictures(object, truth, memoryBytes);
  const std::string title = htmlText(object.path().filename().string());
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += "<title>" + title + " · evaluation</title>\n<style>" + std::string(kReportStyle) +
          "</style>\n</head>\n<body>\n";
  html += header(object, evaluation) + stats(evaluation) + summaryTable(evaluation) +
          lightSection(evaluation) + pictureSections(pictures, evaluation) + viewTable(evaluation) +
          lightTable(evaluation) + provenance(object.manifest()) + footer(evaluation);
  return html + "</body>\n</html>\n";
}

}  // namespace illum
