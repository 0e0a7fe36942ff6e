// One photograph: what its file says of it, and its rows one after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "capture/file_pool.h"
#include "capture/orientation.h"
#include "capture/photograph_format.h"
#include "capture/sample_type.h"
#include "illum/capture.h"

namespace illum {

/// What a photograph's file says before its pixels are decoded.
struct PhotographHeader {
  PhotographFormat format = PhotographFormat::Jpeg;
  Size stored;  ///< as in the file, before the orientation is applied
  Orientation orientation;
  int colours = 3;     ///< 1 grey or 3 RGB
  bool alpha = false;  ///< a further channel: coverage; the colours are not premultiplied by it
  SampleType type = SampleType::Byte;
  Transfer transfer = Transfer::Display;  ///< of the samples, where no profile tells otherwise
  double gamma = 0;                ///< > 0: light = sample^gamma instead of the sRGB function
  std::vector<std::byte> profile;  ///< embedded ICC profile; empty if there is none
  /// Rows can be decoded one after another from little memory. Otherwise opening decodes all of
  /// them.
  bool sequential = true;
  std::uint64_t decoderBytes = 0;  ///< what an opened reader holds, at its worst

  int channels() const { return colours + (alpha ? 1 : 0); }
  Size upright() const { return orientation.upright(stored); }
  std::size_t rowBytes() const {
    return static_cast<std::size_t>(stored.width) * static_cast<std::size_t>(channels()) *
           bytesOf(type);
  }
};

/// Decodes one photograph from its first stored row to its last. One thread at a time.
class PhotographReader {
 public:
  virtual ~PhotographReader() = default;

  /// The next `rows` rows, packed, as PhotographHeader says; no more than are left. Throws Error
  /// naming the photograph; the reader is of no use afterwards.
  virtual void read(int rows, std::byte* samples) = 0;
};

/// The header of a file of the pool. Formats whose reader decodes everything at once are refused
/// when that would take more than `memoryBytes`. Untrusted input is safe. Throws Error.
PhotographHeader readHeader(FilePool& pool, std::size_t file, std::uint64_t memoryBytes);

/// A reader at row 0. `pool` must outlive it. Throws Error.
std::unique_ptr<PhotographReader> openReader(FilePool& pool, std::size_t file,
                                             const PhotographHeader& header);

}  // namespace illum
