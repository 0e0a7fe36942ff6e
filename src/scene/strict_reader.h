// Fills the records of a scene file (scene/scene_fields.h) from JSON. Every field may be missing;
// a field that no record knows is refused, with the nearest name that one does know.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "json/visitors.h"
#include "scene/field_about.h"
#include "scene/nearest_name.h"

namespace illum::scenefile {

using fields::FieldPath;
using fields::Json;

class StrictReader {
 public:
  StrictReader(const Json& node, FieldPath path) : node_(node), path_(path) {
    if (!node.is_object()) throw path.wrong("a record", fields::shown(node));
  }

  /// To be called when all fields have been asked for.
  void finish() const {
    for (const auto& item : node_.items()) {
      if (std::ranges::find(asked_, item.key()) == asked_.end()) refuse(item.key());
    }
  }

  void version(About about, int known) {
    const FieldPath path(&path_, about.name);
    const Json* node = find(about);
    if (node == nullptr) throw path.wrong(fmt::format("{}", known), "none");
    if (*node != known) throw path.wrong(fmt::format("{}", known), fields::shown(*node));
  }
  template <typename Integer>
  void integer(About about, Integer& value, std::uint64_t low, std::uint64_t high) {
    const FieldPath path(&path_, about.name);
    if (const Json* node = find(about))
      value = static_cast<Value<Integer>>(integerOf(*node, path, low, high));
  }
  template <typename Real>
  void number(About about, Real& value, double low, double high) {
    const FieldPath path(&path_, about.name);
    if (const Json* node = find(about))
      value = static_cast<Value<Real>>(numberOf(*node, path, low, high));
  }
  void flag(About about, bool& value) {
    const Json* node = find(about);
    if (node == nullptr) return;
    if (!node->is_boolean())
      throw FieldPath(&path_, about.name).wrong("true or false", fields::shown(*node));
    value = node->get<bool>();
  }
  template <typename Text>
  void text(About about, Text& value) {
    if (const Json* node = find(about)) value = textOf(*node, FieldPath(&path_, about.name));
  }
  void texts(About about, std::map<std::string, std::string>& values) {
    const FieldPath path(&path_, about.name);
    const Json* node = findRecord(about);
    if (node == nullptr) return;
    for (const auto& item : node->items())
      values[checkedName(path, item.key())] = textOf(item.value(), FieldPath(&path, item.key()));
  }
  template <typename Enum>
  void choice(About about, Enum& value, Choices<Value<Enum>> choices) {
    const Json* node = find(about);
    if (node == nullptr) return;
    std::string known;
    for (const auto& [choice, word] : choices) {
      if (node->is_string() && node->get_ref<const std::string&>() == word) {
        value = choice;
        return;
      }
      known += fmt::format("{}'{}'", known.empty() ? "" : ", ", word);
    }
    throw FieldPath(&path_, about.name).wrong("one of " + known, fields::shown(*node));
  }
  template <typename Numbers>
  void numbers(About about, Numbers& values, double low, double high) {
    Value<Numbers> read{};
    const FieldPath path(&path_, about.name);
    const Json* node = findList(about, read.size(), read.size());
    if (node == nullptr) return;
    for (std::size_t i = 0; i < read.size(); ++i)
      read[i] = numberOf((*node)[i], FieldPath(&path, i), low, high);
    values = read;
  }
  template <typename Integers>
  void integers(About about, Integers& values, std::uint64_t low, std::uint64_t high) {
    Value<Integers> read{};
    const FieldPath path(&path_, about.name);
    const Json* node = findList(about, read.size(), read.size());
    if (node == nullptr) return;
    for (std::size_t i = 0; i < read.size(); ++i)
      read[i] = static_cast<int>(integerOf((*node)[i], FieldPath(&path, i), low, high));
    values = read;
  }
  template <typename Triple>
  void triple(About about, Triple& value, double low, double high) {
    if (const Json* node = find(about))
      value = tripleOf(*node, FieldPath(&path_, about.name), low, high);
  }
  void triples(About about, std::vector<Vector3>& values, std::size_t most, double limit) {
    const FieldPath path(&path_, about.name);
    if (const Json* node = findList(about, 1, most)) readTriples(*node, path, values, limit);
  }
  void spread(About about, Vector3& value, double low, double high) {
    const FieldPath path(&path_, about.name);
    const Json* node = find(about);
    if (node == nullptr) return;
    if (node->is_number()) {
      const double all = numberOf(*node, path, low, high);
      value = {all, all, all};
    } else {
      value = tripleOf(*node, path, low, high);
    }
  }
  void colour(About about, LinearRgb& value, double low, double high) {
    Vector3 read{value.r, value.g, value.b};
    spread(about, read, low, high);
    value = {static_cast<float>(read.x), static_cast<float>(read.y), static_cast<float>(read.z)};
  }
  void polylines(About about, std::vector<std::vector<Vector3>>& values, std::size_t mostLines,
                 std::size_t mostPoints, double limit) {
    const FieldPath path(&path_, about.name);
    const Json* node = findList(about, 1, mostLines);
    if (node == nullptr) return;
    for (std::size_t i = 0; i < node->size(); ++i) {
      const FieldPath line(&path, i);
      if (!(*node)[i].is_array()) throw line.wrong("a list of points", fields::shown((*node)[i]));
      fields::checkCount(line, (*node)[i].size(), 2, mostPoints);
      readTriples((*node)[i], line, values.emplace_back(), limit);
    }
  }
  template <typename Record>
  void part(About about, Record& value) {
    if (const Json* node = find(about)) read(*node, FieldPath(&path_, about.name), value);
  }
  template <typename Record>
  void record(About about, std::optional<Record>& value) {
    if (const Json* node = find(about)) read(*node, FieldPath(&path_, about.name), value.emplace());
  }
  template <typename Record>
  void records(About about, std::vector<Record>& values, std::size_t most) {
    const FieldPath path(&path_, about.name);
    const Json* node = findList(about, 0, most);
    if (node == nullptr) return;
    for (std::size_t i = 0; i < node->size(); ++i)
      read((*node)[i], FieldPath(&path, i), values.emplace_back());
  }
  template <typename Record>
  void dictionary(About about, std::map<std::string, Record>& values, std::size_t most) {
    const FieldPath path(&path_, about.name);
    const Json* node = findRecord(about);
    if (node == nullptr) return;
    fields::checkCount(path, node->size(), 0, most);
    for (const auto& item : node->items())
      read(item.value(), FieldPath(&path, item.key()), values[checkedName(path, item.key())]);
  }

  template <typename Record>
  static void read(const Json& node, FieldPath path, Record& value) {
    StrictReader reader(node, path);
    describe(reader, value);
    reader.finish();
  }

 private:
  const Json* find(About about) {
    asked_.push_back(about.name);
    const auto found = node_.find(about.name);
    return found == node_.end() ? nullptr : &*found;
  }
  const Json* findList(About about, std::size_t least, std::size_t most) {
    const Json* node = find(about);
    if (node == nullptr) return nullptr;
    const FieldPath path(&path_, about.name);
    if (!node->is_array()) throw path.wrong("a list", fields::shown(*node));
    fields::checkCount(path, node->size(), least, most);
    return node;
  }
  const Json* findRecord(About about) {
    const Json* node = find(about);
    if (node != nullptr && !node->is_object())
      throw FieldPath(&path_, about.name).wrong("a record", fields::shown(*node));
    return node;
  }
  [[noreturn]] void refuse(const std::string& name) const {
    const std::string nearest = nearestName(name, asked_), where = path_.text();
    throw Error(Fault::Input, fmt::format("{}expected a known field{}, found {}",
                                          where.empty() ? "" : "field '" + where + "': ",
                                          nearest.empty() ? "" : " such as '" + nearest + "'",
                                          fields::shown(Json(name))));
  }
  /// Names that records are kept by come up in messages.
  static const std::string& checkedName(const FieldPath& path, const std::string& name) {
    constexpr std::size_t kLongest = 200;
    const bool printable = std::ranges::none_of(name, [](char c) { return c >= 0 && c < ' '; });
    if (name.size() > kLongest || !printable)
      throw path.wrong(fmt::format("names of at most {} printable characters", kLongest),
                       fields::shown(Json(name)));
    return name;
  }
  static std::string textOf(const Json& node, const FieldPath& path) {
    if (!node.is_string()) throw path.wrong("text", fields::shown(node));
    std::string text = node.get<std::string>();
    fields::checkText(path, text);
    return text;
  }
  static std::uint64_t integerOf(const Json& node, const FieldPath& path, std::uint64_t low,
                                 std::uint64_t high) {
    if (!node.is_number_unsigned())
      throw path.wrong(fmt::format("a whole number from {} to {}", low, high), fields::shown(node));
    const auto value = node.get<std::uint64_t>();
    fields::checkLimits(path, value, low, high);
    return value;
  }
  static double numberOf(const Json& node, const FieldPath& path, double low, double high) {
    if (!node.is_number()) throw path.wrong("a number", fields::shown(node));
    const auto value = node.get<double>();
    fields::checkLimits(path, value, low, high);
    return value;
  }
  static Vector3 tripleOf(const Json& node, const FieldPath& path, double low, double high) {
    if (!node.is_array()) throw path.wrong("a list of three numbers", fields::shown(node));
    fields::checkCount(path, node.size(), 3, 3);
    return {numberOf(node[0], FieldPath(&path, 0), low, high),
            numberOf(node[1], FieldPath(&path, 1), low, high),
            numberOf(node[2], FieldPath(&path, 2), low, high)};
  }
  static void readTriples(const Json& node, const FieldPath& path, std::vector<Vector3>& values,
                          double limit) {
    for (std::size_t i = 0; i < node.size(); ++i)
      values.push_back(tripleOf(node[i], FieldPath(&path, i), -limit, limit));
  }

  const Json& node_;
  FieldPath path_;
  std::vector<std::string_view> asked_;
};

}  // namespace illum::scenefile
