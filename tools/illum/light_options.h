// The options that say which lights shine.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "illum/lighting.h"

namespace illum::cli {

/// --light, --point, --spot, --env, --sky and --lighting, any number of each.
struct LightOptions {
  std::vector<std::string> lights, points, spots, environments, skies, setups;
  double rotationDegrees = 0, exposureStops = 0;  ///< of --env
  std::string up;                                 ///< of --env, --sky and cameras

  void addTo(CLI::App& command);
  bool empty() const;
  Direction upward() const;  ///< --up
  /// All of them; reads set-ups but no pictures. Throws Error (Fault::Usage) for what cannot be
  /// read.
  Lighting lighting() const;
};

}  // namespace illum::cli
