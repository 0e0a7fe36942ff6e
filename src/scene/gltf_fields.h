// Fields of a glTF file's tree, each read with what it may be; what is else is one sentence.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "illum/error.h"

namespace illum {

/// A record and where it stands, such as accessors[3].
struct Place {
  const nlohmann::json& record;
  std::string path;
};

/// All throw Error (Fault::Input) naming the source and the field.
class GltfFields {
 public:
  using Json = nlohmann::json;

  explicit GltfFields(const std::string& source) : source_(source) {}

  const std::string& source() const { return source_; }

  [[noreturn]] void fail(const std::string& field, std::string_view expected,
                         const Json* found) const {
    const std::string shown =
        found == nullptr ? "none"
                         : found->dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
    throw Error(Fault::Input, fmt::format("{}: field '{}': expected {}, found {}", source_, field,
                                          expected, shown));
  }

  static const Json* fieldOf(const Json& record, const char* name) {
    const auto found = record.find(name);
    return found == record.end() ? nullptr : &*found;
  }

  /// `fallback`: of a field that may be missing.
  std::uint64_t whole(const Place& place, const char* name, std::uint64_t low, std::uint64_t high,
                      std::optional<std::uint64_t> fallback = {}) const {
    const Json* found = fieldOf(place.record, name);
    if (found == nullptr && fallback) return *fallback;
    if (found == nullptr || !found->is_number_unsigned() || found->get<std::uint64_t>() < low ||
        found->get<std::uint64_t>() > high)
      fail(place.path + "." + name, fmt::format("a whole number from {} to {}", low, high), found);
    return found->get<std::uint64_t>();
  }

  /// False if it is missing.
  bool flag(const Place& place, const char* name) const {
    const Json* found = fieldOf(place.record, name);
    if (found != nullptr && !found->is_boolean())
      fail(place.path + "." + name, "true or false", found);
    return found != nullptr && found->get<bool>();
  }

  /// The number of an entry of a list that has `count`; nothing if the field is missing.
  std::optional<std::size_t> maybeIndex(const Place& place, const char* name,
                                        std::size_t count) const {
    const Json* found = fieldOf(place.record, name);
    if (found == nullptr) return std::nullopt;
    checkIndex(*found, place.path + "." + name, count);
    return found->get<std::size_t>();
  }
  std::size_t index(const Place& place, const char* name, std::size_t count) const {
    const std::optional<std::size_t> found = maybeIndex(place, name, count);
    if (!found) fail(place.path + "." + name, "a number", nullptr);
    return *found;
  }
  void checkIndex(const Json& found, const std::string& field, std::size_t count) const {
    if (!found.is_number_unsigned() || found.get<std::uint64_t>() >= count)
      fail(field, fmt::format("the number of one of {}", count), &found);
  }

  /// A list that may be missing.
  const Json& list(const Json& record, const char* name, const std::string& path) const {
    static const Json kEmpty = Json::array();
    const Json* found = fieldOf(record, name);
    if (found != nullptr && !found->is_array()) fail(path + name, "a list", found);
    return found == nullptr ? kEmpty : *found;
  }
  std::vector<Place> records(const Json& record, const char* name,
                             const std::string& path = "") const {
    std::vector<Place> places;
    for (const Json& entry : list(record, name, path)) {
      places.push_back({entry, fmt::format("{}{}[{}]", path, name, places.size())});
      if (!entry.is_object()) fail(places.back().path, "a record", &entry);
    }
    return places;
  }
  Place record(const Place& place, const char* name) const {
    const Json* found = fieldOf(place.record, name);
    const std::string path = place.path + "." + name;
    if (found == nullptr || !found->is_object()) fail(path, "a record", found);
    return {*found, path};
  }
  /// Numbers between bounds, a list of `count` or one alone, if the field is there.
  void checkNumbers(const Place& place, const char* name, std::size_t count, double low,
                    double high) const {
    const Json* found = fieldOf(place.record, name);
    if (found == nullptr) return;
    // Factors of 1 are written as 1.0000001 by programs that count in floats.
    constexpr double kRounding = 1e-5;
    const auto within = [&](const Json& x) {
      return x.is_number() && x.get<double>() >= low - kRounding &&
             x.get<double>() <= high + kRounding;
    };
    const bool good = count == 1 ? within(*found)
                                 : found->is_array() && found->size() == count &&
                                       std::ranges::all_of(*found, within);
    if (good) return;
    const std::string what = count == 1 ? "a number" : fmt::format("{} numbers", count);
    const std::string range = std::isinf(low)    ? ""
                              : std::isinf(high) ? fmt::format(" of at least {}", low)
                                                 : fmt::format(" from {} to {}", low, high);
    fail(place.path + "." + name, what + range, found);
  }

 private:
  const std::string& source_;
};

}  // namespace illum
