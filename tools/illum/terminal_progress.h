// A progress bar with the time left, on a terminal and nowhere else.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "illum/progress.h"

namespace illum::cli {

/// Bars go to stderr if that is a terminal; remarks go there always, one line each.
class TerminalProgress final : public Progress {
 public:
  TerminalProgress();
  ~TerminalProgress() override;
  void begin(std::string_view what, std::uint64_t total) override;
  void advance(std::uint64_t steps = 1) override;
  void end() override;
  void remark(std::string_view sentence) override;

 private:
  using Clock = std::chrono::steady_clock;
  void draw(Clock::time_point now);
  void clear();

  std::mutex mutex_;
  bool terminal_, drawn_ = false;
  std::string what_;
  std::uint64_t total_ = 0, done_ = 0;
  Clock::time_point start_, lastDrawn_;
};

}  // namespace illum::cli
