// A photograph of a stack: its header and what its samples become.
#pragma once

#include <memory>

#include "capture/colour_profile.h"
#include "capture/photo_reader.h"

namespace illum {

struct Photograph {
  std::size_t file = 0;  ///< in the pool
  PhotographHeader header;
  ProfiledColour colour;

  std::size_t pixelBytes() const {
    return static_cast<std::size_t>(header.channels()) * bytesOf(colour.type);
  }
  std::size_t rowBytes() const {
    return static_cast<std::size_t>(header.stored.width) * pixelBytes();
  }
  /// All of it, decoded.
  std::uint64_t bytes() const {
    return std::uint64_t{rowBytes()} * static_cast<unsigned>(header.stored.height);
  }
  /// What decoding it holds besides its result.
  std::uint64_t decoderBytes() const;
};

/// A reader whose rows have gone through the colour conversion and are finite. `pool` must outlive
/// it, the photograph too. Throws Error naming the photograph, and the pixel that is not finite.
std::unique_ptr<PhotographReader> openPhotograph(FilePool& pool, const Photograph& photograph);

}  // namespace illum
