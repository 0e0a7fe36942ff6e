#include "scene/json_guard.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "illum/error.h"

namespace illum {
namespace {

using Json = nlohmann::json;

/// Watches the parser's events.
class Guard {
 public:
  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    constexpr int kDeepest = 32;
    if (depth > kDeepest)
      throw Error(Fault::Input,
                  fmt::format("expected at most {} levels of nesting, found more", kDeepest));
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event == Json::parse_event_t::key) {
      const auto& name = parsed.get_ref<const std::string&>();
      if (!open_.back().insert(name).second)
        throw Error(Fault::Input,
                    fmt::format("field '{}': expected once in a record, found twice", name));
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> open_;
};

}  // namespace

nlohmann::json guardedJson(std::string_view text, const std::string& source) {
  try {
    Guard guard;
    return Json::parse(text, [&](int depth, Json::parse_event_t event, Json& parsed) {
      return guard(depth, event, parsed);
    });
  } catch (const Json::exception& error) {
    throw Error(Fault::Input,
                fmt::format("{}: expected JSON, found a fault: {}", source, error.what()));
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace illum
