// OpenImageIO, in a library of our own that is loaded when the first picture needs it: some 260
// libraries come with it, which take a third of a second to load.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace illum {

class FilePool;
class PhotographReader;
enum class PhotographFormat;
struct PhotographHeader;

/// A picture for a surface; samples packed, rows from the top.
struct OiioTexture {
  int width = 0, height = 0, channels = 0;
  bool storedAsFloats = false;
  std::vector<float> samples;
};

/// What illum_oiio.so can do. Its functions throw Error like any other; what they return is freed
/// by the caller, for both sides have one C++ library. It is never unloaded.
struct OiioModule {
  const char* build;  ///< stays first, so that another build's can be told

  /// As in capture/oiio_reader.h.
  PhotographHeader (*readHeader)(FilePool& pool, std::size_t file, PhotographFormat format,
                                 std::span<const std::byte> head);
  std::unique_ptr<PhotographReader> (*openReader)(FilePool& pool, std::size_t file,
                                                  const PhotographHeader& header);
  /// As in scene/oiio_texture.h.
  OiioTexture (*readTexture)(std::span<const std::byte> bytes, const std::string& name,
                             const char* reader,
                             const std::function<void(const OiioTexture&)>& checkSize);
};

/// Loads it at the first call; thread safe. `picture` (file or name) and `kind` ("TIFF") are what
/// it is needed for. Throws Error (Fault::Machine) where it, or what it needs, is missing or it is
/// of another build than the program.
const OiioModule& oiioModule(const std::string& picture, std::string_view kind);

/// The functions, or what is wrong with the file, as the end of a sentence.
struct LoadedOiioModule {
  const OiioModule* functions = nullptr;
  std::string fault;
};

/// `file`: a path, or a name that is looked for where the program's link says (RUNPATH).
LoadedOiioModule loadOiioModule(const char* file);

}  // namespace illum
