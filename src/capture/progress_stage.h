// A stage of progress that ends however it is left.
#pragma once

#include <cstdint>
#include <string_view>

#include "illum/progress.h"

namespace illum {

class ProgressStage {
 public:
  ProgressStage(Progress& progress, std::string_view what, std::uint64_t total)
      : progress_(progress) {
    progress_.begin(what, total);
  }
  ~ProgressStage() { progress_.end(); }
  ProgressStage(const ProgressStage&) = delete;
  ProgressStage& operator=(const ProgressStage&) = delete;

 private:
  Progress& progress_;
};

}  // namespace illum
