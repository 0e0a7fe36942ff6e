// A picture opened by OpenImageIO. Only the files whose names begin with oiio_ include it.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "capture/file_pool.h"
#include "capture/photograph_format.h"
#include "capture/sample_type.h"

namespace illum {

/// Rows that are asked for at a time where a file does not say otherwise.
inline constexpr int kOiioRowsPerCall = 16;

/// Reads through the pool, on the calling thread alone.
class OiioPicture {
 public:
  /// Throws Error naming the photograph.
  OiioPicture(FilePool& pool, std::size_t file, PhotographFormat format);
  ~OiioPicture();
  OiioPicture(const OiioPicture&) = delete;
  OiioPicture& operator=(const OiioPicture&) = delete;

  const OIIO::ImageSpec& spec() const { return spec_; }
  OIIO::ImageInput& input() { return *input_; }

  /// Throws what went wrong in the last call, if anything did.
  void check(bool succeeded);

 private:
  class Proxy;
  std::filesystem::path path_;
  PhotographFormat format_;
  std::unique_ptr<Proxy> proxy_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

/// Which of the file's channels are read, in the order of our samples.
struct OiioChannels {
  std::vector<int> channels;
  int colours = 3;
  bool alpha = false;
};

/// Throws Error if there are no colours.
OiioChannels chooseChannels(const OIIO::ImageSpec& spec, PhotographFormat format,
                            const std::filesystem::path& path);

SampleType sampleTypeOf(const OIIO::ImageSpec& spec);
OIIO::TypeDesc typeDescOf(SampleType type);

/// Rows that a file can only be decoded in together; 0 if these are so many that it holds up all
/// others.
int rowsTogether(const OIIO::ImageSpec& spec, PhotographFormat format);

}  // namespace illum
