// Relighting an opened object on the CPU: the reference to which every other path is held.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "illum/light.h"
#include "illum/object.h"
#include "illum/picture.h"

namespace illum {

/// Relights views of one object, keeping decoded tiles. Thread safe.
class Relighter {
 public:
  /// `memoryBytes` bounds the decoded tiles that are kept; more are decoded again when needed.
  explicit Relighter(Object object, std::uint64_t memoryBytes = std::uint64_t{1} << 30);
  ~Relighter();

  /// Linear light, RGB, or RGBA premultiplied if the object has a mask. Exact superposition: each
  /// light passes the object's response by itself unless the response is linear. No clamp, no
  /// exposure. Lights are
  /// given in the object frame, whatever the group's is.
  Picture relight(std::span<const DirectionalLight> lights, int group = 0, int level = 0) const;
  /// The same of `region`, a rectangle within that level, alone; only tiles that it touches are
  /// decoded.
  Picture relightRegion(std::span<const DirectionalLight> lights, const Rectangle& region,
                        int group = 0, int level = 0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum
