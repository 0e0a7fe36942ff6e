// An environment as a number of directional lights.
#pragma once

#include <vector>

#include "illum/environment.h"

namespace illum {

/// P. Debevec, "A Median Cut Algorithm for Light Probe Sampling", 2005: the map is halved again and
/// again, each time the region of most light, across its longer side, into halves of equal light;
/// each region becomes a light at its centroid with all of its colour. Together they have exactly
/// the map's light.
class MedianCut {
 public:
  /// Halves until there are `mostRegions`, or fewer where light comes from fewer texels.
  MedianCut(const Environment& environment, int mostRegions);

  int mostLights() const;
  /// After halving until there were `regions`: the same as if that had been asked for.
  std::vector<DirectionalLight> lights(int regions) const;

 private:
  /// A region; its parts, where it was halved (-1: none, or without light).
  struct Node {
    Rectangle texels;
    double light = 0;
    int first = -1, second = -1;
    Vector3 centroid;
    double r = 0, g = 0, b = 0;
  };
  void addTexels(const Environment& environment, Node& node) const;

  std::vector<Node> nodes_;  // parts behind what they are parts of
  std::vector<int> halved_;  // in the order in which it was done
};

/// MedianCut(environment, regions).lights(regions).
std::vector<DirectionalLight> medianCut(const Environment& environment, int regions);

}  // namespace illum
