// Writing a table: coded columns as the deflated bytes of basis/basis_file.h.
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "basis/basis_file.h"
#include "basis/column_coder.h"
#include "illum/error.h"

namespace illum {
namespace {

using namespace basisfile;

// An earlier column that much farther back is not tried as reference.
constexpr int kMaxReferenceDistance = 2;

std::uint32_t zigzag(std::int32_t code) {
  return code < 0 ? 2 * static_cast<std::uint32_t>(-(code + 1)) + 1
                  : 2 * static_cast<std::uint32_t>(code);
}

// The payload in sections of alike statistics, each of which gets a Huffman table of its own.
struct SectionedPayload {
  std::vector<std::uint8_t> bytes;
  std::vector<std::size_t> ends;
};

// All codes in the file's order.
std::vector<std::uint32_t> serialise(const CodeLayout& layout, const TableShape& shape,
                                     const std::vector<CodedColumn>& columns) {
  std::vector<std::uint32_t> codes(layout.codes());
  const std::size_t squareCodes = shape.order.steps.size();
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::vector<std::int32_t>& own = columns[column].codes;
    for (int square = 0; square < shape.squares; ++square) {
      for (const CodeLayout::Level& level : layout.levels()) {
        std::transform(
            own.begin() + static_cast<std::ptrdiff_t>(square * squareCodes + level.first),
            own.begin() + static_cast<std::ptrdiff_t>(square * squareCodes + level.last),
            codes.begin() + static_cast<std::ptrdiff_t>(layout.levelIndex(level, column, square)),
            zigzag);
      }
    }
    if (own.size() > shape.squares * squareCodes) {
      codes[layout.poleIndex(column)] = zigzag(own.back());
    }
  }
  return codes;
}

SectionedPayload payloadOf(const CodeLayout& layout, const std::vector<CodedColumn>& columns,
                           const std::vector<std::uint32_t>& codes, int bytesPerCode) {
  SectionedPayload payload;
  for (int array = 0; array < static_cast<int>(kColumnBytes); ++array) {
    for (const CodedColumn& column : columns) {
      const ColumnScale& s = column.scale;
      const int fields[] = {s.unitCode & 255, s.unitCode >> 8, s.weightCode & 255,
                            (s.weightCode >> 8) & 255, s.referenceDistance};
      payload.bytes.push_back(static_cast<std::uint8_t>(fields[array]));
    }
  }
  for (int b = bytesPerCode - 1; b >= 0; --b) {
    const std::size_t planeStart = payload.bytes.size();
    payload.ends.push_back(planeStart);
    for (const std::uint32_t code : codes) {
      payload.bytes.push_back(static_cast<std::uint8_t>(code >> (8 * b)));
    }
    for (std::size_t l = 1; l < layout.levels().size(); ++l) {
      payload.ends.push_back(planeStart + layout.levelIndex(layout.levels()[l], 0, 0));
    }
  }
  payload.ends.push_back(payload.bytes.size());
  return payload;
}

// `sectioned`: a new block of deflate for each section; otherwise as zlib likes.
std::vector<std::byte> deflated(const SectionedPayload& payload, int strategy, bool sectioned) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, strategy) !=
      Z_OK) {
    throw Error(Fault::Machine, "not enough memory to deflate a basis table");
  }
  std::vector<std::byte> out(deflateBound(&stream, payload.bytes.size()) +
                             64 * payload.ends.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  std::size_t start = 0;
  for (const std::size_t end : payload.ends) {
    const bool last = end == payload.bytes.size();
    stream.next_in = const_cast<Bytef*>(payload.bytes.data() + start);  // only read
    stream.avail_in = static_cast<uInt>(end - start);
    deflate(&stream, last ? Z_FINISH : sectioned ? Z_BLOCK : Z_NO_FLUSH);
    start = end;
    if (last) break;
  }
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::vector<std::byte> smallestDeflated(const SectionedPayload& payload) {
  constexpr std::array kStrategies{Z_DEFAULT_STRATEGY, Z_FILTERED, Z_RLE, Z_HUFFMAN_ONLY};
  std::array<std::vector<std::byte>, 2 * kStrategies.size()> trials;
  tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t i) {
    trials[i] = deflated(payload, kStrategies[i / 2], i % 2 != 0);
  });
  return *std::ranges::min_element(trials, {}, &std::vector<std::byte>::size);
}

std::vector<std::byte> fileOf(const Header& header, std::span<const std::byte> deflatedPayload) {
  std::vector<std::byte> file;
  const auto put = [&file](std::uint64_t value, int size) {
    for (int b = 0; b < size; ++b) file.push_back(static_cast<std::byte>(value >> (8 * b) & 255));
  };
  for (const char c : {'I', 'L', 'B', 'T'}) put(static_cast<unsigned char>(c), 1);
  put(1, 1);
  put(header.domain == LightDomain::Sphere ? 1 : 0, 1);
  put(static_cast<std::uint64_t>(header.resolution), 2);
  put(header.columns, 4);
  put(static_cast<std::uint64_t>(header.bytesPerCode), 1);
  put(0, 3);
  put(deflatedPayload.size(), 4);
  file.insert(file.end(), deflatedPayload.begin(), deflatedPayload.end());
  return file;
}

void requireFinite(std::span<const float> values) {
  for (const float v : values) {
    // Beyond 2^60 no unit fits; nothing that lights a picture comes near.
    if (!(std::abs(v) < 0x1p60F)) {
      throw Error(Fault::Input, "basis table: expected finite values, found " + std::to_string(v));
    }
  }
}

// A column's reachable samples, square by square.
std::vector<float> columnValues(const BasisTable& table, const TableShape& shape, int column) {
  std::vector<float> values(shape.samples * shape.squares, 0.0F);
  for (int square = 0; square < shape.squares; ++square) {
    const std::size_t source = static_cast<std::size_t>(square) * table.columns() + column;
    for (const CodingStep& step : shape.order.steps) {
      values[square * shape.samples + step.sample] =
          table.values()[source * shape.samples + step.sample];
    }
  }
  return values;
}

Header headerOf(const BasisTable& table) {
  Header header;
  header.domain = table.domain();
  header.resolution = table.resolution();
  header.columns = static_cast<std::uint32_t>(table.columns());
  return header;
}

}  // namespace

std::vector<std::byte> BasisTable::encode() {
  if (!encoded_.empty() && decode(encoded_, "basis table") == *this) return encoded_;
  requireFinite(values_);
  requireFinite(southPole_);
  const TableShape shape(*this);
  std::vector<CodedColumn> coded(columns_);
  for (int c = 0; c < columns_; ++c) {
    const std::vector<float> values = columnValues(*this, shape, c);
    const double error =
        storedErrors_.empty() ? storedError_ * shape.rmsOverDisc(values) : storedErrors_[c];
    ColumnCoder coder(shape, values, southPole_.empty() ? nullptr : &southPole_[c]);
    for (int distance = 0; distance <= std::min(c, kMaxReferenceDistance); ++distance) {
      const CodedColumn* reference = distance == 0 ? nullptr : &coded[c - distance];
      CodedColumn trial = coder.codeWithin(error, reference, distance);
      if (trial.cost < coded[c].cost) coded[c] = std::move(trial);
    }
  }

  // From here on the table is what its file says.
  for (int c = 0; c < columns_; ++c) {
    for (int square = 0; square < shape.squares; ++square) {
      const std::size_t target = static_cast<std::size_t>(square) * columns_ + c;
      std::copy_n(coded[c].values.begin() + static_cast<std::ptrdiff_t>(square * shape.samples),
                  shape.samples,
                  values_.begin() + static_cast<std::ptrdiff_t>(target * shape.samples));
    }
    if (!southPole_.empty()) southPole_[c] = coded[c].pole;
  }
  Header header = headerOf(*this);
  const CodeLayout layout(header);
  const std::vector<std::uint32_t> codes = serialise(layout, shape, coded);
  const std::uint32_t largest = *std::max_element(codes.begin(), codes.end());
  while (header.bytesPerCode < 4 && largest >> (8 * header.bytesPerCode) != 0) {
    ++header.bytesPerCode;
  }
  const SectionedPayload payload = payloadOf(layout, coded, codes, header.bytesPerCode);
  encoded_ = fileOf(header, smallestDeflated(payload));
  return encoded_;
}

}  // namespace illum
