// Grids of light directions under which a scene is captured.
#pragma once

#include <span>
#include <vector>

#include "illum/light_file.h"
#include "illum/vector.h"

namespace illum {

/// Hemisphere: about +z, the viewer's side.
enum class LightRegion { Hemisphere, Sphere };

/// The grid of Wong et al. 1997, sections 4 and 4.1 (20 x 20, 30 x 60): `thetaCount` rings of
/// `phiCount` lights. Rings stand in the middle of equal steps of theta, so that neither the pole
/// nor the horizon is sampled twice. Ring by ring from +z, in each from +x toward +y. Counts >= 1.
std::vector<Direction> polarLights(int thetaCount, int phiCount, LightRegion region);

/// Nearly even: light i has the height of the i-th of `count` slices of equal area and the azimuth
/// i times the golden angle (Gonzalez 2010, "Measurement of Areas on a Sphere Using Fibonacci and
/// Latitude-Longitude Lattices"). count >= 1.
std::vector<Direction> fibonacciLights(int count, LightRegion region);

/// The median angle between a light and its nearest neighbour, in radians; 0 for a single light.
/// Of large sets a fixed sample is asked. Lights in the same place count as one.
double spacingRadians(std::span<const Direction> lights);

/// Named as a capture names them, "light_0007", intensity 1.
std::vector<LightFileEntry> namedLights(std::span<const Direction> directions);

}  // namespace illum
