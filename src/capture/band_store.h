// The decoded rows of a stack that are in memory: all of them, or one band at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "capture/band_plan.h"
#include "capture/file_pool.h"
#include "capture/photograph.h"
#include "illum/progress.h"

namespace illum {

/// Samples of one photograph: the first one wanted, and how far its neighbours are.
struct PixelRun {
  const std::byte* first = nullptr;
  std::ptrdiff_t step = 0;  ///< bytes from a pixel to the one at its right in the upright picture
};

/// Decodes what is asked for when it is asked for. Thread safe: threads that wait for a band help
/// to decode it.
///
/// Bands are meant to be read from top to bottom. Going on to a later band continues the decoders;
/// going back restarts them.
class BandStore {
 public:
  /// `top`: the upright row that is row 0 here; `scratch`: a folder for the scratch file. `pool`
  /// and `progress` must outlive the store.
  BandStore(FilePool& pool, std::vector<Photograph> photographs, int top, int rows,
            const BandPlan& plan, std::filesystem::path scratch, Progress& progress);
  ~BandStore();

  /// Keeps one band in memory.
  class Pin {
   public:
    ~Pin();
    Pin(const Pin&) = delete;
    Pin& operator=(const Pin&) = delete;

    int firstRow() const { return firstRow_; }
    int endRow() const { return endRow_; }
    /// The pixel (x, y) of a photograph; firstRow() <= y < endRow(), x of the whole upright
    /// picture.
    PixelRun at(std::size_t photograph, int x, int y) const;

   private:
    friend class BandStore;
    Pin(const BandStore& store, int band);
    const BandStore& store_;
    int firstRow_, endRow_;
  };

  /// The band that holds `row`, decoded if it is not there yet. A thread must not ask for a second
  /// one while it keeps one. Throws Error naming the photograph.
  Pin pin(int row) const;

  const std::vector<Photograph>& photographs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum
