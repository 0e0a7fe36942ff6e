#include "scene/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "illum/colour.h"
#include "illum/error.h"

namespace illum {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct Property {
  std::string name;
  Type type = Type::Float;
  bool isList = false;
  Type countType = Type::Uint8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = true;
  std::endian order = std::endian::little;
  std::vector<Element> elements;
};

std::size_t bytesOf(Type type) {
  switch (type) {
    case Type::Int8:
    case Type::Uint8:
      return 1;
    case Type::Int16:
    case Type::Uint16:
      return 2;
    case Type::Double:
      return 8;
    default:
      return 4;
  }
}

bool readType(std::string_view word, Type& type) {
  constexpr std::array<std::pair<std::string_view, Type>, 16> kTypes{{{"char", Type::Int8},
                                                                      {"int8", Type::Int8},
                                                                      {"uchar", Type::Uint8},
                                                                      {"uint8", Type::Uint8},
                                                                      {"short", Type::Int16},
                                                                      {"int16", Type::Int16},
                                                                      {"ushort", Type::Uint16},
                                                                      {"uint16", Type::Uint16},
                                                                      {"int", Type::Int32},
                                                                      {"int32", Type::Int32},
                                                                      {"uint", Type::Uint32},
                                                                      {"uint32", Type::Uint32},
                                                                      {"float", Type::Float},
                                                                      {"float32", Type::Float},
                                                                      {"double", Type::Double},
                                                                      {"float64", Type::Double}}};
  for (const auto& [name, known] : kTypes) {
    if (name != word) continue;
    type = known;
    return true;
  }
  return false;
}

/// Walks through the file's bytes.
class PlyReader {
 public:
  PlyReader(std::span<const std::byte> file, const std::string& source)
      : rest_(reinterpret_cast<const char*>(file.data()), file.size()), source_(source) {}

  Header header() {
    Header header;
    if (line() != "ply") fail("a PLY file", "another beginning");
    for (std::string_view text = line(); text != "end_header"; text = line())
      addToHeader(words(text), header);
    for (const Element& element : header.elements) checkCount(element);
    return header;
  }

  double value(const Header& header, Type type) {
    return header.ascii ? textValue() : binaryValue(type, header.order);
  }
  /// The length of a list, each entry of which takes at least a byte.
  std::size_t listLength(const Header& header, const Property& property) {
    const double length = value(header, property.countType);
    if (!(length >= 0 && length <= static_cast<double>(rest_.size())))
      fail("lists that end within the file", fmt::format("one of {} entries", length));
    return static_cast<std::size_t>(length);
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error(Fault::Input, fmt::format("{}: expected {}, found {}", source_, expected, found));
  }

 private:
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("a whole PLY header", "its end missing");
    std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }
  static std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> all;
    while (!text.empty()) {
      const std::size_t length = std::min(text.find(' '), text.size());
      if (length > 0) all.push_back(text.substr(0, length));
      text.remove_prefix(std::min(length + 1, text.size()));
    }
    return all;
  }

  void addToHeader(const std::vector<std::string_view>& words, Header& header) const {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return;
    if (words[0] == "format" && words.size() >= 2) return addFormat(words[1], header);
    if (words[0] == "element" && words.size() == 3) return addElement(words, header);
    if (words[0] == "property" && !header.elements.empty() && words.size() >= 3)
      return addProperty(words, header.elements.back());
    fail("a PLY header", "a line that is none of one");
  }
  void addFormat(std::string_view format, Header& header) const {
    header.ascii = format == "ascii";
    header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (!header.ascii && format != "binary_little_endian" && format != "binary_big_endian")
      fail("a PLY format of ascii or binary", "another");
  }
  void addElement(const std::vector<std::string_view>& words, Header& header) const {
    constexpr std::size_t kMostElements = 64;
    Element& element = header.elements.emplace_back();
    element.name = words[1];
    const char* end = words[2].data() + words[2].size();
    if (std::from_chars(words[2].data(), end, element.count).ptr != end ||
        header.elements.size() > kMostElements)
      fail("PLY elements and their counts", "something else");
  }
  void addProperty(const std::vector<std::string_view>& words, Element& element) const {
    constexpr std::size_t kMostProperties = 256;
    Property property;
    property.isList = words[1] == "list";
    bool known = property.isList ? words.size() == 5 && readType(words[2], property.countType) &&
                                       readType(words[3], property.type)
                                 : words.size() == 3 && readType(words[1], property.type);
    known = known && element.properties.size() < kMostProperties;
    if (!known) fail("PLY properties of known types", "another");
    property.name = words.back();
    element.properties.push_back(std::move(property));
  }
  /// Every entry takes at least one byte of what is left.
  void checkCount(const Element& element) const {
    if (element.count > rest_.size())
      fail(fmt::format("{} entries of '{}'", element.count, element.name.substr(0, 40)),
           "a file that is too short for them");
  }

  double textValue() {
    const std::size_t start = rest_.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) fail("a whole PLY file", "its end missing");
    rest_.remove_prefix(start);
    double value = 0;
    const char* const end = rest_.data() + rest_.size();
    const auto [next, fault] = std::from_chars(rest_.data(), end, value);
    const bool ended =
        next == end || std::string_view(" \t\r\n").find(*next) != std::string_view::npos;
    if (fault != std::errc() || !ended)
      fail("numbers", fmt::format("'{}'", printable(rest_.substr(0, 20))));
    rest_.remove_prefix(static_cast<std::size_t>(next - rest_.data()));
    return value;
  }
  static std::string printable(std::string_view text) {
    std::string shown(text.substr(0, text.find_first_of("\r\n")));
    std::ranges::replace_if(
        shown, [](char c) { return c < ' ' || c > '~'; }, '?');
    return shown;
  }

  double binaryValue(Type type, std::endian order) {
    const std::size_t size = bytesOf(type);
    if (rest_.size() < size) fail("a whole PLY file", "its end missing");
    std::array<char, 8> bytes{};
    std::copy_n(rest_.data(), size, bytes.begin());
    rest_.remove_prefix(size);
    if (order != std::endian::native)
      std::reverse(bytes.begin(), bytes.begin() + static_cast<long>(size));
    switch (type) {
      case Type::Int8:
        return as<std::int8_t>(bytes);
      case Type::Uint8:
        return as<std::uint8_t>(bytes);
      case Type::Int16:
        return as<std::int16_t>(bytes);
      case Type::Uint16:
        return as<std::uint16_t>(bytes);
      case Type::Int32:
        return as<std::int32_t>(bytes);
      case Type::Uint32:
        return as<std::uint32_t>(bytes);
      case Type::Float:
        return static_cast<double>(as<float>(bytes));
      case Type::Double:
        break;
    }
    return as<double>(bytes);
  }
  template <typename T>
  static T as(const std::array<char, 8>& bytes) {
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::string_view rest_;
  const std::string& source_;
};

/// The places of named properties in an element; -1: not there.
template <std::size_t N>
std::array<int, N> find(const Element& element, const std::array<std::string_view, N>& names) {
  std::array<int, N> places{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto found = std::ranges::find(element.properties, names[i], &Property::name);
    places[i] = found == element.properties.end() || found->isList
                    ? -1
                    : static_cast<int>(found - element.properties.begin());
  }
  return places;
}

template <std::size_t N>
bool all(const std::array<int, N>& places) {
  return std::ranges::all_of(places, [](int place) { return place >= 0; });
}

/// Which columns of the vertices are taken.
struct VertexColumns {
  std::array<int, 3> position, normal, colour;
  std::array<int, 2> texcoord;
  float colourScale = 1;

  explicit VertexColumns(const Element& vertex)
      : position(find<3>(vertex, {"x", "y", "z"})),
        normal(find<3>(vertex, {"nx", "ny", "nz"})),
        colour(find<3>(vertex, {"red", "green", "blue"})),
        texcoord(find<2>(vertex, {"u", "v"})) {
    if (!all(colour)) colour = find<3>(vertex, {"diffuse_red", "diffuse_green", "diffuse_blue"});
    if (!all(texcoord)) texcoord = find<2>(vertex, {"s", "t"});
    if (!all(texcoord)) texcoord = find<2>(vertex, {"texture_u", "texture_v"});
    if (all(colour)) {
      const Type type = vertex.properties[static_cast<std::size_t>(colour[0])].type;
      if (type == Type::Uint8) colourScale = 1.0F / 255;
      if (type == Type::Uint16) colourScale = 1.0F / 65535;
    }
  }
  bool takes(int column) const {
    const auto in = [&](const auto& places) {
      return std::ranges::find(places, column) != places.end();
    };
    return in(position) || (all(normal) && in(normal)) || (all(colour) && in(colour)) ||
           (all(texcoord) && in(texcoord));
  }
};

void addVertex(const std::vector<double>& row, const VertexColumns& columns, TriangleMesh& mesh) {
  const auto at = [&](int column) {
    return static_cast<float>(row[static_cast<std::size_t>(column)]);
  };
  const auto three = [&](const std::array<int, 3>& c) {
    return std::array{at(c[0]), at(c[1]), at(c[2])};
  };
  mesh.positions.push_back(three(columns.position));
  if (all(columns.normal)) mesh.normals.push_back(three(columns.normal));
  if (all(columns.texcoord))
    mesh.texcoords.push_back({at(columns.texcoord[0]), at(columns.texcoord[1])});
  if (all(columns.colour)) {
    const auto c = three(columns.colour);
    mesh.colours.push_back({linearFromDisplay(c[0] * columns.colourScale),
                            linearFromDisplay(c[1] * columns.colourScale),
                            linearFromDisplay(c[2] * columns.colourScale)});
  }
}

/// A polygon as a fan.
void addFace(const std::vector<double>& corners, TriangleMesh& mesh) {
  const auto index = [&](std::size_t i) {
    // Whatever is no index becomes one that no mesh has; the check of the mesh names it.
    const double value = corners[i];
    const bool fits = value >= 0 && value < 4294967295.0;
    return fits ? static_cast<std::uint32_t>(value) : std::numeric_limits<std::uint32_t>::max();
  };
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({index(0), index(i - 1), index(i)});
}

void readVertices(PlyReader& reader, const Header& header, const Element& element,
                  TriangleMesh& mesh, std::vector<std::string>& ignored) {
  const VertexColumns columns(element);
  if (!all(columns.position)) reader.fail("vertices with x, y and z", "others");
  for (std::size_t p = 0; p < element.properties.size(); ++p)
    if (!columns.takes(static_cast<int>(p))) ignored.push_back(element.properties[p].name);
  std::vector<double> row(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < row.size(); ++p) {
      if (element.properties[p].isList) reader.fail("vertices of single numbers", "a list");
      row[p] = reader.value(header, element.properties[p].type);
    }
    addVertex(row, columns, mesh);
  }
}

bool holdsFaces(const Property& property) {
  return property.isList && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Faces, and all elements that are only passed over.
void readOthers(PlyReader& reader, const Header& header, const Element& element,
                TriangleMesh& mesh) {
  std::vector<double> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      const std::size_t count = property.isList ? reader.listLength(header, property) : 1;
      corners.clear();
      for (std::size_t k = 0; k < count; ++k)
        corners.push_back(reader.value(header, property.type));
      if (element.name == "face" && holdsFaces(property)) addFace(corners, mesh);
    }
  }
}

}  // namespace

TriangleMesh meshFromPly(std::span<const std::byte> file, const std::string& source,
                         std::vector<std::string>& remarks) {
  PlyReader reader(file, source);
  const Header header = reader.header();
  TriangleMesh mesh;
  std::vector<std::string> ignored;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      readVertices(reader, header, element, mesh, ignored);
    } else {
      if (element.name != "face") ignored.push_back(element.name);
      readOthers(reader, header, element, mesh);
    }
  }
  if (!ignored.empty())
    remarks.push_back(fmt::format("{}: '{}' {} not used", source, fmt::join(ignored, "', '"),
                                  ignored.size() == 1 ? "is" : "are"));
  return mesh;
}

}  // namespace illum
