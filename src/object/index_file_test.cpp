#include "object/index_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

const std::vector<IndexEntry> kEntries{{"object.json", 1000, 0x01020304u},
                                       {"planes/0/0/0_0.png", 0x123456789a, 0xffffffffu}};

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

std::string errorOf(std::span<const std::byte> bytes) {
  try {
    decodeIndex(bytes, "INDEX");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Header with a right checksum, so that the body itself is examined.
std::vector<std::byte> indexOf(std::uint32_t count, const std::vector<std::byte>& body) {
  auto bytes = bytesOf({'I', 'L', 'L', 'U', 'M', 'I', 'D', 'X', 1, 0, 0, 0});
  const std::uint32_t crc = crc32Of(body);
  for (const std::uint32_t value : {count, crc})
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::byte>(value >> shift & 0xff));
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

TEST(IndexFile, BytesAreFrozen) {
  EXPECT_EQ(encodeIndex(kEntries),
            bytesOf({'I',  'L',  'L',  'U',  'M',  'I', 'D', 'X',  // magic
                     1,    0,    0,    0,                          // version
                     2,    0,    0,    0,                          // entries
                     0xa4, 0xee, 0xc8, 0xfd,                       // CRC-32 of what follows
                     11,   0,    'o',  'b',  'j',  'e', 'c', 't', '.', 'j', 's', 'o', 'n',  //
                     0xe8, 3,    0,    0,    0,    0,   0,   0,                             // size
                     4,    3,    2,    1,  // CRC-32
                     18,   0,    'p',  'l',  'a',  'n', 'e', 's', '/', '0', '/', '0', '/',
                     '0',  '_',  '0',  '.',  'p',  'n', 'g',     //
                     0x9a, 0x78, 0x56, 0x34, 0x12, 0,   0,   0,  //
                     0xff, 0xff, 0xff, 0xff}));
}

TEST(IndexFile, ReadingIsTheInverseOfWriting) {
  EXPECT_EQ(decodeIndex(encodeIndex(kEntries), "INDEX"), kEntries);
  EXPECT_TRUE(decodeIndex(encodeIndex({}), "INDEX").empty());
}

TEST(IndexFile, EveryTruncationAndEveryFlippedBitIsAnError) {
  auto bytes = encodeIndex(kEntries);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THAT(errorOf(std::span(bytes).first(length)), testing::StartsWith("INDEX: ")) << length;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    EXPECT_THAT(errorOf(bytes), testing::StartsWith("INDEX: ")) << "bit " << bit;
    bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
  }
}

TEST(IndexFile, RefusesBodiesThatAChecksumCannotMakeRight) {
  const auto entry = [](const std::string& name) {
    std::vector<std::byte> bytes = bytesOf({static_cast<int>(name.size()), 0});
    for (const char c : name) bytes.push_back(static_cast<std::byte>(c));
    bytes.resize(bytes.size() + 12);
    return bytes;
  };
  const auto both = [&](const std::string& a, const std::string& b) {
    auto bytes = entry(a);
    const auto second = entry(b);
    bytes.insert(bytes.end(), second.begin(), second.end());
    return bytes;
  };
  EXPECT_EQ(errorOf(indexOf(2, both("a", "b"))), "");
  EXPECT_THAT(errorOf(indexOf(2, both("b", "a"))), HasSubstr("out of order or repeated"));
  EXPECT_THAT(errorOf(indexOf(2, both("a", "a"))), HasSubstr("out of order or repeated"));
  EXPECT_THAT(errorOf(indexOf(1, entry("../a"))), HasSubstr("name that is not allowed"));
  EXPECT_THAT(errorOf(indexOf(1, entry("a/"))), HasSubstr("name that is not allowed"));
  EXPECT_THAT(errorOf(indexOf(1, entry(""))), HasSubstr("name that is not allowed"));
  EXPECT_THAT(errorOf(indexOf(4000000000u, entry("a"))), HasSubstr("ends too early"));
  EXPECT_THAT(errorOf(indexOf(1, both("a", "b"))), HasSubstr("nothing more"));
}

TEST(IndexFile, RefusesAnotherVersion) {
  auto bytes = encodeIndex(kEntries);
  bytes[8] = std::byte{2};
  EXPECT_EQ(errorOf(bytes), "INDEX: expected an index of version 1, found version 2");
}

}  // namespace
}  // namespace illum
