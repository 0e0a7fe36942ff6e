// How records that are kept as JSON are described: one function template, `describe`, for each
// record drives reading, writing and checking. A visitor (json/visitors.h) has one function for
// each kind of field:
//
//   integer, number, flag, text, choice     scalars, with their limits
//   triple, numbers, integers               lists of fixed or bounded length
//   record, records                         a described record, or a list of them
//   maybeRecord                             a described record that may be missing
//
// `describe` stands in this namespace, where the visitors find it.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "illum/colour.h"
#include "illum/vector.h"

namespace illum::fields {

inline constexpr double kHuge = 1e30;  // of any number; leaves room for products of two in double
inline constexpr std::size_t kMaxTextBytes = 4096;

/// Of a field.
struct Name {
  std::string_view text;
  bool optional = false;
  constexpr Name(const char* t) : text(t) {}  // a plain literal names a required field
  constexpr Name(std::string_view t, bool o) : text(t), optional(o) {}
};
/// A field that may be missing and then keeps its default.
constexpr Name optional(std::string_view text) {
  return {text, true};
}

template <typename Real>
using Triple = std::array<Real*, 3>;
template <typename Enum>
using Choices = std::initializer_list<std::pair<Enum, std::string_view>>;

/// Three coordinates or channels, in the file a list.
inline Triple<double> coordinatesOf(Vector3& v) {
  return {&v.x, &v.y, &v.z};
}
inline Triple<float> channelsOf(LinearRgb& colour) {
  return {&colour.r, &colour.g, &colour.b};
}

}  // namespace illum::fields
