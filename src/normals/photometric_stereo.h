// The normal of one surface point from its brightness under many lights.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "illum/normals.h"
#include "illum/vector.h"

namespace illum {

/// Solves for normals under a fixed set of lights. Thread safe.
class PhotometricStereo {
 public:
  /// At least four lights.
  PhotometricStereo(std::vector<Direction> lights, NormalOptions::Method method);

  std::size_t lights() const { return lights_.size(); }

  /// Of unit length; empty where all is black or the lights tell no direction. `brightness`: one
  /// number a light, linear. `scratch` is used again from call to call.
  std::optional<Vector3> normal(std::span<const float> brightness,
                                std::vector<float>& scratch) const;

 private:
  /// What of a point's samples is neither shadow nor highlight.
  struct Window {
    float from = 0, to = 0;
  };
  Window middle(std::span<const float> brightness, std::vector<float>& scratch) const;
  std::optional<Vector3> leastSquares(std::span<const float> brightness,
                                      std::span<const float> weights) const;

  std::vector<Vector3> lights_;
  NormalOptions::Method method_;
};

}  // namespace illum
