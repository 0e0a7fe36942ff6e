#include "basis/basis_file.h"

#include <zlib.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "illum/error.h"

namespace illum {
namespace basisfile {

double ColumnScale::unit() const {
  return std::ldexp(16 + (unitCode & 15), (unitCode >> 4) - 96);
}

std::int32_t predictPole(std::span<const std::int32_t> field, int resolution) {
  const std::size_t side = resolution + 2, last = resolution, middle = (resolution + 1) / 2;
  return (field[side + middle] + field[middle * side + 1] + field[middle * side + last] +
          field[last * side + middle] + 2) >>
         2;
}

CodeLayout::CodeLayout(const Header& header)
    : columns_(header.columns),
      squares_(header.squares()),
      poles_(header.polesPerColumn() * columns_),
      order_(header.resolution) {
  const std::vector<CodingStep>& steps = order_.steps;
  for (std::size_t first = 0; first < steps.size();) {
    std::size_t last = first;
    while (last < steps.size() && steps[last].level == steps[first].level) ++last;
    levels_.push_back({first, last});
    first = last;
  }
}

std::size_t CodeLayout::codes() const {
  return poles_ + columns_ * squares_ * order_.steps.size();
}

std::size_t CodeLayout::levelIndex(const Level& level, std::size_t column, int square) const {
  return poles_ + columns_ * squares_ * level.first +
         (column * squares_ + square) * (level.last - level.first);
}

}  // namespace basisfile

namespace {

using namespace basisfile;

// Reads one table's bytes; every complaint names the source.
class TableReader {
 public:
  TableReader(std::span<const std::byte> bytes, const std::string& source)
      : bytes_(bytes), source_(source) {}

  Header readHeader() const;
  std::vector<std::uint8_t> inflatePayload(const Header& header, std::size_t payloadSize) const;
  void require(bool holds, const char* expected, std::uint64_t found) const {
    if (!holds) throw inputError(source_, expected, std::to_string(found));
  }

 private:
  std::uint32_t integer(std::size_t offset, int size) const {
    std::uint32_t value = 0;
    for (int b = 0; b < size; ++b) {
      value |= std::to_integer<std::uint32_t>(bytes_[offset + b]) << (8 * b);
    }
    return value;
  }

  std::span<const std::byte> bytes_;
  const std::string& source_;
};

Header TableReader::readHeader() const {
  require(bytes_.size() >= kHeaderBytes, "a basis table of at least 20 bytes", bytes_.size());
  if (std::memcmp(bytes_.data(), "ILBT", 4) != 0) {
    throw inputError(source_, "a basis table that begins with \"ILBT\"", "other bytes");
  }
  require(integer(4, 1) == 1, "a basis table of version 1", integer(4, 1));
  require(integer(5, 1) <= 1, "a basis table's domain 0 or 1", integer(5, 1));
  require(integer(13, 3) == 0, "a basis table's reserved bytes 0", integer(13, 3));
  Header header;
  header.domain = integer(5, 1) == 1 ? LightDomain::Sphere : LightDomain::Hemisphere;
  header.resolution = static_cast<int>(integer(6, 2));
  header.columns = integer(8, 4);
  header.bytesPerCode = static_cast<int>(integer(12, 1));
  header.payloadBytes = integer(16, 4);
  require(header.resolution >= kMinResolution && header.resolution <= kMaxResolution,
          "a basis table's resolution of 4 to 1025", header.resolution);
  require(header.bytesPerCode >= 1 && header.bytesPerCode <= 4,
          "a basis table's codes of 1 to 4 bytes", header.bytesPerCode);
  const std::uint64_t side = header.resolution + 2;
  const std::uint64_t values = header.squares() * side * side * header.columns;
  require(header.columns >= 1 && values <= kMaxValues, "a basis table of 1 to 2^24 values", values);
  require(header.payloadBytes == bytes_.size() - kHeaderBytes,
          "a basis table's payload to fill the rest of it, in bytes", header.payloadBytes);
  return header;
}

std::vector<std::uint8_t> TableReader::inflatePayload(const Header& header,
                                                      std::size_t payloadSize) const {
  require(payloadSize <= kMaxDeflateRatio * header.payloadBytes,
          "a basis table's payload as long as its header says, in bytes", header.payloadBytes);
  std::vector<std::uint8_t> payload(payloadSize);
  uLongf inflated = payload.size();
  uLong used = header.payloadBytes;
  const auto* deflated = reinterpret_cast<const Bytef*>(bytes_.data() + kHeaderBytes);
  const int result = uncompress2(payload.data(), &inflated, deflated, &used);
  if (result != Z_OK || inflated != payload.size() || used != header.payloadBytes) {
    throw inputError(source_,
                     "a basis table's payload of " + std::to_string(payloadSize) + " bytes",
                     "a damaged one");
  }
  return payload;
}

// The inflated payload, field by field.
class Payload {
 public:
  Payload(std::vector<std::uint8_t> bytes, std::size_t columns, std::size_t codes, int bytesPerCode)
      : bytes_(std::move(bytes)), columns_(columns), codes_(codes), bytesPerCode_(bytesPerCode) {}

  ColumnScale scale(std::size_t column) const {
    const auto byte = [&](int array) { return bytes_[array * columns_ + column]; };
    return {static_cast<std::uint16_t>(byte(0) | byte(1) << 8),
            static_cast<std::int16_t>(byte(2) | byte(3) << 8), byte(4)};
  }

  std::int64_t code(std::size_t index) const {
    const std::uint8_t* byte = bytes_.data() + kColumnBytes * columns_ + index;
    std::uint32_t zigzag = 0;
    for (int b = 0; b < bytesPerCode_; ++b, byte += codes_) zigzag = zigzag << 8 | *byte;
    const std::int64_t half = zigzag >> 1;
    return (zigzag & 1) != 0 ? -half - 1 : half;
  }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t columns_, codes_;
  int bytesPerCode_;
};

// Turns codes into values, a column at a time.
class TableDecoder {
 public:
  TableDecoder(const Header& header, const CodeLayout& layout, const Payload& payload,
               const std::string& source, BasisTable& table)
      : header_(header),
        layout_(layout),
        payload_(payload),
        source_(source),
        table_(table),
        samples_(static_cast<std::size_t>(table.side()) * table.side()),
        field_(samples_) {}

  void decodeColumn(std::size_t column);

 private:
  float checked(double value) const {
    if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
      throw inputError(source_, "finite values in a basis table", "an infinite one");
    }
    return static_cast<float>(value);
  }
  std::int32_t checkedField(std::int64_t value) const {
    if (value > kMaxFieldValue || value < -kMaxFieldValue) {
      throw inputError(source_, "a basis table's fields within 2^26", std::to_string(value));
    }
    return static_cast<std::int32_t>(value);
  }
  ColumnScale checkedScale(std::size_t column) const;
  void decodeField(std::size_t column, int square);

  const Header& header_;
  const CodeLayout& layout_;
  const Payload& payload_;
  const std::string& source_;
  BasisTable& table_;
  std::size_t samples_;
  std::vector<std::int32_t> field_;
};

ColumnScale TableDecoder::checkedScale(std::size_t column) const {
  const ColumnScale scale = payload_.scale(column);
  if (scale.unitCode > kMaxUnitCode) {
    throw inputError(source_, "a basis table's unit code of at most 2047",
                     std::to_string(scale.unitCode));
  }
  if (scale.referenceDistance > column || (scale.referenceDistance == 0 && scale.weightCode != 0)) {
    throw inputError(source_, "a basis table's columns to refer to earlier ones",
                     "a distance of " + std::to_string(scale.referenceDistance) + " in column " +
                         std::to_string(column));
  }
  return scale;
}

void TableDecoder::decodeField(std::size_t column, int square) {
  const std::vector<CodingStep>& steps = layout_.order().steps;
  for (const CodeLayout::Level& level : layout_.levels()) {
    std::size_t index = layout_.levelIndex(level, column, square);
    const std::int64_t units = unitsPerCode(steps[level.first].level);
    for (std::size_t s = level.first; s < level.last; ++s, ++index) {
      field_[steps[s].sample] =
          checkedField(predict(steps[s], field_) + units * payload_.code(index));
    }
  }
}

void TableDecoder::decodeColumn(std::size_t column) {
  const ColumnScale scale = checkedScale(column);
  const double unit = scale.unit(), weight = scale.weight();
  for (int square = 0; square < header_.squares(); ++square) {
    decodeField(column, square);
    float* out = table_.values().data() + (square * header_.columns + column) * samples_;
    const float* reference = out - scale.referenceDistance * samples_;
    for (const CodingStep& step : layout_.order().steps) {
      out[step.sample] =
          checked(valueOf(field_[step.sample], unit, weight, reference[step.sample]));
    }
  }
  if (header_.polesPerColumn() == 0) return;
  const std::int32_t pole =
      checkedField(predictPole(field_, header_.resolution) +
                   kPoleUnitsPerCode * payload_.code(layout_.poleIndex(column)));
  const float reference = table_.southPole()[column - scale.referenceDistance];
  table_.southPole()[column] = checked(valueOf(pole, unit, weight, reference));
}

}  // namespace

BasisTable BasisTable::decode(std::span<const std::byte> bytes, const std::string& source) {
  const TableReader reader(bytes, source);
  const Header header = reader.readHeader();
  const CodeLayout layout(header);
  const std::size_t size = kColumnBytes * header.columns + header.bytesPerCode * layout.codes();
  const Payload payload(reader.inflatePayload(header, size), header.columns, layout.codes(),
                        header.bytesPerCode);
  BasisTable table(header.domain, header.resolution, static_cast<int>(header.columns));
  TableDecoder decoder(header, layout, payload, source, table);
  for (std::size_t column = 0; column < header.columns; ++column) decoder.decodeColumn(column);
  table.encoded_.assign(bytes.begin(), bytes.end());
  return table;
}

}  // namespace illum
