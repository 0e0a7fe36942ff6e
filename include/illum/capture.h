// Where samples come from: photographs, or scenes that are rendered.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "illum/camera.h"
#include "illum/light_file.h"
#include "illum/picture.h"
#include "illum/progress.h"

namespace illum {

/// What the samples of a capture are.
enum class Transfer {
  Linear,   ///< proportional to light
  Display,  ///< sRGB-encoded, in [0, 1] for a well-exposed picture
};

/// Samples that are bytes as they were stored, where all of a capture's are: b for b / 255. A
/// quarter of the memory that floats take.
class ByteSamples {
 public:
  virtual ~ByteSamples() = default;
  /// As Capture::read.
  virtual void readBytes(int group, const Rectangle& rectangle, std::span<const int> lights,
                         std::span<std::uint8_t> samples) const = 0;
};

/// Samples under every light, as repeatable random access (group of views, rectangle) -> lights x
/// pixels. Thread safe. Every view is a group of its own; a stack of photographs has one.
class Capture {
 public:
  virtual ~Capture() = default;

  /// At least one, each name once. Kinds of geometry and sizes may differ; a photograph is alone.
  virtual const std::vector<View>& views() const = 0;
  int groups() const { return static_cast<int>(views().size()); }
  /// Of one view, in pixels.
  Size size(int group = 0) const {
    return sizeOf(views().at(static_cast<std::size_t>(group)).geometry);
  }

  virtual Transfer transfer() const = 0;
  /// In the order of the light file, directions in the object frame. A sample is what the
  /// photograph shows divided by the intensity.
  virtual const std::vector<LightFileEntry>& lights() const = 0;
  virtual bool hasMask() const = 0;
  virtual bool hasDepth() const { return false; }
  /// Whether samples are computed when they are read: each read costs far more than decoding would,
  /// so nothing should be read twice that need not be. Reads may then come in any order.
  virtual bool isRendered() const { return false; }

  /// samples[(3*l + c) * rectangle.pixels() + y * width + x], l-th of `lights` (indices), channel
  /// c. Unmasked (not premultiplied). Throws Error naming the photograph.
  virtual void read(int group, const Rectangle& rectangle, std::span<const int> lights,
                    std::span<float> samples) const = 0;
  /// The same samples as bytes; null where they are not bytes. Lives as long as the capture.
  virtual const ByteSamples* bytes() const { return nullptr; }
  /// Coverage in [0, 1], rectangle.pixels() values.
  virtual void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const = 0;
  /// Depth as camera.h's depthOf, rectangle.pixels() values; infinity where nothing is. Only where
  /// hasDepth().
  virtual void readDepth([[maybe_unused]] int group, [[maybe_unused]] const Rectangle& rectangle,
                         std::span<float> depth) const {
    std::fill(depth.begin(), depth.end(), std::numeric_limits<float>::infinity());
  }

  /// Rows that one sequential pass reads at once most cheaply: readers go down the picture in steps
  /// of this, whole width. At least the height of every view where order and height do not matter.
  virtual int bandRows() const = 0;
  /// Bytes that this capture holds by itself while it is read.
  virtual std::uint64_t residentBytes() const = 0;

  /// Identifies content and options, for resuming: equal text = equal samples.
  virtual std::string fingerprint() const = 0;
};

struct PhotographOptions {
  std::filesystem::path lightFile;   ///< empty: the one in the folder
  std::filesystem::path mask;        ///< empty: alpha channels if there are any
  std::optional<Rectangle> crop;     ///< of the upright photograph, before scaling
  int shrink = 1;                    ///< box-filtered by this whole factor in linear light, >= 1
  std::optional<Transfer> transfer;  ///< what the files' values are; default by format and profile
  std::uint64_t memoryBytes = 0;     ///< what the capture may hold; 0 = a quarter of the machine
  std::filesystem::path scratch;     ///< folder for a scratch file, where one is needed
};

/// A folder of photographs with a light file. Names in the light file decide which photograph is
/// meant (case and extension are forgiven with a remark; order never is). Throws Error.
std::unique_ptr<Capture> openPhotographs(const std::filesystem::path& folder,
                                         const PhotographOptions& options, Progress& progress);

}  // namespace illum
