// The rays of a view's samples, through the pixel filter.
#pragma once

#include "illum/camera.h"
#include "render/float3.h"
#include "render/sample_sequence.h"
#include "scene/scene.h"

namespace illum {

/// A ray that knows how wide the beam is that it stands for: at distance t, width + spread * t.
struct BeamRay {
  Float3 origin, direction;  ///< direction of unit length
  float width = 0, spread = 0;
};

/// Where in and about a pixel its samples lie: a trapezoid, the convolution of a box one pixel wide
/// with a box that makes the whole `radius` pixels wide to each side; 0.5 is the pixel's square, 1
/// a tent. Below 0.5 a smaller box, above 1 a wider tent. Importance sampled, so that every sample
/// weighs the same.
class PixelFilter {
 public:
  explicit PixelFilter(double radius);
  /// An offset from the pixel's centre with the filter's density, from one number in [0, 1).
  double offset(double uniform) const;

 private:
  double flat_, slope_;  // half the width of the top; width of one flank
};

/// Rays start where they enter the ball about the scene, so that distances stay small.
class CameraRays {
 public:
  CameraRays(const ViewGeometry& view, const Bounds& scene, double filterRadius,
             int samplesPerPixel);
  BeamRay through(int x, int y, const SampleSequence& sequence) const;

 private:
  const ViewGeometry& view_;
  Vector3 centre_;
  double radius_;
  PixelFilter filter_;
  double footprint_;  // side of a sample's share of the pixel, in pixels
};

}  // namespace illum
