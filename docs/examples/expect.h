// For programs that say what they expect and check it, in every build type.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

inline void expect(bool holds, const char* statement) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", statement);
  std::exit(1);
}

inline void expectNear(double value, double expected, const char* statement,
                       double tolerance = 1e-12) {
  if (!(std::abs(value - expected) <= tolerance))
    std::fprintf(stderr, "%.17g instead of %.17g\n", value, expected);
  expect(std::abs(value - expected) <= tolerance, statement);
}
