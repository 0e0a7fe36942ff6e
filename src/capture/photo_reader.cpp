#include "capture/photo_reader.h"

#include <algorithm>
#include <string>

#include "capture/jpeg_reader.h"
#include "capture/png_reader.h"
#include "capture/webp_reader.h"
#include "core/memory.h"
#include "illum/error.h"
#include "oiio/oiio_module.h"

namespace illum {
namespace {

const OiioModule& moduleFor(const FilePool& pool, std::size_t file, PhotographFormat format) {
  return oiioModule(pool.path(file).string(), titleOf(format));
}

// Bytes a pixel that readers which decode at once need at their worst, measured with
// OpenImageIO 2.4.
constexpr std::uint64_t kWorstBytesPerPixel = 24;
// Far beyond any camera, and small enough that no product of sizes overflows 64 bits.
constexpr int kLongestSide = 1 << 20;

void checkDeclaredSize(const std::filesystem::path& path, Size size, std::uint64_t memoryBytes) {
  const std::uint64_t needed = kWorstBytesPerPixel * size.pixels();
  if (needed <= memoryBytes) return;
  throw Error(Fault::Machine, path.string() + ": decoding its " + std::to_string(size.width) + "x" +
                                  std::to_string(size.height) + " pixels needs " +
                                  textFromBytes(needed) + " of memory, --max-memory leaves " +
                                  textFromBytes(memoryBytes));
}

PhotographHeader readHeaderOf(FilePool& pool, std::size_t file, PhotographFormat format,
                              std::span<const std::byte> head) {
  switch (format) {
    case PhotographFormat::Jpeg:
      return readJpegHeader(pool, file);
    case PhotographFormat::Png:
      return readPngHeader(pool, file);
    case PhotographFormat::WebP:
      return readWebpHeader(pool, file);
    default:
      return moduleFor(pool, file, format).readHeader(pool, file, format, head);
  }
}

}  // namespace

PhotographHeader readHeader(FilePool& pool, std::size_t file, std::uint64_t memoryBytes) {
  const std::filesystem::path path = pool.path(file);
  std::vector<std::byte> head(kHeadBytes);
  head.resize(pool.read(file, 0, head));
  const PhotographFormat format = formatOfFile(path, head);
  if (const auto declared = declaredSize(path, format, head)) {
    checkDeclaredSize(path, *declared, memoryBytes);
  }
  PhotographHeader header = readHeaderOf(pool, file, format, head);
  if (header.stored.width < 1 || header.stored.height < 1 ||
      std::max(header.stored.width, header.stored.height) > kLongestSide) {
    throw inputError(
        path, "a picture of at most " + std::to_string(kLongestSide) + " pixels a side",
        std::to_string(header.stored.width) + "x" + std::to_string(header.stored.height));
  }
  return header;
}

std::unique_ptr<PhotographReader> openReader(FilePool& pool, std::size_t file,
                                             const PhotographHeader& header) {
  switch (header.format) {
    case PhotographFormat::Jpeg:
      return openJpegReader(pool, file, header);
    case PhotographFormat::Png:
      return openPngReader(pool, file, header);
    case PhotographFormat::WebP:
      return openWebpReader(pool, file, header);
    default:
      return moduleFor(pool, file, header.format).openReader(pool, file, header);
  }
}

}  // namespace illum
