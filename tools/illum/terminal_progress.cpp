#include "terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace illum::cli {
namespace {

constexpr auto kPatience = std::chrono::seconds(1);  // what is shorter shows no bar
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr int kBarWidth = 24;

std::string timeText(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace

TerminalProgress::TerminalProgress() : terminal_(isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() {
  clear();
}

void TerminalProgress::begin(std::string_view what, std::uint64_t total) {
  const std::scoped_lock lock(mutex_);
  clear();
  what_ = what;
  total_ = std::max<std::uint64_t>(1, total);
  done_ = 0;
  start_ = lastDrawn_ = Clock::now();
}

void TerminalProgress::advance(std::uint64_t steps) {
  const std::scoped_lock lock(mutex_);
  done_ = std::min(total_, done_ + steps);
  const auto now = Clock::now();
  if (terminal_ && now - start_ >= kPatience && now - lastDrawn_ >= kRedraw) draw(now);
}

void TerminalProgress::end() {
  const std::scoped_lock lock(mutex_);
  clear();
}

void TerminalProgress::remark(std::string_view sentence) {
  const std::scoped_lock lock(mutex_);
  clear();
  fmt::print(stderr, "illum: note: {}\n", sentence);
}

void TerminalProgress::draw(Clock::time_point now) {
  lastDrawn_ = now;
  drawn_ = true;
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const double spent = std::chrono::duration<double>(now - start_).count();
  const int filled = static_cast<int>(share * kBarWidth);
  const std::string left =
      done_ == 0 ? std::string("…") : timeText(spent * (1 - share) / share) + " left";
  fmt::print(stderr, "\r\x1b[K{} [{:=<{}}{:<{}}] {:3.0f} %, {}", what_, "", filled, "",
             kBarWidth - filled, 100 * share, left);
  std::fflush(stderr);
}

void TerminalProgress::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace illum::cli
