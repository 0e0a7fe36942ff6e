#include "json/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace illum::fields {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// What nests and is long goes over several lines, all else on one.
void print(const OrderedJson& node, int depth, std::string& out) {
  constexpr std::size_t kLine = 100;
  const std::string compact = node.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  const bool nests = node.is_structured() &&
                     std::any_of(node.begin(), node.end(),
                                 [](const OrderedJson& child) { return child.is_structured(); });
  if (!nests || compact.size() <= kLine) {
    out += compact;
    return;
  }
  const std::string indent(2 * static_cast<std::size_t>(depth + 1), ' ');
  out += node.is_object() ? "{" : "[";
  const char* separator = "\n";
  for (auto child = node.begin(); child != node.end(); ++child) {
    out += separator + indent;
    if (node.is_object()) out += OrderedJson(child.key()).dump() + ": ";
    print(*child, depth + 1, out);
    separator = ",\n";
  }
  out += '\n' + indent.substr(2) + (node.is_object() ? "}" : "]");
}

}  // namespace

std::string jsonText(const OrderedJson& root) {
  std::string text;
  print(root, 0, text);
  text += '\n';
  return text;
}

}  // namespace illum::fields
