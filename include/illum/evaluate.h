// Judging an object against the photographs (docs/quality.md says how the figures are defined).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "illum/capture.h"
#include "illum/object.h"
#include "illum/progress.h"

namespace illum {

/// Error measures of one picture against the truth, over 8-bit sRGB at exposure 0 unless said
/// otherwise.
struct PictureError {
  double psnrDecibels = 0;  ///< over all pixels and channels, peak 255; 99 for identical pictures
  double ssim = 0;  ///< Wang et al. 2004 on luma, Gaussian window 11x11, sigma 1.5; in [-1, 1]
  double rms = 0;   ///< in units of the peak (0 … 1)
};

/// All that is said of a picture, or the mean of it over pictures. NaN for what does not exist.
struct Figures {
  PictureError all;
  PictureError masked;   ///< pixels with coverage > 1/2 only; meaningful if Evaluation::hasMask
  double linearRms = 0;  ///< unclamped linear light
  double linearPsnrDecibels = 0;  ///< peak 1
};

/// One view under one light.
struct PictureResult : Figures {
  int view = 0, light = 0;  ///< indices of Evaluation::views and ::lights
};

/// One light: the mean over views.
struct LightResult : Figures {
  std::string name;
  Direction direction;
  bool heldOut = false;
};

/// Means over pictures (the mean of each picture's figure, as in the literature).
struct ErrorSummary : Figures {
  int lights = 0;
};

/// One view: the means over lights.
struct ViewResult {
  std::string name;
  Size size;
  ErrorSummary used, heldOut;
};

struct Evaluation {
  std::vector<LightResult> lights;      ///< in the order of the light file
  std::vector<ViewResult> views;        ///< in the order of the capture
  std::vector<PictureResult> pictures;  ///< view by view, each under every light
  ErrorSummary used, heldOut;  ///< of the lights the object was fitted to, and of those left out
  bool hasMask = false;
  std::uint64_t bytes = 0;  ///< of the whole file
  double bitsPerPixel = 0;  ///< of all views that the object has
};

PictureError comparePictures(const BytePicture& picture, const BytePicture& truth);

/// Relights `object` under every light of `truth`, in each view of `truth` what the object shows in
/// its view of the same name, and compares. Lights that the object's fit saw are used, all others
/// held out (docs/quality.md). Reads the capture once, view by view from top to bottom.
/// `memoryBytes`: what it may hold together with the capture (and exceeds only where a single light
/// needs more); 0 = a quarter of the machine. Throws Error (Fault::Input) if the object lacks a
/// view or has it in another size or place.
Evaluation evaluate(const Object& object, const Capture& truth, Progress& progress,
                    std::uint64_t memoryBytes = 0);

/// Stable machine-readable form (docs/guide/evaluate.md), and a table for people.
std::string jsonOf(const Evaluation& evaluation);
std::string tableOf(const Evaluation& evaluation);

/// A self-contained HTML page: summary, table, the dome of light directions coloured by error,
/// worst and best pictures side by side with the photograph and the error (times 8).
std::string htmlReport(const Object& object, const Capture& truth, const Evaluation& evaluation,
                       std::uint64_t memoryBytes = 0);

}  // namespace illum
