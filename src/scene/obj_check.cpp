#include "scene/obj_check.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>

#include "illum/error.h"

namespace illum {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::array<const char*, 3> kKinds{"points", "texture coordinates", "normals"};

/// The next word of `line`, which it is taken from; empty at its end.
std::string_view takeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

class ObjChecker {
 public:
  explicit ObjChecker(const std::string& source) : source_(source) {}

  void add(std::string_view line) {
    ++line_;
    if (continued_) return addFace(line);
    const std::string_view word = takeWord(line);
    if (word == "v") ++counts_[0];
    if (word == "vt") ++counts_[1];
    if (word == "vn") ++counts_[2];
    if (word == "f") addFace(line);
    if (word == "mtllib") addMaterials(line);
  }

  std::vector<std::string> finish() const {
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
      if (highest_[kind].index > counts_[kind])
        fail(kind, highest_[kind].index, highest_[kind].line);
    return materials_;
  }

 private:
  /// An index counts from 1, or from -1 backwards from here; a later point may be meant.
  void addFace(std::string_view line) {
    continued_ = false;
    for (std::string_view corner; !(corner = takeWord(line)).empty();) {
      if (corner == "\\") {
        continued_ = true;
        return;
      }
      for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
        const std::string_view written = corner.substr(0, corner.find('/'));
        if (!written.empty()) addIndex(kind, written);
        if (written.size() == corner.size()) break;
        corner.remove_prefix(written.size() + 1);
      }
    }
  }
  void addIndex(std::size_t kind, std::string_view written) {
    std::int64_t index = 0;
    const auto [end, fault] =
        std::from_chars(written.data(), written.data() + written.size(), index);
    if (fault == std::errc::result_out_of_range) fail(kind, written, line_);
    if (fault != std::errc()) return;  // words are found by assimp
    if (index == 0 || index < -counts_[kind]) fail(kind, index, line_);
    if (index > highest_[kind].index) highest_[kind] = {index, line_};
  }
  void addMaterials(std::string_view line) {
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return;
    line = line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
    materials_.emplace_back(line);
  }
  template <typename Index>
  [[noreturn]] void fail(std::size_t kind, const Index& index, std::size_t line) const {
    throw Error(Fault::Input, fmt::format("{}:{}: expected the number of one of {} {}, found {}",
                                          source_, line, counts_[kind], kKinds[kind], index));
  }

  struct Highest {
    std::int64_t index = 0;
    std::size_t line = 0;
  };
  const std::string& source_;
  std::size_t line_ = 0;
  bool continued_ = false;
  std::array<std::int64_t, 3> counts_{};
  std::array<Highest, 3> highest_{};
  std::vector<std::string> materials_;
};

}  // namespace

std::vector<std::string> checkedObjMaterials(std::string_view text, const std::string& source) {
  ObjChecker checker(source);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    checker.add(text.substr(0, end));
    const bool pair = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (pair ? 2 : 1), text.size()));
  }
  return checker.finish();
}

}  // namespace illum
