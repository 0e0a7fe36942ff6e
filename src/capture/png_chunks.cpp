#include "capture/png_chunks.h"

#include <array>
#include <cstring>

#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kSignatureBytes = 8, kChunkHeadBytes = 8, kChunkFrameBytes = 12;
constexpr std::size_t kInterlaceAt = 28;  // method byte of IHDR, in the file

std::uint32_t bigEndian(const std::byte* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

}  // namespace

bool checkPngChunks(FilePool& pool, std::size_t file) {
  std::array<std::byte, kInterlaceAt + 1> head{};
  const bool whole = pool.read(file, 0, head) == head.size();
  std::array<std::byte, kChunkHeadBytes> chunk{};
  for (std::uint64_t at = kSignatureBytes; whole;) {
    if (pool.read(file, at, chunk) < chunk.size()) break;
    const std::uint64_t next = at + kChunkFrameBytes + bigEndian(chunk.data());
    if (next > pool.bytes(file)) break;
    if (std::memcmp(chunk.data() + 4, "IEND", 4) == 0) return head[kInterlaceAt] != std::byte{0};
    at = next;
  }
  throw inputError(pool.path(file), "an undamaged PNG picture", "its end too early");
}

}  // namespace illum
