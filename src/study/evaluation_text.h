// How figures are written, alike on the terminal and in the report.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "illum/evaluate.h"

namespace illum {

/// "31.42", or "–" for a figure that does not exist (NaN).
std::string figureText(double value, int decimals);

/// A name from a file, fit for a terminal: control characters become "?", at most `limit`
/// characters.
std::string printableName(std::string_view name, std::size_t limit);

/// Indices of Evaluation::pictures by rising PSNR over all pixels; equals in their order.
std::vector<std::size_t> worstFirst(const Evaluation& evaluation);

}  // namespace illum
