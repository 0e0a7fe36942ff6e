// How much of a view is made at a time, decided before anything is decoded.
#pragma once

#include <cstdint>
#include <span>

#include "object/manifest.h"

namespace illum {

struct ConversionMemory {
  int planesAtOnce = 0;         ///< of a new view; views are decoded again for each such part
  std::uint64_t viewBytes = 0;  ///< of decoded views that are kept
  int tilesDecoded = 1;         ///< side by side
  int tilesCoded = 1;
};

/// For views of `manifest`, the new object's: `planesOfBases` of each basis, `newViews` whether any
/// is made and not copied. Throws Error (Fault::Machine) that tells the least memory if there is
/// too little.
ConversionMemory planConversion(const Manifest& manifest, std::span<const int> planesOfBases,
                                bool newViews, std::uint64_t memoryBytes, int threads);

}  // namespace illum
