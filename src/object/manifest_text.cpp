#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "illum/error.h"
#include "object/entry_name.h"
#include "object/entry_source.h"
#include "object/manifest.h"

// One description of each record, `describe`, drives reading, writing and checking. A visitor has
// one function for each kind of field:
//
//   integer, number, flag, text, choice     scalars, with their limits
//   triple, numbers, integers               lists of fixed or bounded length
//   record, records                         a described record, or a list of them
//
// To extend the format within version 1: add a field as `optional("name")` whose default means what
// older objects meant, and raise kMinor. Anything that older readers must not ignore needs a new
// major.

namespace illum {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr int kMajor = 1, kMinor = 0;
constexpr std::string_view kFormat = "illum";
constexpr double kHuge = 1e30;  // of any number; leaves room for products of two in double
constexpr std::size_t kMaxTextBytes = 4096;
constexpr std::size_t kMaxProvenance = 1000;

struct Name {
  std::string_view text;
  bool optional = false;
  constexpr Name(const char* t) : text(t) {}  // a plain literal names a required field
  constexpr Name(std::string_view t, bool o) : text(t), optional(o) {}
};
constexpr Name optional(std::string_view text) {
  return {text, true};
}

template <typename Real>
using Triple = std::array<Real*, 3>;
template <typename Enum>
using Choices = std::initializer_list<std::pair<Enum, std::string_view>>;

/// Three coordinates or channels, in the file a list.
Triple<double> coordinatesOf(Vector3& v) {
  return {&v.x, &v.y, &v.z};
}
Triple<float> channelsOf(LinearRgb& colour) {
  return {&colour.r, &colour.g, &colour.b};
}

template <typename Visitor>
void describe(Visitor& v, Size& size) {
  v.integer("width", size.width, 1, kMaxSide);
  v.integer("height", size.height, 1, kMaxSide);
}

template <typename Visitor>
void describe(Visitor& v, RigidTransform& transform) {
  v.numbers("rotation", transform.rotation, -1.000001, 1.000001);
  v.triple("translation", coordinatesOf(transform.translation), -kHuge, kHuge);
}

template <typename Visitor>
void describe(Visitor& v, BasisEntry& basis) {
  using Kind = BasisColour::Kind;
  v.text("name", basis.name);
  v.integer("coefficients", basis.coefficients, 1, kMaxPlanes);
  v.choice("kind", basis.colour.kind,
           Choices<Kind>{{Kind::Separable, "separable"}, {Kind::Full, "full"}});
  v.numbers("colourMatrix", basis.colour.colourMatrix, -kHuge, kHuge);
  v.integer("tableOffset", basis.tableOffset, 0, kMaxBasisBytes);
  v.integer("tableBytes", basis.tableBytes, 1, kMaxBasisBytes);
  v.numbers(optional("mixing"), basis.mixing, -kHuge, kHuge, 0, kMaxPlanes * kMaxPlanes);
}

template <typename Visitor>
void describe(Visitor& v, GroupEntry& group) {
  v.text("name", group.name);
  v.integer("basis", group.basis, 0, kMaxBases - 1);
  v.integer("views", group.views, 1, 1);
  v.record("objectFromGroup", group.objectFromGroup);
}

template <typename Visitor>
void describe(Visitor& v, CodingEntry& coding) {
  v.choice("name", coding.coding,
           Choices<Coding>{{Coding::Png, "png"}, {Coding::Avif, "avif"}, {Coding::Jpeg, "jpeg"}});
  v.integer("bits", coding.bits, 8, 16);
  v.choice("curve", coding.curve,
           Choices<Curve>{{Curve::Linear, "linear"}, {Curve::SignedSqrt, "signedSqrt"}});
  v.number("step", coding.step, 1e-30, kHuge);
  v.numbers("offsets", coding.offsets, -kHuge, kHuge, 1, kMaxPlanes);
  v.integers("functions", coding.functions, 0, kMaxPlanes - 1, 1, kMaxPlanes);
  v.integer(optional("quality"), coding.quality, 0, 100);
}

/// A light of the capture, its direction not yet checked to be one.
struct LightRecord {
  std::string name;
  Vector3 direction;
  LinearRgb intensity{1, 1, 1};
};

template <typename Visitor>
void describe(Visitor& v, LightRecord& light) {
  v.text("name", light.name);
  v.triple("direction", coordinatesOf(light.direction), -kHuge, kHuge);
  v.triple(optional("intensity"), channelsOf(light.intensity), 0, kHuge);
}

struct ProvenanceRecord {
  std::string name, value;
};

template <typename Visitor>
void describe(Visitor& v, ProvenanceRecord& record) {
  v.text("name", record.name);
  v.text("value", record.value);
}

/// The manifest with the two lists that differ between memory and file.
struct FileManifest {
  Manifest manifest;
  std::vector<LightRecord> lights;
  std::vector<ProvenanceRecord> provenance;
};

template <typename Visitor>
void describe(Visitor& v, FileManifest& file) {
  Manifest& m = file.manifest;
  v.text("generator", m.generator);
  v.text("geometry", m.geometry);
  v.record("size", m.size);
  v.integer("tile", m.tile, kMinTile, kMaxTile);
  v.integer("levels", m.levels, 1, kMaxLevels);
  v.choice("domain", m.domain,
           Choices<LightDomain>{{LightDomain::Hemisphere, "hemisphere"},
                                {LightDomain::Sphere, "sphere"}});
  v.choice(
      "response", m.response,
      Choices<Response>{
          {Response::Linear, "linear"}, {Response::Display, "display"}, {Response::Cone, "cone"}});
  v.record("coding", m.coding);
  v.records("bases", m.bases, 1, kMaxBases);
  v.records("groups", m.groups, 1, kMaxGroups);
  v.flag(optional("mask"), m.mask);
  v.records(optional("lights"), file.lights, 0, kMaxLights);
  v.integers(optional("heldOut"), m.heldOut, 0, kMaxLights - 1, 0, kMaxLights);
  v.records(optional("provenance"), file.provenance, 0, kMaxProvenance);
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

void checkCount(const FieldPath& path, std::size_t count, std::size_t low, std::size_t high) {
  if (count >= low && count <= high) return;
  throw path.wrong(
      low == high ? fmt::format("{} elements", low) : fmt::format("{} to {} elements", low, high),
      fmt::format("{}", count));
}

void checkText(const FieldPath& path, const std::string& text) {
  if (text.size() > kMaxTextBytes)
    throw path.wrong(fmt::format("at most {} bytes of text", kMaxTextBytes),
                     fmt::format("{}", text.size()));
}

/// A short form of what was found in the place of a value.
std::string shown(const Json& value) {
  constexpr std::size_t kShown = 40;
  if (value.is_structured()) return value.is_array() ? "a list" : "a record";
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kShown ? text : text.substr(0, kShown) + "...";
}

class Reader {
 public:
  Reader(const Json& node, FieldPath path) : node_(node), path_(path) {
    if (!node.is_object()) throw path.wrong("a record", shown(node));
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
    Reader reader(*node, FieldPath(&path_, name.text));
    describe(reader, value);
  }
  template <typename Record>
  void records(Name name, std::vector<Record>& values, std::size_t least, std::size_t most) {
    const FieldPath path(&path_, name.text);
    const Json* node = findList(name, least, most);
    if (node == nullptr) return;
    values.clear();
    for (std::size_t i = 0; i < node->size(); ++i) {
      Reader reader((*node)[i], FieldPath(&path, i));
      describe(reader, values.emplace_back());
    }
  }

 private:
  const Json* find(Name name) const {
    const auto found = node_.find(name.text);
    if (found != node_.end()) return &*found;
    if (!name.optional) throw FieldPath(&path_, name.text).wrong("a value", "none");
    return nullptr;
  }
  const Json* findList(Name name, std::size_t least, std::size_t most) const {
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

void checkVersion(const Json& root, const FieldPath& top, Manifest& manifest) {
  const auto format = root.find("format");
  if (format == root.end() || *format != kFormat)
    throw FieldPath(&top, "format")
        .wrong("'illum'", format == root.end() ? "none" : shown(*format));
  const auto version = root.find("version");
  const FieldPath path(&top, "version");
  if (version == root.end() || !version->is_array() || version->size() != 2 ||
      !(*version)[0].is_number_unsigned() || !(*version)[1].is_number_unsigned())
    throw path.wrong("two whole numbers", version == root.end() ? "none" : shown(*version));
  const auto major = (*version)[0].get<std::uint64_t>(), minor = (*version)[1].get<std::uint64_t>();
  if (major > kMajor)
    throw Error(Fault::Input, fmt::format("made by a newer Illumigraph: format {}.{}, this program "
                                          "reads {}.x",
                                          major, minor, kMajor));
  if (major < kMajor || minor > std::numeric_limits<int>::max())
    throw path.wrong(fmt::format("{}.x", kMajor), fmt::format("{}.{}", major, minor));
  manifest.versionMajor = kMajor;
  manifest.versionMinor = static_cast<int>(minor);
}

void checkGeometry(const Manifest& manifest) {
  if (manifest.geometry != "photograph")
    throw Error(Fault::Input, fmt::format("field 'geometry': expected 'photograph', found '{}'",
                                          manifest.geometry.substr(0, 40)));
}

Manifest readManifest(std::string_view text) {
  if (text.size() > kMaxManifestBytes)
    throw Error(Fault::Input,
                fmt::format("expected at most {} bytes, found {}", kMaxManifestBytes, text.size()));
  const Json root = Json::parse(text);
  const FieldPath top;
  FileManifest file;
  Reader reader(root, top);
  checkVersion(root, top, file.manifest);
  describe(reader, file);
  checkGeometry(file.manifest);
  Manifest& manifest = file.manifest;
  for (LightRecord& light : file.lights)
    manifest.lights.push_back(
        {std::move(light.name), {Direction::fromVector(light.direction), light.intensity}, 0});
  for (ProvenanceRecord& record : file.provenance)
    manifest.provenance.emplace_back(std::move(record.name), std::move(record.value));
  checkConsistency(manifest);
  return std::move(file.manifest);
}

std::string writeManifest(const Manifest& manifest) {
  FileManifest file{manifest, {}, {}};
  for (const LightFileEntry& entry : manifest.lights)
    file.lights.push_back({entry.name, entry.light.toLight.vector(), entry.light.intensity});
  for (const auto& [name, value] : manifest.provenance) file.provenance.push_back({name, value});

  Writer writer{FieldPath()};
  writer.node()["format"] = kFormat;
  writer.node()["version"] = {kMajor, kMinor};
  describe(writer, file);
  checkGeometry(manifest);
  checkConsistency(manifest);
  std::string text;
  print(writer.node(), 0, text);
  text += '\n';
  if (text.size() > kMaxManifestBytes)
    throw Error(Fault::Input,
                fmt::format("expected at most {} bytes, found {}", kMaxManifestBytes, text.size()));
  return text;
}

}  // namespace

std::string textOf(const Manifest& manifest) {
  try {
    return writeManifest(manifest);
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", kManifestEntry, error.what()));
  }
}

Manifest manifestFromText(std::string_view json, const std::string& source) {
  try {
    return readManifest(json);
  } catch (const nlohmann::json::exception& error) {
    throw Error(Fault::Input,
                fmt::format("{}: expected JSON, found a fault: {}", source, error.what()));
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace illum
