#include "scene/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A;
constexpr std::size_t kHeader = 12, kChunkHeader = 8;

std::uint32_t littleEndian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

bool isBinary(std::span<const std::byte> file) {
  return file.size() >= 4 && littleEndian(file, 0) == kMagic;
}

std::span<const std::byte> secondChunk(std::span<const std::byte> rest) {
  if (rest.size() < kChunkHeader) return {};
  const std::size_t bytes = littleEndian(rest, 0);
  return rest.subspan(kChunkHeader, std::min(bytes, rest.size() - kChunkHeader));
}

}  // namespace

GltfParts gltfParts(std::span<const std::byte> file, const std::string& source) {
  const auto* text = reinterpret_cast<const char*>(file.data());
  if (!isBinary(file)) return {{text, file.size()}, {}};
  constexpr std::size_t kText = kHeader + kChunkHeader;
  if (file.size() < kText || littleEndian(file, 4) != kVersion ||
      littleEndian(file, kHeader + 4) != kJsonChunk ||
      littleEndian(file, kHeader) > file.size() - kText)
    throw Error(
        Fault::Input,
        fmt::format("{}: expected a whole binary glTF 2 file, found a damaged one", source));
  const std::size_t bytes = littleEndian(file, kHeader);
  return {{text + kText, bytes}, secondChunk(file.subspan(kText + bytes))};
}

std::vector<std::byte> withJson(std::span<const std::byte> file, const GltfParts& parts,
                                std::string json) {
  std::vector<std::byte> out;
  const auto append = [&](std::span<const std::byte> bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
  };
  if (!isBinary(file)) {
    append(std::as_bytes(std::span(json)));
    return out;
  }
  const auto word = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8)
      out.push_back(static_cast<std::byte>(value >> shift));
  };
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto rest = file.subspan(kHeader + kChunkHeader + parts.json.size());
  word(kMagic), word(kVersion), word(kHeader + kChunkHeader + json.size() + rest.size());
  word(json.size()), word(kJsonChunk);
  append(std::as_bytes(std::span(json)));
  append(rest);
  return out;
}

}  // namespace illum
