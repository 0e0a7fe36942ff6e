// How much of a stack is in memory at a time, decided before anything is decoded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/photograph.h"

namespace illum {

struct BandRequest {
  int rows = 0;                   ///< upright rows that will be read at all
  int rowStep = 8;                ///< a band has a multiple of these
  std::uint64_t memoryBytes = 0;  ///< for everything
  std::uint64_t otherBytes = 0;   ///< of it taken already, by masks and tables
  int threads = 1;
};

struct BandPlan {
  /// Everything is decoded once and stays; otherwise one band of rows of every photograph is there.
  bool whole = false;
  int rows = 0;   ///< of a band; BandRequest::rows if whole
  int lanes = 1;  ///< photographs decoded at a time where decoders do not stay open
  std::uint64_t scratchBytes = 0;   ///< of the scratch file
  std::uint64_t residentBytes = 0;  ///< at the worst moment
};

/// Whether bands of this photograph cannot be had from its decoder, from top to bottom.
bool needsScratch(const Photograph& photograph);

/// Bytes of one upright row.
std::size_t uprightRowBytes(const Photograph& photograph);

/// Throws Error (Fault::Machine) that begins with `source` and tells the least memory if there is
/// too little.
BandPlan planBands(const std::vector<Photograph>& photographs, const BandRequest& request,
                   const std::string& source);

}  // namespace illum
