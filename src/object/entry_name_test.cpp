#include "object/entry_name.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace illum {
namespace {

const std::vector<std::string> kInOrder{"object.json",
                                        "basis.bin",
                                        "poster.jpg",
                                        "planes/0/0/0_0.avif",
                                        "planes/0/0/2_0.png",
                                        "planes/0/0/10_0.jpg",
                                        "planes/0/0/0_1.png",
                                        "planes/0/0/0_10.png",
                                        "planes/0/2/0_0.png",
                                        "planes/0/10/0_0.png",
                                        "planes/3/0/0_0.png",
                                        "planes/20/0/0_0.png",
                                        "depth/0/0/0_0.png",
                                        "mask/0/0/0_0.png",
                                        "mask/0/0/9999999_0.png",
                                        "a",
                                        "objecz.json"};

TEST(EntryName, CanonicalOrderComparesNumbersAsNumbers) {
  auto names = kInOrder;
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(names.begin(), names.end(), random);
    std::sort(names.begin(), names.end(), entryNameLess);
    EXPECT_EQ(names, kInOrder);
  }
}

TEST(EntryName, KeysAreTheInverseOfNames) {
  const auto key = entryKeyOf(tileEntryName("mask", 1, 2, 3, 4, ".png"));
  ASSERT_TRUE(key);
  EXPECT_EQ(key->kind, EntryKey::Kind::Mask);
  EXPECT_EQ(key->group, 1);
  EXPECT_EQ(key->level, 2);
  EXPECT_EQ(key->x, 3);
  EXPECT_EQ(key->y, 4);
}

TEST(EntryName, OnlyDefinedNamesHaveKeys) {
  for (const std::string_view name : {"",
                                      "object.jsom",
                                      "Object.json",
                                      "planes",
                                      "planes/",
                                      "planes/0/0/0_0",
                                      "planes/0/0/0_0.gif",
                                      "planes/0/0/00_0.png",
                                      "planes/01/0/0_0.png",
                                      "planes/-1/0/0_0.png",
                                      "planes/0/0/0_0.png.tmp",
                                      "planes/0/0/.illum-1-2.tmp",
                                      "planes/0/0/12345678_0.png",
                                      "planes/0/0/0-0.png",
                                      "planes/0/0/0_0.png/",
                                      "mask/0/0/0_0.avif",
                                      "depth/0/0/0_0.jpg",
                                      "index.bin",
                                      " object.json",
                                      "planes/0/0/_0.png",
                                      "planes/0//0_0.png"})
    EXPECT_FALSE(entryKeyOf(name)) << name;
}

TEST(EntryName, SafeNamesStayInsideTheObject) {
  for (const std::string_view name : {"a", "a/b", "a/b/", "planes/0/0/0_0.png",
                                      "notes about...this.txt", "..a", "a..", ".hidden"})
    EXPECT_TRUE(isSafeEntryName(name)) << name;
  EXPECT_TRUE(isSafeEntryName(std::string(255, 'a')));
}

TEST(EntryName, UnsafeNamesAreKnown) {
  using namespace std::string_view_literals;
  for (const std::string_view name :
       {""sv,      "/"sv,     "//"sv,   "/etc/passwd"sv, ".."sv,    "../a"sv,  "a/../b"sv,
        "a/.."sv,  "a/../"sv, "."sv,    "./a"sv,         "a/./b"sv, "a//b"sv,  "a\\b"sv,
        "..\\a"sv, "C:a"sv,   "c:/a"sv, "a\nb"sv,        "a\0b"sv,  "a\x7f"sv, "a//"sv})
    EXPECT_FALSE(isSafeEntryName(name)) << name;
  EXPECT_FALSE(isSafeEntryName(std::string(256, 'a')));
}

}  // namespace
}  // namespace illum
