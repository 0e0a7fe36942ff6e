#include "scene/fbx_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "illum/error.h"

namespace illum {
namespace {

/// assimp goes down both by recursion; records nest to about ten, models less than a skeleton.
constexpr std::size_t kDeepestRecords = 100, kDeepestModels = 1000;

using Id = std::uint64_t;  // of an object; 0 is the scene itself

/// Hears of records as they open and close, and of what the two kinds that matter say.
class FbxChecker {
 public:
  explicit FbxChecker(const std::string& source) : source_(source) {}

  void open() {
    if (++depth_ > kDeepestRecords)
      fail(fmt::format("records within at most {} others", kDeepestRecords), "more");
  }
  void close() { depth_ -= depth_ > 0 ? 1 : 0; }
  void addModel(Id id) { models_.insert(id); }
  /// `kind`: between objects or ("OP", "PP") their properties; assimp takes a property without a
  /// name for the object.
  void connect(std::string_view kind, Id child, Id parent, std::string_view property) {
    if (kind != "PP" && (kind != "OP" || property.empty()))
      connections_.emplace_back(child, parent);
  }

  void finish() const {
    std::map<Id, Id> parents;
    for (const auto& [child, parent] : connections_) {
      if (!models_.contains(child) || (parent != 0 && !models_.contains(parent))) continue;
      if (!parents.emplace(child, parent).second)
        fail("models that each belong to one other", fmt::format("{} belonging to two", child));
    }
    // A model's depth is known once that of all above it is, so that each is visited once.
    std::map<Id, std::size_t> depths;
    for (const auto& entry : parents) {
      std::vector<Id> way;
      Id at = entry.first;
      for (; parents.contains(at) && !depths.contains(at); at = parents.at(at)) {
        way.push_back(at);
        if (way.size() > kDeepestModels) failDeep();
      }
      std::size_t depth = depths.contains(at) ? depths.at(at) : 0;
      for (auto model = way.rbegin(); model != way.rend(); ++model)
        if ((depths[*model] = ++depth) > kDeepestModels) failDeep();
    }
  }

 private:
  [[noreturn]] void failDeep() const {
    fail(fmt::format("trees of at most {} models above each other", kDeepestModels),
         "deeper ones, or a model that belongs to itself");
  }
  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error(Fault::Input, fmt::format("{}: expected {}, found {}", source_, expected, found));
  }

  const std::string& source_;
  std::size_t depth_ = 0;
  std::set<Id> models_;
  std::vector<std::pair<Id, Id>> connections_;
};

// --- text ---

/// Words, strings with their quotes, and the signs { } : , one after the other; empty at the end.
class FbxWords {
 public:
  explicit FbxWords(std::string_view text) : text_(text.substr(0, text.find('\0'))) {}

  std::string_view next() {
    skipBlanks();
    if (text_.empty()) return {};
    std::size_t length = 1;
    if (text_[0] == '"')
      length = std::min(text_.find('"', 1), text_.size() - 1) + 1;
    else if (std::string_view("{}:,").find(text_[0]) == std::string_view::npos)
      length = std::min(text_.find_first_of("{}:,;\" \t\r\n\f"), text_.size());
    const std::string_view word = text_.substr(0, length);
    text_.remove_prefix(length);
    return word;
  }

 private:
  void skipBlanks() {
    for (;;) {
      text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n\f"), text_.size()));
      if (!text_.starts_with(';')) return;
      text_.remove_prefix(std::min(text_.find_first_of("\r\n\f"), text_.size()));
    }
  }

  std::string_view text_;
};

std::string_view unquoted(std::string_view word) {
  if (word.starts_with('"')) word.remove_prefix(1);
  if (word.ends_with('"')) word.remove_suffix(1);
  return word;
}

/// As assimp reads it: what follows the digits does not matter, and too large a number is 0.
std::optional<Id> idOf(std::string_view word) {
  Id id = 0;
  const std::errc fault = std::from_chars(word.data(), word.data() + word.size(), id).ec;
  if (fault == std::errc::invalid_argument) return std::nullopt;
  return fault == std::errc() ? id : 0;
}

void addRecord(std::string_view name, std::span<const std::string_view> properties,
               FbxChecker& checker) {
  const auto id = [&](std::size_t i) { return idOf(properties[i]); };
  if (name == "Model" && !properties.empty() && id(0)) checker.addModel(*id(0));
  if (name == "C" && properties.size() >= 3 && id(1) && id(2))
    checker.connect(unquoted(properties[0]), *id(1), *id(2),
                    properties.size() > 3 ? unquoted(properties[3]) : std::string_view());
}

void checkText(std::string_view text, FbxChecker& checker) {
  constexpr std::size_t kKept = 4;
  FbxWords words(text);
  std::string_view name, before;
  std::vector<std::string_view> properties;
  for (std::string_view word; !(word = words.next()).empty(); before = word) {
    if (word == ":" || word == "{" || word == "}") {
      addRecord(name, properties, checker);
      name = word == ":" ? before : std::string_view();
      properties.clear();
      if (word == "{") checker.open();
      if (word == "}") checker.close();
    } else if (word != "," && properties.size() < kKept) {
      properties.push_back(word);
    }
  }
  addRecord(name, properties, checker);
}

// --- binary ---

constexpr std::string_view kMagic = "Kaydara FBX Binary";
constexpr std::size_t kVersionAt = 23, kHeaderBytes = 27;

/// Numbers and names from a place onwards; beyond the end there is nothing but zeros.
class FbxBytes {
 public:
  FbxBytes(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  std::size_t at() const { return at_; }
  void goTo(std::size_t at) { at_ = at; }
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i, ++at_)
      if (at_ < bytes_.size())
        value |= std::uint64_t{static_cast<unsigned char>(bytes_[at_])} << (8 * i);
    return value;
  }
  std::string_view text(std::size_t length) {
    const std::string_view found = bytes_.substr(std::min(at_, bytes_.size()), length);
    at_ += found.size();
    return found;
  }
  /// A property of that kind; empty if it is of another.
  std::string_view string() { return number(1) == 'S' ? text(number(4)) : std::string_view(); }
  std::optional<Id> id() { return number(1) == 'L' ? std::optional(number(8)) : std::nullopt; }

 private:
  std::string_view bytes_;
  std::size_t at_;
};

void addRecord(std::string_view name, FbxBytes properties, FbxChecker& checker) {
  if (name == "Model") {
    if (const auto id = properties.id()) checker.addModel(*id);
  } else if (name == "C") {
    const std::string_view kind = properties.string();
    const auto child = properties.id(), parent = properties.id();
    if (child && parent) checker.connect(kind, *child, *parent, properties.string());
  }
}

/// A record: where it ends, the number and bytes of its properties, its name, these, and then
/// records within it, closed by an empty one. Ends where assimp finds a fault.
void checkBinary(std::string_view bytes, FbxChecker& checker) {
  const int word = FbxBytes(bytes, kVersionAt).number(4) >= 7500 ? 8 : 4;
  const std::size_t empty = 3 * static_cast<std::size_t>(word) + 1;
  std::vector<std::size_t> ends;  // of the records that are open
  FbxBytes from(bytes, kHeaderBytes);
  while (from.at() < bytes.size()) {
    if (!ends.empty() && from.at() + empty >= ends.back()) {
      from.goTo(ends.back());
      ends.pop_back();
      checker.close();
      continue;
    }
    const std::size_t limit = ends.empty() ? bytes.size() : ends.back() - empty;
    const std::size_t end = from.number(word);
    if (end == 0 && !ends.empty()) continue;
    from.number(word);
    const std::size_t propertyBytes = from.number(word);
    const std::string_view name = from.text(from.number(1));
    if (end < from.at() || end > limit || propertyBytes > end - from.at()) return;
    addRecord(name, from, checker);
    from.goTo(from.at() + propertyBytes);
    if (from.at() == end) continue;
    if (end - from.at() < empty) return;
    ends.push_back(end);
    checker.open();
  }
}

}  // namespace

void checkFbx(std::span<const std::byte> file, const std::string& source) {
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  FbxChecker checker(source);
  if (bytes.starts_with(kMagic))
    checkBinary(bytes, checker);
  else
    checkText(bytes, checker);
  checker.finish();
}

}  // namespace illum
