// Small scenes of which the picture is known, for tests.
#pragma once

#include <vector>

#include "render/float3.h"
#include "render/renderer.h"
#include "scene/scene.h"

namespace illum {

/// Matt, without any highlight.
Material mattMaterial(LinearRgb colour);

/// Of radius 1 about the origin unless moved; smooth normals.
TriangleMesh sphereMesh(double radius, Vector3 centre, int material = 0);

/// A plane z = 0 of side 10.
Scene planeScene(const Material& material);
/// One sphere.
Scene sphereScene(const Material& material);

/// One photograph of side x side pixels.
View frontalView(int side);

/// Evenly over the sphere, `count` equal areas; ids from 0.
std::vector<RenderLight> fibonacciLights(int count);

/// All of a view.
std::vector<float> renderAll(const Renderer& renderer, const View& view,
                             const std::vector<RenderLight>& lights);

/// The mean over `pixels` values of one channel of a light.
double meanOf(const std::vector<float>& samples, std::size_t pixels, std::size_t light,
              std::size_t channel = 0);

/// Radiance 1 from everywhere, made of `lights` of equal area: their mean, times 4.
std::vector<float> underWhiteSky(const std::vector<float>& samples, std::size_t pixels,
                                 std::size_t lights);

/// Microfacets term by term as they stand in the papers, in double precision: directions in a frame
/// whose z is the normal. The value, without the cosine.
double referenceMicrofacets(double alpha, double facing, double grazing, Float3 toViewer,
                            Float3 toLight);

}  // namespace illum
