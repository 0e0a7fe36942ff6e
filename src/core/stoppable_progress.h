// Long work that its user may stop.
#pragma once

#include <functional>

#include "illum/progress.h"

namespace illum {

/// Leaves work that the user stopped.
struct Stopped {};

/// Asks, wherever progress is reported, whether the user wants to stop; then throws Stopped.
class StoppableProgress final : public Progress {
 public:
  /// Both must outlive it; an empty `stop` never stops.
  StoppableProgress(Progress& inner, const std::function<bool()>& stop)
      : inner_(inner), stop_(stop) {}

  void begin(std::string_view what, std::uint64_t total) override { inner_.begin(what, total); }
  void advance(std::uint64_t steps) override {
    inner_.advance(steps);
    check();
  }
  void end() override { inner_.end(); }
  void remark(std::string_view sentence) override { inner_.remark(sentence); }

  /// Where there is no progress to tell of for long.
  void check() const {
    if (stop_ && stop_()) throw Stopped();
  }

 private:
  Progress& inner_;
  const std::function<bool()>& stop_;
};

}  // namespace illum
