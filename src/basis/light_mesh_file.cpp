// The bytes of a mesh of lights (docs/format.md, "Directions").
#include <bit>
#include <cstring>

#include "basis/light_mesh.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr char kMagic[4] = {'I', 'L', 'B', 'D'};
constexpr std::size_t kHeaderBytes = 16, kSiteBytes = 24, kTriangleBytes = 6;
constexpr std::uint8_t kVersion = 1;

template <typename Integer>
void append(std::vector<std::byte>& bytes, Integer value) {
  for (std::size_t b = 0; b < sizeof value; ++b)
    bytes.push_back(static_cast<std::byte>(value >> (8 * b) & 255));
}

template <typename Integer>
Integer take(std::span<const std::byte>& bytes) {
  Integer value = 0;
  for (std::size_t b = 0; b < sizeof value; ++b)
    value = static_cast<Integer>(value | std::to_integer<Integer>(bytes[b]) << (8 * b));
  bytes = bytes.subspan(sizeof value);
  return value;
}

}  // namespace

std::vector<std::byte> LightMesh::encode() const {
  std::vector<std::byte> bytes;
  for (const char c : kMagic) bytes.push_back(static_cast<std::byte>(c));
  append(bytes, std::uint32_t{kVersion});  // and three bytes of 0
  append(bytes, static_cast<std::uint32_t>(lights_));
  append(bytes, static_cast<std::uint32_t>(sites_.size()) - static_cast<std::uint32_t>(lights_));
  for (const Vector3& site : sites_)
    for (const double value : {site.x, site.y, site.z})
      append(bytes, std::bit_cast<std::uint64_t>(value));
  for (const Triangle& triangle : triangles_)
    for (const std::uint16_t corner : triangle) append(bytes, corner);
  return bytes;
}

LightMesh LightMesh::decode(std::span<const std::byte> bytes, const std::string& source) {
  const std::size_t size = bytes.size();
  if (size < kHeaderBytes || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    throw inputError(source, "a basis of directions that begins with \"ILBD\"", "other bytes");
  bytes = bytes.subspan(sizeof kMagic);
  if (const auto version = take<std::uint32_t>(bytes); version != kVersion)
    throw inputError(source, "a basis of directions of version 1", std::to_string(version));
  const auto lights = take<std::uint32_t>(bytes), closing = take<std::uint32_t>(bytes);
  if (lights > kMaxLights || closing > kMaxClosing)
    throw inputError(source, "1 to 768 lights and at most 64 closing directions",
                     std::to_string(lights) + " and " + std::to_string(closing));
  const std::size_t sites = lights + closing, triangles = sites < 4 ? 0 : 2 * sites - 4;
  if (const std::size_t expected = kHeaderBytes + kSiteBytes * sites + kTriangleBytes * triangles;
      size != expected)
    throw inputError(source, std::to_string(expected) + " bytes of directions and triangles",
                     std::to_string(size));
  std::vector<Vector3> directions(sites);
  for (Vector3& site : directions)
    for (double* value : {&site.x, &site.y, &site.z})
      *value = std::bit_cast<double>(take<std::uint64_t>(bytes));
  std::vector<Triangle> corners(triangles);
  for (Triangle& triangle : corners)
    for (std::uint16_t& corner : triangle) corner = take<std::uint16_t>(bytes);
  return {std::move(directions), static_cast<int>(lights), std::move(corners), source};
}

}  // namespace illum
