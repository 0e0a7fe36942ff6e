// The photographs of a stack that cannot be read band by band, decoded and turned into bands on
// disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "capture/band_plan.h"
#include "capture/file_pool.h"
#include "capture/photograph.h"
#include "capture/scratch_file.h"

namespace illum {

/// Band after band, in each the photographs one after another, in each its upright rows: reading a
/// band is reading one stretch of the file. Thread safe for different photographs.
class ScratchStack {
 public:
  /// Takes those of `photographs` that needsScratch(). `rows`: that are read at all.
  ScratchStack(const std::filesystem::path& folder, const std::vector<Photograph>& photographs,
               int rows, const BandPlan& plan);

  std::size_t count() const { return count_; }

  /// Decodes photograph `i`; `top` is the upright row that is row 0 here. Throws Error.
  void fill(std::size_t i, FilePool& pool, const Photograph& photograph, int top);

  /// `count` rows of one band, which begins at `firstRow`.
  void read(std::size_t i, int firstRow, int count, std::byte* samples) const;

 private:
  void fillInOrder(std::size_t i, PhotographReader& reader, int top);
  void fillTurned(std::size_t i, PhotographReader& reader, const Photograph& photograph, int top);
  void writeRows(std::size_t i, int firstRow, int count, const std::byte* samples);
  std::uint64_t placeOf(std::size_t i, int row) const;

  int rows_, bandRows_;
  std::size_t count_ = 0;
  std::vector<std::size_t> rowBytes_;       // of every photograph; 0: not here
  std::vector<std::uint64_t> offsetOfRow_;  // of a photograph within a band, for bands of one row
  std::uint64_t bandBytes_ = 0;
  ScratchFile file_;
};

}  // namespace illum
