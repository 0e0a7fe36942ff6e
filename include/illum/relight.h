// Relighting an opened object on the CPU: the reference to which every other path is held.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "illum/light.h"
#include "illum/lighting.h"
#include "illum/object.h"
#include "illum/picture.h"

namespace illum {

/// Lights made ready for one group of views: what is computed once, whatever is relit under them
/// then. Cheap to copy; thread safe.
class PreparedLights {
 public:
  int group() const;
  /// How often each texel's planes are gone through for lights at infinity: once where the response
  /// is linear, else once for each directional light and each direction of an environment.
  int passes() const;
  /// The greatest error that an environment is left with, as PrepareOptions::environmentError:
  /// above that one where 1024 directions do not suffice. 0 where the response is linear.
  double environmentError() const;

 private:
  friend class Relighter;
  struct State;
  explicit PreparedLights(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// How lights are made ready.
struct PrepareOptions {
  /// Where a photograph's pixels lie for lights near the object: z in units of the object, in
  /// channel 0 of a picture of the photograph's size. Empty: the plane z = 0.
  std::shared_ptr<const Picture> heights;
  /// Where the response is not linear, an environment becomes about as few directional lights as
  /// keep the picture's rms error under this share of its rms, at most 1024. The error is measured
  /// on a thousand texels against a cut of 4096 regions.
  double environmentError = 0.005;
};

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

  /// Makes lights of all kinds ready for a group of views. Where the response is linear, all lights
  /// at infinity together, environments among them, then cost what one costs.
  PreparedLights prepare(const Illumination& lights, int group = 0,
                         const PrepareOptions& options = {}) const;
  /// The same lights for another group: at no cost where its frame is turned as that of `lights`'s
  /// group, as in a slab, whatever shines. Heights are left behind.
  PreparedLights prepareAlso(const PreparedLights& lights, int group) const;
  /// As above, of the group that the lights were prepared for.
  Picture relight(const PreparedLights& lights, int level = 0) const;
  Picture relightRegion(const PreparedLights& lights, const Rectangle& region, int level = 0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum
