// Views that nobody took, made of views that somebody did: light slabs (Levoy and Hanrahan 1996),
// their depth correction (Gortler et al. 1996), cameras anywhere (Buehler et al. 2001). The
// mathematics is in docs/math/view_synthesis.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "illum/camera.h"
#include "illum/lighting.h"
#include "illum/object.h"
#include "illum/picture.h"

namespace illum {

/// The pictures of a set of views, one at a time, so that none need be in memory that is not looked
/// at. Called by one thread at a time; what is returned may be read by many.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  virtual const std::vector<View>& views() const = 0;
  /// Of every picture: values premultiplied by coverage, the last channel being the coverage itself
  /// (4: RGBA in linear light; more: whatever is to be interpolated).
  virtual int channels() const = 0;
  virtual bool hasDepth() const = 0;
  /// Whether pixels may show something although their depth is infinite: photographs whose
  /// background no depth tells of. It is taken to lie where everything does without depth.
  virtual bool hasBackdrop() const { return false; }
  virtual std::shared_ptr<const Picture> picture(int view) = 0;
  /// One channel, depthOf of camera.h, infinity where nothing is. Only where hasDepth().
  virtual std::shared_ptr<const Picture> depth(int view) = 0;
};

/// A view with its pictures in memory.
struct SourceView {
  View view;
  Picture picture;  ///< as ViewSource::picture
  Picture depth;    ///< as ViewSource::depth; empty: none
};

/// Views in memory as a source; it has a backdrop if any picture covers a pixel without depth;
/// `views` must outlive it. Throws Error (Fault::Input) where pictures do not have the size of
/// their views, differ in channels, or only some have depth.
std::unique_ptr<ViewSource> viewSource(std::span<const SourceView> views);

/// A camera at `eye` whose picture's middle is `target`; the field of view goes from the bottom of
/// the picture to its top, above 0 and below 180. Throws Error (Fault::Input) where eye, target and
/// `up` determine no frame.
PinholeCamera cameraLookingAt(Vector3 eye, Vector3 target, double fieldOfViewDegrees, Size size,
                              Vector3 up = {0, 1, 0});

/// {p : dot(normal, p - point) = 0}, object frame.
struct Plane {
  Vector3 point, normal{0, 0, 1};
};

struct SynthesisOptions {
  /// What is sharp where no depth tells where surfaces are, or where depth is not to be looked at.
  /// Empty: by depth, if the views have it; else each slab's own window, the plane z = 0 of a
  /// photograph, the plane that free cameras look at, and infinity for panoramas and for cameras
  /// that all look the same way (of an object, Lumigraph finds the plane on which their pictures
  /// agree best).
  std::optional<Plane> focus;
  /// Slabs: the radius of the synthetic aperture on the uv plane, in units of the object (Isaksen
  /// et al. 2000); 0: between the four nearest view points only. Needs `focus`, or views without
  /// depth.
  double apertureRadius = 0;
  /// Slabs with depth: false interpolates on the window as if there was none.
  bool useDepth = true;
  /// Free cameras: how many views a pixel is blended of, 1 to 64.
  int blendedViews = 4;
};

struct SynthesisedView {
  Picture picture;  ///< the source's channels, premultiplied; all zero where no view saw anything
  Picture depth;    ///< of `target`; infinity where nothing is. Empty without depth.
};

/// What `target` sees. At a view of the source this is that view's picture, to rounding. The same
/// on any number of threads. Throws Error (Fault::Input) for a source without views, and
/// (Fault::Usage) for options out of range.
SynthesisedView synthesise(ViewSource& source, const ViewGeometry& target,
                           const SynthesisOptions& options = {});

/// The same slab with another grid of view points over the same uv rectangle, finer or coarser
/// (Wong et al. 1997, section 5): its views are synthesised from `source` one after another, row by
/// row from the bottom, and given to `take`. Pictures may have any number of channels, so that what
/// is resampled may be planes of reflectance as well as colours. Throws as synthesise.
void resampleSlab(ViewSource& source, const LightSlab& slab, int uCount, int vCount,
                  const SynthesisOptions& options, const std::function<void(SourceView&&)>& take);

/// An object seen from anywhere under chosen lights. Views are relit when a camera needs them. Not
/// thread safe; works in parallel by itself.
class Lumigraph {
 public:
  /// `memoryBytes` bounds the tiles, pictures and depths that are kept; what one view takes is held
  /// in any case.
  explicit Lumigraph(Object object, std::uint64_t memoryBytes = std::uint64_t{1} << 30);
  ~Lumigraph();

  const Object& object() const;
  /// In the object frame, for all that is seen from now on. At first there is no light. Throws
  /// Error (Fault::Input) for lights near an object of whose surface nothing is known.
  void setLights(const Illumination& lights);
  void setLights(std::span<const DirectionalLight> lights);

  /// RGBA, linear and premultiplied.
  SynthesisedView see(const ViewGeometry& camera, const SynthesisOptions& options = {});

  /// What stands in the middle of what the object's views look at.
  Vector3 middle() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum
