// A made-up evaluation, for tests of what is written about it.
#pragma once

#include <string>
#include <vector>

#include "illum/evaluate.h"

namespace illum {

/// One view under one light for each PSNR, on a ring; every third is held out. Summaries are those
/// of the figures.
inline Evaluation madeUpEvaluation(const std::vector<double>& decibels) {
  Evaluation evaluation;
  const int count = static_cast<int>(decibels.size());
  for (int i = 0; i < count; ++i) {
    LightResult light;
    light.name = "image" + std::to_string(i) + ".jpg";
    light.direction = Direction::fromAngles(0.9, 6.283185307179586 * i / count);
    light.heldOut = i % 3 == 2;
    light.all = {decibels[static_cast<std::size_t>(i)], 0.9, 0.05};
    light.masked = {decibels[static_cast<std::size_t>(i)] - 1, 0.8, 0.06};
    light.linearPsnrDecibels = 33;
    light.linearRms = 0.0224;
    evaluation.lights.push_back(light);
    evaluation.pictures.push_back({light, 0, i});
    ErrorSummary& summary = light.heldOut ? evaluation.heldOut : evaluation.used;
    const double weight = 1.0 / ++summary.lights;
    summary.all.psnrDecibels += weight * (light.all.psnrDecibels - summary.all.psnrDecibels);
    summary.all.ssim = light.all.ssim;
    summary.all.rms = light.all.rms;
    summary.masked = light.masked;
    summary.linearPsnrDecibels = light.linearPsnrDecibels;
    summary.linearRms = light.linearRms;
  }
  evaluation.views.push_back({"front", {40, 30}, evaluation.used, evaluation.heldOut});
  evaluation.bytes = 123456;
  evaluation.bitsPerPixel = 4.5;
  return evaluation;
}

}  // namespace illum
