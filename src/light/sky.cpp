// Skies by formula. Angles: theta from the zenith, gamma between a direction and the sun, thetaSun
// of the sun from the zenith.
//
// - CIE standard overcast sky: P. Moon and D. E. Spencer, "Illumination from a non-uniform sky",
// 1942;
//   CIE 1955: L / Lz = (1 + 2 cos(theta)) / 3.
// - CIE standard clear sky: R. Kittler, "Standardisation of outdoor conditions for the calculation
// of
//   daylight factor with clear skies", 1967; CIE 22, 1973:
//   L / Lz = f(gamma) p(theta) / (f(thetaSun) p(0)), f(g) = 0.91 + 10 exp(-3 g) + 0.45 cos(g)^2,
//   p(t) = 1 - exp(-0.32 / cos(t)).
// - A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight", 1999: the sky
// in
//   appendix 2, the sun in appendix 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "illum/environment.h"
#include "light/light_checks.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

using Triple = std::array<double, 3>;

struct SkyAngles {
  double cosTheta, gamma;
};
/// Luminance or colour over the upper hemisphere, in units of its own.
using SkyFunction = std::function<Triple(SkyAngles)>;

LinearRgb rgbOf(const Triple& t) {
  return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])};
}

/// CIE XYZ to linear Rec.709 (IEC 61966-2-1).
Triple rec709FromXyz(const Triple& xyz) {
  const auto [x, y, z] = xyz;
  return {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
          0.0557 * x - 0.2040 * y + 1.0570 * z};
}

double luminance(const Triple& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

Triple colourFromChromaticity(double x, double y, double luminance) {
  return rec709FromXyz({x / y * luminance, luminance, (1 - x - y) / y * luminance});
}

double clearSky(SkyAngles at, double thetaSun) {
  const auto towardSun = [](double gamma) {
    return 0.91 + 10 * std::exp(-3 * gamma) + 0.45 * std::cos(gamma) * std::cos(gamma);
  };
  const auto gradation = [](double cosTheta) { return 1 - std::exp(-0.32 / cosTheta); };
  return towardSun(at.gamma) * gradation(at.cosTheta) / (towardSun(thetaSun) * gradation(1));
}

/// Preetham et al., equation 3: the five coefficients of Perez et al. 1993.
struct Perez {
  double a, b, c, d, e;
  double operator()(SkyAngles at) const {
    const double cosGamma = std::cos(at.gamma);
    return (1 + a * std::exp(b / at.cosTheta)) *
           (1 + c * std::exp(d * at.gamma) + e * cosGamma * cosGamma);
  }
};

/// Appendix 2: zenith chromaticities, [T^2 T 1] M [t^3 t^2 t 1]^T.
double zenithChromaticity(const std::array<double, 12>& m, double turbidity, double t) {
  const auto row = [&](std::size_t r) {
    return ((m[4 * r] * t + m[4 * r + 1]) * t + m[4 * r + 2]) * t + m[4 * r + 3];
  };
  return (row(0) * turbidity + row(1)) * turbidity + row(2);
}

/// In kcd/m^2, linear Rec.709.
SkyFunction preethamSky(double turbidity, double thetaSun) {
  const double T = turbidity;
  const Perez bigY{0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251,
                   0.1206 * T - 2.5771, -0.0670 * T + 0.3703};
  const Perez smallX{-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125,
                     -0.0641 * T - 0.8989, -0.0033 * T + 0.0452};
  const Perez smallY{-0.0167 * T - 0.2608, -0.0950 * T + 0.0092, -0.0079 * T + 0.2102,
                     -0.0441 * T - 1.6537, -0.0109 * T + 0.0529};
  const double chi = (4.0 / 9 - T / 120) * (kPi - 2 * thetaSun);
  const double zenithY = (4.0453 * T - 4.9710) * std::tan(chi) - 0.2155 * T + 2.4192;
  const double zenithX =
      zenithChromaticity({0.00166, -0.00375, 0.00209, 0, -0.02903, 0.06377, -0.03202, 0.00394,
                          0.11693, -0.21196, 0.06052, 0.25886},
                         T, thetaSun);
  const double zenithSmallY =
      zenithChromaticity({0.00275, -0.00610, 0.00317, 0, -0.04214, 0.08970, -0.04153, 0.00516,
                          0.15346, -0.26756, 0.06670, 0.26688},
                         T, thetaSun);
  const SkyAngles zenith{1, thetaSun};
  const double scaleY = zenithY / bigY(zenith), scaleX = zenithX / smallX(zenith),
               scaleSmallY = zenithSmallY / smallY(zenith);
  return [=](SkyAngles at) {
    return colourFromChromaticity(scaleX * smallX(at), scaleSmallY * smallY(at), scaleY * bigY(at));
  };
}

/// Appendix 1: how much of the sun's light passes, at three wavelengths that stand for red, green
/// and blue (the paper integrates over the spectrum; water vapour and mixed gases absorb beyond
/// them).
Triple solarTransmittance(double turbidity, double thetaSun) {
  const double degrees = thetaSun * 180 / kPi;
  const double airMass = 1 / (std::cos(thetaSun) + 0.15 * std::pow(93.885 - degrees, -1.253));
  const double beta = 0.04608 * turbidity - 0.04586;  // Angstrom's, with exponent 1.3
  const Triple micrometres{0.610, 0.550, 0.460};
  const Triple ozonePerMetre{12.0, 8.5, 0.6};  // table 2
  constexpr double kOzoneMetres = 0.0035;
  Triple passed;
  for (std::size_t c = 0; c < 3; ++c) {
    const double rayleigh = 0.008735 * std::pow(micrometres[c], -4.08);
    const double aerosol = beta * std::pow(micrometres[c], -1.3);
    passed[c] = std::exp(-airMass * (rayleigh + aerosol + ozonePerMetre[c] * kOzoneMetres));
  }
  return passed;
}

/// Irradiance of a surface that faces the sun, in klx, linear Rec.709.
Triple preethamSun(double turbidity, double thetaSun) {
  // S. Darula, R. Kittler, C. Gueymard, "Reference luminous solar constant and solar luminance for
  // illuminance calculations", 2005; the chromaticity is a black body's of 5778 K.
  Triple sun = colourFromChromaticity(0.3264, 0.3357, 133.1);
  const Triple passed = solarTransmittance(turbidity, thetaSun);
  for (std::size_t c = 0; c < 3; ++c) sun[c] *= passed[c];
  return sun;
}

/// The irradiance of a plane below, divided by pi: the value of a white surface there. Midpoints in
/// cos(theta)^2, whose weights are even for it, and azimuth.
Triple valueOfGround(const SkyFunction& sky, double thetaSun) {
  constexpr int kRings = 200, kAzimuths = 200;
  Triple sum{};
  for (int i = 0; i < kRings; ++i) {
    const double cosTheta = std::sqrt((i + 0.5) / kRings);
    const double sinTheta = std::sqrt(1 - cosTheta * cosTheta);
    for (int j = 0; j < kAzimuths; ++j) {
      const double cosAzimuth = std::cos(2 * kPi * (j + 0.5) / kAzimuths);
      const double cosGamma =
          cosTheta * std::cos(thetaSun) + sinTheta * std::sin(thetaSun) * cosAzimuth;
      const Triple value = sky({cosTheta, std::acos(std::clamp(cosGamma, -1.0, 1.0))});
      for (std::size_t c = 0; c < 3; ++c) sum[c] += value[c];
    }
  }
  for (double& s : sum) s /= kRings * kAzimuths;
  return sum;
}

/// A sky in units in which a white plane below it has the luminance 1.
struct NormalisedSky {
  SkyFunction above;
  Triple below{}, sun{};

  explicit NormalisedSky(const SkyLight& sky);
};

double sunAngle(const SkyLight& sky) {
  // Rounding may leave a sun on the horizon a little below it.
  return sky.model == SkyModel::Overcast ? 0 : std::min(angleRadians(sky.up, sky.sun), kPi / 2);
}

NormalisedSky::NormalisedSky(const SkyLight& sky) {
  checkLight(sky);
  const double thetaSun = sunAngle(sky);
  SkyFunction raw;
  switch (sky.model) {
    case SkyModel::Overcast:
      raw = [](SkyAngles at) {
        const double value = (1 + 2 * at.cosTheta) / 3;
        return Triple{value, value, value};
      };
      break;
    case SkyModel::Clear:
      raw = [thetaSun](SkyAngles at) {
        const double value = clearSky(at, thetaSun);
        return Triple{value, value, value};
      };
      break;
    case SkyModel::Preetham:
      raw = preethamSky(sky.turbidity, thetaSun);
      if (sky.sunlight) sun = preethamSun(sky.turbidity, thetaSun);
      break;
  }
  const Triple white = valueOfGround(raw, thetaSun);
  const double scale = 1 / luminance(white);
  above = [raw, scale](SkyAngles at) {
    Triple value = raw(at);
    for (double& v : value) v *= scale;
    return value;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    sun[c] *= scale / kPi;  // irradiance to intensity
    below[c] = sky.ground * (scale * white[c] + sun[c] * std::cos(thetaSun));
  }
}

LinearRgb scaled(LinearRgb intensity, LinearRgb value) {
  return {intensity.r * value.r, intensity.g * value.g, intensity.b * value.b};
}

}  // namespace

std::function<LinearRgb(Direction)> skyRadiance(const SkyLight& sky) {
  return [sky, normalised = NormalisedSky(sky)](Direction d) {
    const double cosTheta = dot(d.vector(), sky.up.vector());
    if (cosTheta <= 0) return scaled(sky.intensity, rgbOf(normalised.below));
    return scaled(sky.intensity, rgbOf(normalised.above({cosTheta, angleRadians(d, sky.sun)})));
  };
}

Environment skyEnvironment(const SkyLight& sky, Size size) {
  const auto radiance = skyRadiance(sky);
  const RigidTransform turn = objectFromMap(0, sky.up);
  Picture map(size, 3);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const Direction d =
          turn.direction(directionFromMap((column + 0.5) / size.width, (row + 0.5) / size.height));
      const LinearRgb value = radiance(d);
      map.at(column, row, 0) = value.r;
      map.at(column, row, 1) = value.g;
      map.at(column, row, 2) = value.b;
    }
  }
  return Environment(std::move(map), turn);
}

std::optional<DirectionalLight> sunlightOf(const SkyLight& sky) {
  if (sky.model != SkyModel::Preetham || !sky.sunlight) return std::nullopt;
  return DirectionalLight{sky.sun, scaled(sky.intensity, rgbOf(NormalisedSky(sky).sun))};
}

}  // namespace illum
