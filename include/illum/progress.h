// How long work reports how far it is, without knowing whether anybody watches.
#pragma once

#include <cstdint>
#include <string_view>

namespace illum {

/// Receives the progress of long work. Thread safe. The default does nothing.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A new stage of `total` equal steps begins; `what` is a short phrase ("reading 60
  /// photographs").
  virtual void begin(std::string_view what, std::uint64_t total);
  /// `steps` more are done. May throw to leave the work.
  virtual void advance(std::uint64_t steps = 1);
  virtual void end();
  /// One sentence that the user should read (a repair, a doubt, a choice that was made).
  virtual void remark(std::string_view sentence);
};

}  // namespace illum
