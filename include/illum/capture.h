// Where samples come from: photographs now, rendered scenes later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "illum/light_file.h"
#include "illum/picture.h"
#include "illum/progress.h"

namespace illum {

/// What the samples of a capture are.
enum class Transfer {
  Linear,   ///< proportional to light
  Display,  ///< sRGB-encoded, in [0, 1] for a well-exposed picture
};

/// Samples under every light, as repeatable random access (group of views, rectangle) -> lights x
/// pixels. Thread safe. A photograph stack has one group of one view.
class Capture {
 public:
  virtual ~Capture() = default;

  virtual Size size() const = 0;
  virtual Transfer transfer() const = 0;
  /// In the order of the light file. A sample is what the photograph shows divided by the
  /// intensity.
  virtual const std::vector<LightFileEntry>& lights() const = 0;
  virtual int groups() const { return 1; }
  virtual bool hasMask() const = 0;

  /// samples[(3*l + c) * rectangle.pixels() + y * width + x], l-th of `lights` (indices), channel
  /// c. Unmasked (not premultiplied). Throws Error naming the photograph.
  virtual void read(int group, const Rectangle& rectangle, std::span<const int> lights,
                    std::span<float> samples) const = 0;
  /// Coverage in [0, 1], rectangle.pixels() values.
  virtual void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const = 0;

  /// Rows that one sequential pass reads at once most cheaply: readers go down the picture in steps
  /// of this, whole width. size().height where order and height do not matter.
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
