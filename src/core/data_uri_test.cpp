#include "core/data_uri.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

namespace illum {
namespace {

constexpr std::string_view kPrefix = "data:a/b;base64,";

std::string base64(std::string_view text) {
  return dataUri("a/b", std::as_bytes(std::span(text.data(), text.size()))).substr(kPrefix.size());
}

std::optional<std::string> decoded(std::string_view uri) {
  const auto bytes = bytesOfDataUri(uri);
  if (!bytes) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

// The test vectors of RFC 4648, section 10.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kVectors{
    {{"", ""},
     {"f", "Zg=="},
     {"fo", "Zm8="},
     {"foo", "Zm9v"},
     {"foob", "Zm9vYg=="},
     {"fooba", "Zm9vYmE="},
     {"foobar", "Zm9vYmFy"},
     {"\xfb\xff\xbf", "+/+/"}}};

TEST(DataUri, FollowsTheStandard) {
  for (const auto& [plain, coded] : kVectors) {
    EXPECT_EQ(base64(plain), coded);
    EXPECT_EQ(decoded(std::string(kPrefix) + std::string(coded)), plain);
  }
}

TEST(DataUri, IsReadWithoutItsFillOrItsMediaType) {
  EXPECT_EQ(decoded("data:;base64,Zm9vYg"), "foob");
  EXPECT_EQ(decoded("data:text/plain;charset=utf-8;base64,Zm8"), "fo");
}

TEST(DataUri, WhatIsNoneIsNotRead) {
  for (const char* uri : {"", "data:", "data:a/b,Zm9v", "data:a/b;base64", "Zm9v",
                          "data:;base64,Zm9vY", "data:;base64,Zm 9v", "data:;base64,Zg===",
                          "data:;base64,Z=9v", "data:;base64,@@@@", "data:,;base64,Zm9v"})
    EXPECT_EQ(decoded(uri), std::nullopt) << uri;
}

}  // namespace
}  // namespace illum
