#include "capture/mask_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "capture/photo_reader.h"
#include "capture/sample_rows.h"
#include "core/memory.h"
#include "illum/error.h"

namespace illum {
namespace {

void checkMask(const std::filesystem::path& path, const PhotographHeader& header, Size expected,
               std::uint64_t memoryBytes) {
  const Size size = header.upright();
  if (size != expected) {
    throw inputError(path, fmt::format("a mask of {}x{} pixels", expected.width, expected.height),
                     fmt::format("{}x{}", size.width, size.height));
  }
  const std::uint64_t needed = header.decoderBytes + expected.pixels();
  if (needed > memoryBytes) {
    throw Error(Fault::Machine,
                fmt::format("{}: reading the mask needs at least {} of memory, --max-memory gives "
                            "it {}",
                            path.string(), textFromBytes(needed), textFromBytes(memoryBytes)));
  }
}

}  // namespace

BytePicture readMaskPicture(FilePool& pool, std::size_t file, Size expected,
                            std::uint64_t memoryBytes) {
  const PhotographHeader header = readHeader(pool, file, memoryBytes);
  checkMask(pool.path(file), header, expected, memoryBytes);
  const auto reader = openReader(pool, file, header);
  const RowConverter converter(header.type, header.channels(), Transfer::Linear, {1, 1, 1});
  const auto step = static_cast<std::ptrdiff_t>(header.channels()) *
                    static_cast<std::ptrdiff_t>(bytesOf(header.type));
  const auto width = static_cast<std::size_t>(header.stored.width);
  std::vector<std::byte> samples(header.rowBytes());
  std::vector<float> r(width), g(width), b(width), alpha(width);
  BytePicture mask(expected, 1);
  for (int y = 0; y < header.stored.height; ++y) {
    reader->read(1, samples.data());
    const std::array<float*, 3> rgb{r.data(), g.data(), b.data()};
    converter.toTransfer(samples.data(), step, width, rgb);
    converter.alpha(samples.data(), step, width, alpha.data());
    for (std::size_t x = 0; x < width; ++x) {
      const auto at = header.orientation.uprightFromStored(header.stored, {static_cast<int>(x), y});
      mask.at(at.x, at.y, 0) = byteFromUnit((r[x] + g[x] + b[x]) / 3 * alpha[x]);
    }
  }
  return mask;
}

}  // namespace illum
