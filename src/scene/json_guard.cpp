#include "scene/json_guard.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "illum/error.h"

namespace illum {
namespace {

using Json = nlohmann::json;

/// Hears the parser's events and keeps none of them.
class Guard final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    names_.emplace_back();
    return deeper();
  }
  bool end_object() override {
    names_.pop_back();
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override { return deeper(); }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool key(string_t& name) override {
    if (!names_.back().insert(name).second)
      throw Error(Fault::Input,
                  fmt::format("field '{}': expected once in a record, found twice", name));
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;  // the parser itself says it again
  }

 private:
  bool deeper() {
    constexpr int kDeepest = 32;
    if (++depth_ > kDeepest)
      throw Error(Fault::Input,
                  fmt::format("expected at most {} levels of nesting, found more", kDeepest));
    return true;
  }

  int depth_ = 0;
  std::vector<std::set<std::string>> names_;  // of the records that are open
};

}  // namespace

nlohmann::json guardedJson(std::string_view text, const std::string& source) {
  try {
    // By itself and first: with a callback, the parser's time grows with the square of a list.
    Guard guard;
    Json::sax_parse(text, &guard);
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(Fault::Input,
                fmt::format("{}: expected JSON, found a fault: {}", source, error.what()));
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace illum
