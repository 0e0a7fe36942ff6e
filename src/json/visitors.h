// Reading and writing described records (json/field.h) as JSON.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "illum/error.h"
#include "json/field.h"

namespace illum::fields {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

/// Throws Error that names no file for what is no JSON.
inline Json jsonFromText(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw Error(Fault::Input, fmt::format("expected JSON, found an error at byte {}", error.byte));
  } catch (const Json::out_of_range&) {
    throw Error(Fault::Input, "expected JSON with numbers below 1e308, found a larger one");
  }
}

/// "groups[2].basis"; how errors name a field.
class FieldPath {
 public:
  FieldPath() = default;
  FieldPath(const FieldPath* parent, std::string_view name) : parent_(parent), name_(name) {}
  FieldPath(const FieldPath* parent, std::size_t index) : parent_(parent), index_(index) {}

  std::string text() const {
    if (parent_ == nullptr) return {};
    const std::string before = parent_->text();
    if (name_.empty()) return fmt::format("{}[{}]", before, index_);
    return before.empty() ? std::string(name_) : fmt::format("{}.{}", before, name_);
  }
  Error wrong(std::string_view expected, std::string_view found) const {
    return {Fault::Input,
            fmt::format("field '{}': expected {}, found {}", text(), expected, found)};
  }

 private:
  const FieldPath* parent_ = nullptr;
  std::string_view name_;
  std::size_t index_ = 0;
};

template <typename Number>
void checkLimits(const FieldPath& path, Number value, Number low, Number high) {
  if (!(value >= low && value <= high))  // also catches NaN
    throw path.wrong(fmt::format("a number from {} to {}", low, high), fmt::format("{}", value));
}

inline void checkCount(const FieldPath& path, std::size_t count, std::size_t low,
                       std::size_t high) {
  if (count >= low && count <= high) return;
  throw path.wrong(
      low == high ? fmt::format("{} elements", low) : fmt::format("{} to {} elements", low, high),
      fmt::format("{}", count));
}

inline void checkText(const FieldPath& path, const std::string& text) {
  if (text.size() > kMaxTextBytes)
    throw path.wrong(fmt::format("at most {} bytes of text", kMaxTextBytes),
                     fmt::format("{}", text.size()));
}

inline constexpr std::size_t kShownBytes = 40;

/// A short form of what was found in the place of a value.
inline std::string shown(const Json& value) {
  if (value.is_structured()) return value.is_array() ? "a list" : "a record";
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kShownBytes ? text : text.substr(0, kShownBytes) + "...";
}

/// What becomes of fields that no description names: files that newer versions may extend skip
/// them, files that people write refuse them, so that a misspelt name does not go unnoticed.
enum class Unknown { Skip, Refuse };

/// Fills records from JSON, throwing Error that names the field for whatever is missing or wrong.
class Reader {
 public:
  Reader(const Json& node, FieldPath path, Unknown unknown = Unknown::Skip)
      : node_(node), path_(path), unknown_(unknown) {
    if (!node.is_object()) throw path.wrong("a record", shown(node));
  }

  /// After the description: throws Error for fields that it did not name, if they are refused.
  void finish() const {
    if (unknown_ == Unknown::Skip) return;
    for (auto field = node_.begin(); field != node_.end(); ++field) {
      if (std::find(named_.begin(), named_.end(), field.key()) != named_.end()) continue;
      std::string names;
      for (const std::string_view name : named_)
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name);
      const std::string key = field.key().substr(0, kShownBytes);
      throw FieldPath(&path_, key).wrong("one of " + names, "another name");
    }
  }

  template <typename Integer>
  void integer(Name name, Integer& value, std::uint64_t low, std::uint64_t high) {
    const FieldPath path(&path_, name.text);
    if (const Json* node = find(name))
      value = static_cast<Integer>(integerOf(*node, path, low, high));
  }
  template <typename Real>
  void number(Name name, Real& value, double low, double high) {
    const FieldPath path(&path_, name.text);
    if (const Json* node = find(name)) value = static_cast<Real>(numberOf(*node, path, low, high));
  }
  void flag(Name name, bool& value) {
    const Json* node = find(name);
    if (node == nullptr) return;
    if (!node->is_boolean())
      throw FieldPath(&path_, name.text).wrong("true or false", shown(*node));
    value = node->get<bool>();
  }
  void text(Name name, std::string& value) {
    const FieldPath path(&path_, name.text);
    const Json* node = find(name);
    if (node == nullptr) return;
    if (!node->is_string()) throw path.wrong("text", shown(*node));
    value = node->get_ref<const std::string&>();
    checkText(path, value);
  }
  template <typename Enum>
  void choice(Name name, Enum& value, Choices<Enum> choices) {
    const Json* node = find(name);
    if (node == nullptr) return;
    std::string known;
    for (const auto& [choice, word] : choices) {
      if (node->is_string() && node->get_ref<const std::string&>() == word) {
        value = choice;
        return;
      }
      known += fmt::format("{}'{}'", known.empty() ? "" : ", ", word);
    }
    throw FieldPath(&path_, name.text).wrong("one of " + known, shown(*node));
  }
  template <std::size_t N>
  void numbers(Name name, std::array<double, N>& values, double low, double high) {
    const FieldPath path(&path_, name.text);
    const Json* node = findList(name, N, N);
    if (node == nullptr) return;
    for (std::size_t i = 0; i < N; ++i)
      values[i] = numberOf((*node)[i], FieldPath(&path, i), low, high);
  }
  template <typename Real>
  void triple(Name name, Triple<Real> values, double low, double high) {
    const FieldPath path(&path_, name.text);
    const Json* node = findList(name, 3, 3);
    if (node == nullptr) return;
    for (std::size_t i = 0; i < 3; ++i)
      *values[i] = static_cast<Real>(numberOf((*node)[i], FieldPath(&path, i), low, high));
  }
  void numbers(Name name, std::vector<double>& values, double low, double high, std::size_t least,
               std::size_t most) {
    const FieldPath path(&path_, name.text);
    const Json* node = findList(name, least, most);
    if (node == nullptr) return;
    values.clear();
    for (std::size_t i = 0; i < node->size(); ++i)
      values.push_back(numberOf((*node)[i], FieldPath(&path, i), low, high));
  }
  void integers(Name name, std::vector<int>& values, std::uint64_t low, std::uint64_t high,
                std::size_t least, std::size_t most) {
    const FieldPath path(&path_, name.text);
    const Json* node = findList(name, least, most);
    if (node == nullptr) return;
    values.clear();
    for (std::size_t i = 0; i < node->size(); ++i)
      values.push_back(static_cast<int>(integerOf((*node)[i], FieldPath(&path, i), low, high)));
  }
  template <typename Record>
  void record(Name name, Record& value) {
    const Json* node = find(name);
    if (node == nullptr) return;
    Reader reader(*node, FieldPath(&path_, name.text), unknown_);
    describe(reader, value);
    reader.finish();
  }
  template <typename Record>
  void maybeRecord(std::string_view name, std::optional<Record>& value) {
    value.reset();
    if (node_.contains(name)) record(Name(name, true), value.emplace());
  }
  template <typename Record>
  void records(Name name, std::vector<Record>& values, std::size_t least, std::size_t most) {
    const FieldPath path(&path_, name.text);
    const Json* node = findList(name, least, most);
    if (node == nullptr) return;
    values.clear();
    for (std::size_t i = 0; i < node->size(); ++i) {
      Reader reader((*node)[i], FieldPath(&path, i), unknown_);
      describe(reader, values.emplace_back());
      reader.finish();
    }
  }

 private:
  const Json* find(Name name) {
    if (unknown_ == Unknown::Refuse) named_.push_back(name.text);
    const auto found = node_.find(name.text);
    if (found != node_.end()) return &*found;
    if (!name.optional) throw FieldPath(&path_, name.text).wrong("a value", "none");
    return nullptr;
  }
  const Json* findList(Name name, std::size_t least, std::size_t most) {
    const Json* node = find(name);
    if (node == nullptr) return nullptr;
    const FieldPath path(&path_, name.text);
    if (!node->is_array()) throw path.wrong("a list", shown(*node));
    checkCount(path, node->size(), least, most);
    return node;
  }
  static std::uint64_t integerOf(const Json& node, const FieldPath& path, std::uint64_t low,
                                 std::uint64_t high) {
    // nlohmann-json parses every integer that is not negative as unsigned.
    if (!node.is_number_unsigned())
      throw path.wrong(fmt::format("a whole number from {} to {}", low, high), shown(node));
    const auto value = node.get<std::uint64_t>();
    checkLimits(path, value, low, high);
    return value;
  }
  static double numberOf(const Json& node, const FieldPath& path, double low, double high) {
    if (!node.is_number()) throw path.wrong("a number", shown(node));
    const auto value = node.get<double>();
    checkLimits(path, value, low, high);
    return value;
  }

  const Json& node_;
  FieldPath path_;
  Unknown unknown_;
  std::vector<std::string_view> named_;  // by the description so far
};

/// Writes what Reader reads, and refuses what it would refuse.
class Writer {
 public:
  explicit Writer(FieldPath path) : path_(path) {}
  OrderedJson& node() { return node_; }

  template <typename Integer>
  void integer(Name name, const Integer& value, std::uint64_t low, std::uint64_t high) {
    node_[std::string(name.text)] = checkedInteger(value, FieldPath(&path_, name.text), low, high);
  }
  template <typename Real>
  void number(Name name, const Real& value, double low, double high) {
    checkLimits(FieldPath(&path_, name.text), static_cast<double>(value), low, high);
    node_[std::string(name.text)] = static_cast<double>(value);
  }
  void flag(Name name, const bool& value) { node_[std::string(name.text)] = value; }
  void text(Name name, const std::string& value) {
    checkText(FieldPath(&path_, name.text), value);
    node_[std::string(name.text)] = value;
  }
  template <typename Enum>
  void choice(Name name, const Enum& value, Choices<Enum> choices) {
    for (const auto& [choice, word] : choices)
      if (choice == value) node_[std::string(name.text)] = word;
  }
  template <std::size_t N>
  void numbers(Name name, const std::array<double, N>& values, double low, double high) {
    addNumbers(name, values, low, high, N, N);
  }
  template <typename Real>
  void triple(Name name, Triple<Real> values, double low, double high) {
    const std::array<double, 3> copies{*values[0], *values[1], *values[2]};
    addNumbers(name, copies, low, high, 3, 3);
  }
  void numbers(Name name, const std::vector<double>& values, double low, double high,
               std::size_t least, std::size_t most) {
    addNumbers(name, values, low, high, least, most);
  }
  void integers(Name name, const std::vector<int>& values, std::uint64_t low, std::uint64_t high,
                std::size_t least, std::size_t most) {
    const FieldPath path(&path_, name.text);
    checkCount(path, values.size(), least, most);
    auto& list = node_[std::string(name.text)] = OrderedJson::array();
    for (std::size_t i = 0; i < values.size(); ++i)
      list.push_back(checkedInteger(values[i], FieldPath(&path, i), low, high));
  }
  template <typename Record>
  void record(Name name, Record& value) {
    Writer writer(FieldPath(&path_, name.text));
    describe(writer, value);
    node_[std::string(name.text)] = std::move(writer.node());
  }
  template <typename Record>
  void maybeRecord(std::string_view name, std::optional<Record>& value) {
    if (value) record(Name(name, true), *value);
  }
  template <typename Record>
  void records(Name name, std::vector<Record>& values, std::size_t least, std::size_t most) {
    const FieldPath path(&path_, name.text);
    checkCount(path, values.size(), least, most);
    auto& list = node_[std::string(name.text)] = OrderedJson::array();
    for (std::size_t i = 0; i < values.size(); ++i) {
      Writer writer(FieldPath(&path, i));
      describe(writer, values[i]);
      list.push_back(std::move(writer.node()));
    }
  }

 private:
  template <typename Integer>
  static std::uint64_t checkedInteger(Integer value, const FieldPath& path, std::uint64_t low,
                                      std::uint64_t high) {
    if (std::cmp_less(value, low) || std::cmp_greater(value, high))
      throw path.wrong(fmt::format("a whole number from {} to {}", low, high),
                       fmt::format("{}", value));
    return static_cast<std::uint64_t>(value);
  }
  template <typename Numbers>
  void addNumbers(Name name, const Numbers& values, double low, double high, std::size_t least,
                  std::size_t most) {
    const FieldPath path(&path_, name.text);
    checkCount(path, values.size(), least, most);
    auto& list = node_[std::string(name.text)] = OrderedJson::array();
    for (std::size_t i = 0; i < values.size(); ++i) {
      checkLimits(FieldPath(&path, i), values[i], low, high);
      list.push_back(values[i]);
    }
  }

  FieldPath path_;
  OrderedJson node_ = OrderedJson::object();
};
}  // namespace illum::fields
