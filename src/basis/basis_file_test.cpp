#include "basis/basis_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "basis/chart.h"
#include "illum/error.h"

namespace illum {
namespace {

using basisfile::kHeaderBytes;
using Bytes = std::vector<std::byte>;

// Smooth columns of growing detail, some of them nearly multiples of others.
BasisTable smoothTable(LightDomain domain, int n, int columns) {
  BasisTable table(domain, n, columns);
  table.fill([columns](Direction d, std::span<double> out) {
    for (int c = 0; c < columns; ++c) {
      const double detail = 1 + c / 3;
      out[c] =
          std::sin(detail * d.x() + 0.3) * std::cos(detail * d.y() * d.z()) * (1 + 0.2 * (c % 3)) +
          0.02 * (c % 3) * d.y() + (c == 4 ? 100 : 0);
    }
  });
  return table;
}

double rms(const BasisTable& table, const BasisTable* other, int column) {
  double sum = 0;
  int count = 0;
  const int n = table.resolution(), side = table.side();
  for (int square = 0; square < table.squares(); ++square) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (std::hypot(2.0 * i / (n - 1) - 1, 2.0 * j / (n - 1) - 1) > 1 + 1e-12) continue;
        const std::size_t at =
            ((square * table.columns() + column) * static_cast<std::size_t>(side) + j + 1) * side +
            i + 1;
        const double value = table.values()[at] - (other ? other->values()[at] : 0.0F);
        sum += value * value;
        ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

std::uint32_t littleEndian(const Bytes& bytes, std::size_t offset, int size) {
  std::uint32_t value = 0;
  for (int b = size - 1; b >= 0; --b) {
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + b]);
  }
  return value;
}

void setLittleEndian(Bytes& bytes, std::size_t offset, int size, std::uint32_t value) {
  for (int b = 0; b < size; ++b) bytes[offset + b] = static_cast<std::byte>(value >> (8 * b) & 255);
}

std::vector<std::uint8_t> inflated(const Bytes& bytes) {
  std::vector<std::uint8_t> payload(1 << 20);
  uLongf size = payload.size();
  const auto* deflated = reinterpret_cast<const Bytef*>(bytes.data() + kHeaderBytes);
  EXPECT_EQ(uncompress(payload.data(), &size, deflated, bytes.size() - kHeaderBytes), Z_OK);
  payload.resize(size);
  return payload;
}

Bytes withPayload(Bytes bytes, const std::vector<std::uint8_t>& payload) {
  uLongf size = compressBound(payload.size());
  bytes.resize(kHeaderBytes + size);
  auto* deflated = reinterpret_cast<Bytef*>(bytes.data() + kHeaderBytes);
  EXPECT_EQ(compress(deflated, &size, payload.data(), payload.size()), Z_OK);
  bytes.resize(kHeaderBytes + size);
  setLittleEndian(bytes, 16, 4, static_cast<std::uint32_t>(size));
  return bytes;
}

// The slow, obviously right decoder: basis_file.h read aloud, with a map for the known samples and
// no tables made in advance.
class SlowDecoder {
 public:
  explicit SlowDecoder(const Bytes& bytes)
      : squares_(static_cast<int>(littleEndian(bytes, 5, 1)) + 1),
        n_(static_cast<int>(littleEndian(bytes, 6, 2))),
        columns_(littleEndian(bytes, 8, 4)),
        bytesPerCode_(littleEndian(bytes, 12, 1)),
        side_(n_ + 2),
        centre_(side_ / 2),
        reachable_(reachableSamples(n_)),
        payload_(inflated(bytes)),
        codes_((payload_.size() - 5 * columns_) / bytesPerCode_) {}

  BasisTable decode() {
    BasisTable table(squares_ == 2 ? LightDomain::Sphere : LightDomain::Hemisphere, n_,
                     static_cast<int>(columns_));
    std::vector<std::int64_t> poleCodes;
    if (squares_ == 1) {
      for (std::size_t c = 0; c < columns_; ++c) poleCodes.push_back(nextCode());
    }
    fields_.resize(columns_ * squares_);
    int coarsest = 1;
    while (2 * coarsest <= centre_) coarsest *= 2;
    for (Field& field : fields_) field[{centre_, centre_}] = units(2 * coarsest) * nextCode();
    for (int stride = coarsest; stride >= 1; stride /= 2) {
      for (Field& field : fields_) {
        addPass(field, stride, true);
        addPass(field, stride, false);
      }
    }
    for (std::size_t c = 0; c < columns_; ++c) writeColumn(table, c, poleCodes);
    return table;
  }

 private:
  using Field = std::map<std::pair<int, int>, std::int64_t>;

  std::int64_t nextCode() {
    std::int64_t zigzag = 0;
    for (std::size_t b = 0; b < bytesPerCode_; ++b) {
      zigzag = zigzag * 256 + payload_[5 * columns_ + b * codes_ + next_];
    }
    ++next_;
    return zigzag % 2 == 0 ? zigzag / 2 : -(zigzag + 1) / 2;
  }

  static int units(int stride) { return std::max(1, 16 / stride); }

  static std::int64_t roundedQuotient(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(
        std::floor(static_cast<double>(a) / static_cast<double>(b) + 0.5));
  }

  static std::int64_t prediction(const std::map<int, std::int64_t>& known) {
    const auto has = [&](int k) { return known.count(k) != 0; };
    const auto at = [&](int k) { return known.at(k); };
    // The sign of the side toward the centre.
    const int in = has(1) && !has(-1) ? 1 : has(-1) && !has(1) ? -1 : has(3) ? 1 : -1;
    if (has(1) && has(-1)) {
      if (has(3) && has(-3)) return roundedQuotient(9 * (at(1) + at(-1)) - at(3) - at(-3), 16);
      if (has(3 * in)) return roundedQuotient(6 * at(in) + 3 * at(-in) - at(3 * in), 8);
      return roundedQuotient(at(1) + at(-1), 2);
    }
    if (has(5 * in)) return roundedQuotient(15 * at(in) - 10 * at(3 * in) + 3 * at(5 * in), 8);
    if (has(3 * in)) return roundedQuotient(3 * at(in) - at(3 * in), 2);
    return at(in);
  }

  void addPass(Field& field, int stride, bool alongRow) {
    for (int row = 0; row < side_; ++row) {
      for (int column = 0; column < side_; ++column) {
        const int across = column - centre_, down = row - centre_;
        if (across % stride != 0 || down % stride != 0 || !reachable_[row * side_ + column])
          continue;
        const bool oddAcross = across / stride % 2 != 0, oddDown = down / stride % 2 != 0;
        if (alongRow ? !(oddAcross && !oddDown) : !oddDown) continue;
        std::map<int, std::int64_t> known;
        for (const int k : {-5, -3, -1, 1, 3, 5}) {
          const auto found = field.find(
              {alongRow ? row : row + k * stride, alongRow ? column + k * stride : column});
          if (found != field.end()) known[k] = found->second;
        }
        field[{row, column}] = prediction(known) + units(stride) * nextCode();
      }
    }
  }

  void writeColumn(BasisTable& table, std::size_t c, const std::vector<std::int64_t>& poleCodes) {
    const auto byte = [&](std::size_t array) { return payload_[array * columns_ + c]; };
    const int s = byte(0) + 256 * byte(1);
    const int w = byte(2) + 256 * byte(3);
    const std::size_t r = byte(4);
    const double unit = (16 + s % 16) * std::pow(2.0, s / 16 - 96);
    const double weight = (w < 32768 ? w : w - 65536) / 1024.0;
    const std::size_t samples = static_cast<std::size_t>(side_) * side_;
    for (int square = 0; square < squares_; ++square) {
      float* out = table.values().data() + (square * columns_ + c) * samples;
      for (const auto& [place, value] : fields_[c * squares_ + square]) {
        const std::size_t i = static_cast<std::size_t>(place.first) * side_ + place.second;
        const double reference = r == 0 ? 0 : (out - r * samples)[i];
        out[i] = static_cast<float>(static_cast<double>(value) * unit + weight * reference);
      }
    }
    if (squares_ == 2) return;
    const int m = (n_ + 1) / 2;
    Field& field = fields_[c];
    const std::int64_t mean =
        roundedQuotient(field[{1, m}] + field[{m, 1}] + field[{m, n_}] + field[{n_, m}], 4);
    const double reference = r == 0 ? 0 : table.southPole()[c - r];
    table.southPole()[c] = static_cast<float>(static_cast<double>(mean + 16 * poleCodes[c]) * unit +
                                              weight * reference);
  }

  int squares_, n_;
  std::size_t columns_, bytesPerCode_;
  int side_, centre_;
  std::vector<std::uint8_t> reachable_;
  std::vector<std::uint8_t> payload_;
  std::size_t codes_, next_ = 0;
  std::vector<Field> fields_;
};

struct Shape {
  LightDomain domain;
  int n, columns;
};
const Shape kShapes[] = {{LightDomain::Hemisphere, 4, 1},   {LightDomain::Sphere, 4, 2},
                         {LightDomain::Hemisphere, 5, 3},   {LightDomain::Hemisphere, 8, 4},
                         {LightDomain::Hemisphere, 17, 9},  {LightDomain::Sphere, 18, 6},
                         {LightDomain::Hemisphere, 33, 12}, {LightDomain::Sphere, 33, 4},
                         {LightDomain::Hemisphere, 34, 2}};

std::string nameOf(const Shape& s) {
  return std::to_string(s.n) + "^2, " + std::to_string(s.columns) + " columns";
}

TEST(BasisFile, DecodesToWhatEncodingLeft) {
  for (const Shape& s : kShapes) {
    BasisTable table = smoothTable(s.domain, s.n, s.columns);
    const Bytes bytes = table.encode();
    const BasisTable decoded = BasisTable::decode(bytes, "basis.bin");
    EXPECT_EQ(decoded, table) << nameOf(s);
    EXPECT_EQ(SlowDecoder(bytes).decode(), table) << nameOf(s);
  }
}

TEST(BasisFile, DecodesRoughColumnsTheSameAsTheSlowDecoder) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise;
  for (const Shape& s : kShapes) {
    BasisTable table(s.domain, s.n, s.columns);
    for (float& v : table.values()) v = static_cast<float>(noise(random));
    for (float& v : table.southPole()) v = static_cast<float>(3 * noise(random));
    const Bytes bytes = table.encode();
    EXPECT_EQ(BasisTable::decode(bytes, "basis.bin"), table) << nameOf(s);
    EXPECT_EQ(SlowDecoder(bytes).decode(), table) << nameOf(s);
  }
}

TEST(BasisFile, KeepsTheDefaultErrorAndNotMuchLess) {
  for (const Shape& s : kShapes) {
    const BasisTable exact = smoothTable(s.domain, s.n, s.columns);
    BasisTable table = exact;
    table.encode();
    for (int c = 0; c < s.columns; ++c) {
      const double error = rms(exact, &table, c) / rms(exact, nullptr, c);
      EXPECT_LE(error, kDefaultStoredError * (1 + 1e-6)) << nameOf(s) << ' ' << c;
      EXPECT_LT(20 * std::log10(error), -70) << nameOf(s) << ' ' << c;
      if (s.n >= 17) {
        EXPECT_GE(error, 0.7 * kDefaultStoredError) << nameOf(s) << ' ' << c;
      }
    }
  }
}

TEST(BasisFile, KeepsTheErrorsAskedForPerColumn) {
  const BasisTable exact = smoothTable(LightDomain::Hemisphere, 33, 6);
  BasisTable table = exact;
  const std::vector<double> errors{1e-2, 1e-3, 1e-5, 1e-6, 1e-3, 3e-3};
  table.setStoredErrors(errors);
  table.encode();
  for (int c = 0; c < 6; ++c) {
    EXPECT_LE(rms(exact, &table, c), errors[c] * 1.01) << c;
    EXPECT_GE(rms(exact, &table, c), errors[c] * 0.5) << c;
    EXPECT_NEAR(table.southPole()[c], exact.southPole()[c], 20 * errors[c]) << c;
  }
}

TEST(BasisFile, SmallerErrorsTakeMoreBytes) {
  std::size_t before = 0;
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    BasisTable table = smoothTable(LightDomain::Hemisphere, 33, 12);
    table.setStoredError(error);
    const std::size_t bytes = table.encode().size();
    EXPECT_GT(bytes, before) << error;
    before = bytes;
  }
}

// Column 4 is about 100 all over: single precision ends there, and so does the file's.
TEST(BasisFile, IsNeverFinerThanSinglePrecision) {
  const BasisTable exact = smoothTable(LightDomain::Hemisphere, 33, 6);
  BasisTable table = exact;
  table.setStoredErrors(std::vector<double>(6, 1e-12));
  EXPECT_EQ(BasisTable::decode(table.encode(), "basis.bin"), table);
  EXPECT_LT(rms(exact, &table, 4), 1e-4);
  EXPECT_GT(rms(exact, &table, 4), 1e-6);
  EXPECT_LT(rms(exact, &table, 0), 1e-6);
}

// Two-sided: an unexplained improvement is a fault too. 12 columns of halves would be 29 kB.
TEST(BasisFile, SpendsFewBytesOnSmoothColumns) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 33, 12);
  const std::size_t bytes = table.encode().size();
  EXPECT_LT(bytes, 3700U);
  EXPECT_GT(bytes, 3100U);
}

TEST(BasisFile, EncodingAgainGivesTheSameBytes) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 17, 5);
  const Bytes bytes = table.encode();
  EXPECT_EQ(table.encode(), bytes);
  BasisTable copy = table;
  EXPECT_EQ(copy.encode(), bytes);
  BasisTable decoded = BasisTable::decode(bytes, "basis.bin");
  EXPECT_EQ(decoded.encode(), bytes);
  EXPECT_EQ(decoded, table);
  decoded.values()[5 * 19 + 9] += 1;
  EXPECT_NE(decoded.encode(), bytes);
}

TEST(BasisFile, ZeroAndConstantColumns) {
  BasisTable table(LightDomain::Hemisphere, 9, 3);
  table.fill([](Direction, std::span<double> out) {
    out[0] = 0;
    out[1] = 1;
    out[2] = -1e-20;
  });
  const BasisTable exact = table;
  EXPECT_EQ(BasisTable::decode(table.encode(), "basis.bin"), table);
  EXPECT_EQ(rms(table, nullptr, 0), 0);
  EXPECT_LE(rms(exact, &table, 1), 2.5e-4);
  EXPECT_LE(rms(exact, &table, 2), 2.5e-24);
}

TEST(BasisFile, RefusesToEncodeWhatIsNotFinite) {
  for (const float bad : {std::nanf(""), INFINITY, -INFINITY, 1e30F}) {
    BasisTable table(LightDomain::Hemisphere, 9, 1);
    table.values()[60] = bad;
    EXPECT_THROW(table.encode(), Error) << bad;
  }
}

Bytes bytesFromHex(std::string_view hex) {
  Bytes bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::byte>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  }
  return bytes;
}

// x + 2yz and 1 - x/2 - yz + z/4 on the hemisphere, 5^2, stored to one percent. Frozen in version
// 1: every later reader must decode these bytes to these values.
TEST(BasisFile, DecodesFrozenBytes) {
  const Bytes frozen = bytesFromHex(
      "494c425401000500020000000100000063000000780105c13b1682400c40d19798a0931969606a6d"
      "a0538e9fc24e37031bc135ba1b8fde3b3ddcf9f14580cffa5e68f7ccb57a75af9ea5dcc6ae1fee59"
      "4bdec6f9da1b7e780e09627c1d1b36dde594764581100905500bc300010001500bc3fef86d093c");
  const BasisTable table = BasisTable::decode(frozen, "frozen");
  EXPECT_EQ(table, SlowDecoder(frozen).decode());
  ASSERT_EQ(table.resolution(), 5);
  ASSERT_EQ(table.columns(), 2);
  ASSERT_EQ(table.domain(), LightDomain::Hemisphere);
  const struct {
    int sample;
    float value;
  } expected[] = {{0, 0x1.496p-3F},    {8, -0x1.d1p-3F},     {24, 0},
                  {48, -0x1.496p-3F},  {49, 0x1.8cbf6ap-1F}, {73, 0x1.41p+0F},
                  {97, 0x1.d94096p-1F}};
  for (const auto& [sample, value] : expected) EXPECT_EQ(table.values()[sample], value) << sample;
  EXPECT_EQ(table.southPole()[0], 0);
  EXPECT_EQ(table.southPole()[1], 0x1.fep-1F);
  const auto* values = reinterpret_cast<const Bytef*>(table.values().data());
  EXPECT_EQ(crc32(0, values, static_cast<uInt>(table.values().size_bytes())), 2947245372U);
}

// The header and the payload before deflate: the same whatever the version of zlib.
TEST(BasisFile, EncodesToTheFrozenPayload) {
  BasisTable table(LightDomain::Hemisphere, 5, 2);
  table.fill([](Direction d, std::span<double> out) {
    out[0] = d.x() + 2 * d.y() * d.z();
    out[1] = 1 - 0.5 * d.x() - d.y() * d.z() + 0.25 * d.z();
  });
  table.setStoredError(1e-2);
  const Bytes bytes = table.encode();
  const Bytes header(bytes.begin(), bytes.begin() + 16);
  EXPECT_EQ(header, bytesFromHex("494c4254010005000200000001000000"));
  const std::vector<std::uint8_t> payload = inflated(bytes);
  const Bytes expected = bytesFromHex(
      "2f38050500ff00fd0001000000d6838466000e0d006515150515050515050b010c3326131425340b02"
      "0c0b070a2e32140400051f3f250900000a26402006000313312d09080c020000000a01010a02000000"
      "0002040a04000400000001000000000000010000000002040a040004");
  ASSERT_EQ(payload.size(), expected.size());
  for (std::size_t i = 0; i < payload.size(); ++i) {
    EXPECT_EQ(payload[i], std::to_integer<std::uint8_t>(expected[i])) << i;
  }
}

TEST(BasisFile, RefusesEveryTruncation) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 9, 3);
  const Bytes bytes = table.encode();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(BasisTable::decode(cut, "cut"), Error) << size;
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_THROW(BasisTable::decode(longer, "longer"), Error);
}

TEST(BasisFile, RefusesEveryBitFlip) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 9, 3);
  const Bytes bytes = table.encode();
  int unnoticed = 0;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes flipped = bytes;
    flipped[bit / 8] ^= static_cast<std::byte>(1 << (bit % 8));
    try {
      // Deflate has bits without a meaning: those must change nothing.
      EXPECT_EQ(BasisTable::decode(flipped, "flipped"), table) << bit;
      ++unnoticed;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find("flipped: expected "), 0U) << error.what();
    }
  }
  EXPECT_LT(unnoticed, 16);
}

TEST(BasisFile, SurvivesRandomBytes) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 5, 2);
  const Bytes bytes = table.encode();
  std::mt19937 random(17);
  for (int trial = 0; trial < 3000; ++trial) {
    // Half of them with an intact header.
    Bytes noise = bytes;
    for (std::size_t i = trial % 2 == 0 ? 0 : kHeaderBytes; i < noise.size(); ++i) {
      if (random() % 8 == 0) noise[i] = static_cast<std::byte>(random() & 255);
    }
    if (noise == bytes) continue;
    EXPECT_THROW(BasisTable::decode(noise, "noise"), Error) << trial;
  }
}

TEST(BasisFile, SurvivesRandomPayloads) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 5, 4);
  const Bytes bytes = table.encode();
  const std::vector<std::uint8_t> payload = inflated(bytes);
  std::mt19937 random(19);
  int decoded = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<std::uint8_t> noise = payload;
    for (std::uint8_t& byte : noise) {
      if (random() % 40 == 0) byte = static_cast<std::uint8_t>(random() & 255);
    }
    try {
      const BasisTable read = BasisTable::decode(withPayload(bytes, noise), "noise");
      for (const float v : read.values()) ASSERT_TRUE(std::isfinite(v)) << trial;
      for (const float v : read.southPole()) ASSERT_TRUE(std::isfinite(v)) << trial;
      ++decoded;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(decoded, 0);
  EXPECT_LT(decoded, 3000);
}

struct HostileHeader {
  const char* what;
  std::size_t offset;
  int size;
  std::uint32_t value;
};

TEST(BasisFile, RefusesHostileHeaders) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 9, 3);
  const Bytes bytes = table.encode();
  const HostileHeader cases[] = {{"magic", 0, 1, 'X'},
                                 {"a newer version", 4, 1, 2},
                                 {"version 0", 4, 1, 0},
                                 {"domain", 5, 1, 2},
                                 {"the other domain", 5, 1, 1},
                                 {"resolution 0", 6, 2, 0},
                                 {"resolution 3", 6, 2, 3},
                                 {"resolution 1026", 6, 2, 1026},
                                 {"resolution 65535", 6, 2, 65535},
                                 {"another resolution", 6, 2, 10},
                                 {"a promise of a million samples", 6, 2, 1000},
                                 {"no columns", 8, 4, 0},
                                 {"more columns", 8, 4, 4},
                                 {"columns that overflow", 8, 4, 0xFFFFFFFF},
                                 {"as many columns as are allowed", 8, 4, (1 << 24) / 121},
                                 {"no bytes per code", 12, 1, 0},
                                 {"other bytes per code", 12, 1, 4},
                                 {"many bytes per code", 12, 1, 5},
                                 {"reserved", 13, 1, 1},
                                 {"reserved", 15, 1, 128},
                                 {"no payload", 16, 4, 0},
                                 {"a huge payload", 16, 4, 0xFFFFFFFF}};
  for (const HostileHeader& c : cases) {
    Bytes hostile = bytes;
    setLittleEndian(hostile, c.offset, c.size, c.value);
    EXPECT_THROW(BasisTable::decode(hostile, c.what), Error) << c.what;
  }
}

TEST(BasisFile, RefusesHostileColumns) {
  BasisTable table = smoothTable(LightDomain::Hemisphere, 5, 2);
  const Bytes bytes = table.encode();
  const std::vector<std::uint8_t> payload = inflated(bytes);
  const std::size_t columns = 2;
  const auto decodeWith = [&](std::initializer_list<std::pair<std::size_t, int>> changes) {
    std::vector<std::uint8_t> hostile = payload;
    for (const auto& [at, value] : changes) hostile[at] = static_cast<std::uint8_t>(value);
    return BasisTable::decode(withPayload(bytes, hostile), "hostile");
  };
  EXPECT_EQ(decodeWith({}), table);
  // s above 2047
  EXPECT_THROW(decodeWith({{columns, 8}}), Error);
  // a reference before the first column; one to itself with a weight
  EXPECT_THROW(decodeWith({{4 * columns, 1}}), Error);
  EXPECT_THROW(decodeWith({{4 * columns + 1, 2}}), Error);
  EXPECT_THROW(decodeWith({{4 * columns, 0}, {2 * columns, 1}}), Error);
  // codes that leave the field's range: with 4 bytes all of them can
  Bytes wide = bytes;
  setLittleEndian(wide, 12, 1, 4);
  const std::size_t codes = (payload.size() - 5 * columns) / littleEndian(bytes, 12, 1);
  std::vector<std::uint8_t> huge(5 * columns + 4 * codes, 0);
  huge[5 * columns + 3] = 0x7F;
  EXPECT_THROW(BasisTable::decode(withPayload(wide, huge), "wide"), Error);
  // weights that multiply beyond a float's range
  const int many = 200;
  Bytes chain = bytes;
  setLittleEndian(chain, 8, 4, many);
  setLittleEndian(chain, 12, 1, 1);
  std::vector<std::uint8_t> growing(
      5 * many + many * (1 + static_cast<std::size_t>(CodingOrder(5).steps.size())), 0);
  growing[many] = 7;             // s of column 0: a large unit
  growing[5 * many + many] = 2;  // its first sample: 1
  for (int c = 1; c < many; ++c) {
    growing[3 * many + c] = 0x7F;  // w about 32
    growing[4 * many + c] = 1;
  }
  EXPECT_THROW(BasisTable::decode(withPayload(chain, growing), "chain"), Error);
}

}  // namespace
}  // namespace illum
