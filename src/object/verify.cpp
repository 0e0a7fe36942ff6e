#include <fmt/format.h>

#include <set>

#include "codec/tile.h"
#include "illum/error.h"
#include "illum/object.h"
#include "object/entry_name.h"
#include "object/manifest.h"

namespace illum {
namespace {

constexpr std::size_t kMaxFaults = 1000;

/// Collects sentences, and stops growing where more would tell nobody anything.
class Faults {
 public:
  void add(std::string sentence) {
    if (sentences_.size() < kMaxFaults)
      sentences_.push_back(std::move(sentence));
    else
      ++more_;
  }
  /// Runs a check that reports by Error.
  template <typename Check>
  void collect(const Check& check) {
    try {
      check();
    } catch (const Error& error) {
      if (error.fault() == Fault::Machine) throw;
      add(error.what());
    }
  }
  std::vector<std::string> take() {
    if (more_ > 0) sentences_.push_back(fmt::format("and {} more faults", more_));
    return std::move(sentences_);
  }

 private:
  std::vector<std::string> sentences_;
  std::size_t more_ = 0;
};

/// Reading an entry compares its checksum; decoding a tile compares everything else.
void verifyEntry(const Object& object, const std::string& name, Faults& faults) {
  const auto key = entryKeyOf(name);
  faults.collect([&] {
    if (key && key->kind == EntryKey::Kind::Planes)
      object.planeTile(key->group, key->level, key->x, key->y);
    else if (key && key->kind == EntryKey::Kind::Mask)
      object.maskTile(key->group, key->level, key->x, key->y);
    else if (key && key->kind == EntryKey::Kind::Depth)
      object.depthTile(key->group, key->level, key->x, key->y);
    else
      object.entry(name);
  });
}

}  // namespace

std::vector<std::string> verifyObject(const std::filesystem::path& path) {
  const Object object = Object::open(path);
  Faults faults;
  for (std::string& fault : object.containerFaults()) faults.add(std::move(fault));

  const auto names = object.entries();
  std::set<std::string_view> unknown(names.begin(), names.end());
  forEachRequiredEntry(object.manifest(), [&](const std::string& name) {
    if (unknown.erase(name) == 0)
      faults.add(fmt::format("{}: {} is missing", path.string(), name));
    else
      verifyEntry(object, name, faults);
  });
  if (unknown.erase(kPosterEntry) != 0) verifyEntry(object, std::string(kPosterEntry), faults);
  for (const std::string_view name : unknown)
    faults.add(fmt::format("{}: '{}' does not belong to the object", path.string(), name));
  return faults.take();
}

}  // namespace illum
