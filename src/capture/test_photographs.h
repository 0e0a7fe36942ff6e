// Small photographs for the tests of this module, made on the spot.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "capture/sample_type.h"
#include "illum/capture.h"

namespace illum::test {

/// A folder that goes when it is left.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void writeText(const std::string& name, std::string_view text) const;

 private:
  std::filesystem::path path_;
};

using Attribute = std::variant<int, float, std::string, std::vector<std::byte>>;

/// What to write; the file's name says the format.
struct Sketch {
  Size size{23, 17};
  int channels = 3;
  SampleType type = SampleType::Byte;
  /// In [0, 1] for integers: sample of (x, y, channel) of the stored picture.
  std::function<double(int, int, int)> value;
  std::map<std::string, Attribute> attributes;  ///< OpenImageIO's names
};

/// A smooth picture with an edge, different for every `seed`.
double pattern(int seed, int x, int y, int channel);
Sketch sketch(int seed, Size size = {23, 17}, int channels = 3, SampleType type = SampleType::Byte);

void write(const std::filesystem::path& file, const Sketch& sketch);
/// With Adam7. Bytes only.
void writeInterlacedPng(const std::filesystem::path& file, const Sketch& sketch);

/// Without loss, straight alpha, which OpenImageIO does not write. Bytes only.
void writeLosslessWebp(const std::filesystem::path& file, const Sketch& sketch);
/// A binary PPM or PGM with 16 bits a sample, which OpenImageIO does not write.
void writeWordPnm(const std::filesystem::path& file, const Sketch& sketch);

/// Puts an Exif block with an orientation into a PNG or WebP file, and an ICC profile into a WebP
/// file: OpenImageIO writes none there.
void addPngExif(const std::filesystem::path& file, int orientation);
void addWebpChunks(const std::filesystem::path& file, Size size, int orientation,
                   const std::vector<std::byte>& profile);

/// An RGB profile with Rec.709's primaries (or those of Adobe RGB (1998)) and a pure power.
std::vector<std::byte> powerProfile(double gamma, bool adobePrimaries);
/// The profile that most sRGB pictures carry, or lcms's version of it.
std::vector<std::byte> displayProfile();

/// "N\n" and N lines that name `name(i)`, with directions all over the upper hemisphere.
std::string lightFileText(int count, const std::function<std::string(int)>& name);

/// Samples of all lights over a rectangle.
std::vector<float> readAll(const Capture& capture, const Rectangle& rectangle);
std::vector<float> readAll(const Capture& capture);

/// Remembers remarks and stages.
class Listener final : public Progress {
 public:
  void begin(std::string_view what, std::uint64_t total) override;
  void advance(std::uint64_t steps) override;
  void end() override;
  void remark(std::string_view sentence) override;
  std::vector<std::string> remarks, stages;
  std::uint64_t expected = 0, advanced = 0;
  int open = 0;

 private:
  std::mutex mutex_;
};

std::vector<std::byte> bytesOf(const std::filesystem::path& file);
void writeBytes(const std::filesystem::path& file, const std::vector<std::byte>& bytes);

}  // namespace illum::test
