#include "numbers.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

namespace illum::cli {

Error wrongOption(const char* option, const char* form, const std::string& text) {
  return {Fault::Usage, fmt::format("{}: expected {}, found \"{}\"", option, form, text)};
}

Numbers::Numbers(const char* option, const char* form, const std::string& text)
    : option_(option), form_(form), text_(text) {
  for (const auto& part : CLI::detail::split(text, ',')) {
    double number = 0;
    if (!CLI::detail::lexical_cast(part, number) || !std::isfinite(number)) {
      values_.clear();
      return;
    }
    values_.push_back(number);
  }
}

Vector3 Numbers::vector(std::size_t from) const {
  return {values_[from], values_[from + 1], values_[from + 2]};
}

Direction Numbers::direction(std::size_t from) const {
  try {
    return Direction::fromVector(vector(from));
  } catch (const Error&) {
    throw wrongOption(option_, "a direction", text_);
  }
}

LinearRgb Numbers::colour(std::size_t from) const {
  if (from == values_.size()) return {1, 1, 1};
  if (from + 3 != values_.size()) throw wrong();
  return {static_cast<float>(values_[from]), static_cast<float>(values_[from + 1]),
          static_cast<float>(values_[from + 2])};
}

}  // namespace illum::cli
