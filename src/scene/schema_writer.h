// Writes what scene/scene_fields.h describes as a JSON schema (draft 2020-12).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "json/visitors.h"
#include "scene/field_about.h"

namespace illum::scenefile {

using fields::OrderedJson;

class SchemaWriter {
 public:
  /// The schema of a record: its fields and no others.
  OrderedJson take() {
    OrderedJson schema{{"type", "object"}};
    if (!required_.empty()) schema["required"] = required_;
    schema["additionalProperties"] = false;
    schema["properties"] = std::move(properties_);
    return schema;
  }

  void version(About about, int known) {
    add(about, {{"const", known}});
    required_.emplace_back(about.name);
  }
  template <typename Integer>
  void integer(About about, Integer&, std::uint64_t low, std::uint64_t high) {
    add(about, integerSchema(low, high));
  }
  template <typename Real>
  void number(About about, Real&, double low, double high) {
    add(about, numberSchema(low, high));
  }
  void flag(About about, bool&) { add(about, {{"type", "boolean"}}); }
  template <typename Text>
  void text(About about, Text&) {
    add(about, {{"type", "string"}});
  }
  void texts(About about, std::map<std::string, std::string>&) {
    add(about, {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}});
  }
  template <typename Enum>
  void choice(About about, Enum&, Choices<Value<Enum>> choices) {
    OrderedJson words = OrderedJson::array();
    for (const auto& [choice, word] : choices) words.push_back(word);
    add(about, {{"enum", words}});
  }
  template <typename Numbers>
  void numbers(About about, Numbers&, double low, double high) {
    constexpr std::size_t kCount = std::tuple_size_v<Value<Numbers>>;
    add(about, listSchema(numberSchema(low, high), kCount, kCount));
  }
  template <typename Integers>
  void integers(About about, Integers&, std::uint64_t low, std::uint64_t high) {
    constexpr std::size_t kCount = std::tuple_size_v<Value<Integers>>;
    add(about, listSchema(integerSchema(low, high), kCount, kCount));
  }
  template <typename Triple>
  void triple(About about, Triple&, double low, double high) {
    add(about, tripleSchema(low, high));
  }
  void triples(About about, std::vector<Vector3>&, std::size_t most, double limit) {
    add(about, listSchema(tripleSchema(-limit, limit), 1, most));
  }
  void spread(About about, Vector3&, double low, double high) {
    add(about, {{"anyOf", {numberSchema(low, high), tripleSchema(low, high)}}});
  }
  void colour(About about, LinearRgb&, double low, double high) {
    Vector3 unused;
    spread(about, unused, low, high);
  }
  void polylines(About about, std::vector<std::vector<Vector3>>&, std::size_t mostLines,
                 std::size_t mostPoints, double limit) {
    add(about, listSchema(listSchema(tripleSchema(-limit, limit), 2, mostPoints), 1, mostLines));
  }
  template <typename Record>
  void part(About about, Record&) {
    add(about, schemaOf<Record>());
  }
  template <typename Record>
  void record(About about, std::optional<Record>&) {
    add(about, schemaOf<Record>());
  }
  template <typename Record>
  void records(About about, std::vector<Record>&, std::size_t most) {
    add(about, listSchema(schemaOf<Record>(), 0, most));
  }
  template <typename Record>
  void dictionary(About about, std::map<std::string, Record>&, std::size_t) {
    add(about, {{"type", "object"}, {"additionalProperties", schemaOf<Record>()}});
  }

  template <typename Record>
  static OrderedJson schemaOf() {
    Record record;
    SchemaWriter writer;
    describe(writer, record);
    return writer.take();
  }

 private:
  void add(About about, OrderedJson schema) {
    OrderedJson described{{"description", about.meaning}};
    described.update(schema);
    properties_[std::string(about.name)] = std::move(described);
  }
  static OrderedJson integerSchema(std::uint64_t low, std::uint64_t high) {
    return {{"type", "integer"}, {"minimum", low}, {"maximum", high}};
  }
  static OrderedJson numberSchema(double low, double high) {
    return {{"type", "number"}, {"minimum", low}, {"maximum", high}};
  }
  static OrderedJson tripleSchema(double low, double high) {
    return listSchema(numberSchema(low, high), 3, 3);
  }
  static OrderedJson listSchema(const OrderedJson& items, std::size_t least, std::size_t most) {
    return {{"type", "array"}, {"items", items}, {"minItems", least}, {"maxItems", most}};
  }

  OrderedJson properties_ = OrderedJson::object();
  std::vector<std::string> required_;
};

}  // namespace illum::scenefile
