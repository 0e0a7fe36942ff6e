#include "capture/file_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "capture/test_photographs.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

std::vector<std::byte> contentOf(int file, std::size_t length) {
  std::vector<std::byte> bytes(length);
  for (std::size_t i = 0; i < length; ++i) {
    bytes[i] = static_cast<std::byte>(i * 7 + static_cast<std::size_t>(file) * 13);
  }
  return bytes;
}

TEST(FilePool, ReadsManyFilesWithFewOpen) {
  constexpr int kFiles = 40;
  constexpr std::size_t kBytes = 1000;
  const test::Folder folder;
  FilePool pool(3);
  for (int i = 0; i < kFiles; ++i) {
    const auto file = folder / std::to_string(i);
    test::writeBytes(file, contentOf(i, kBytes));
    EXPECT_EQ(pool.add(file), static_cast<std::size_t>(i));
    EXPECT_EQ(pool.path(static_cast<std::size_t>(i)), file);
    EXPECT_EQ(pool.bytes(static_cast<std::size_t>(i)), kBytes);
    EXPECT_LE(pool.openFiles(), 3u);
  }
  tbb::parallel_for(0, 2000, [&](int k) {
    const auto file = static_cast<std::size_t>(k * 17 % kFiles);
    const std::size_t offset = static_cast<std::size_t>(k) * 31 % kBytes;
    std::vector<std::byte> buffer(100);
    const std::size_t got = pool.read(file, offset, buffer);
    EXPECT_EQ(got, std::min<std::size_t>(100, kBytes - offset));
    const auto expected = contentOf(static_cast<int>(file), kBytes);
    for (std::size_t i = 0; i < got; ++i) ASSERT_EQ(buffer[i], expected[offset + i]) << k;
  });
  std::byte one;
  pool.read(0, 0, {&one, 1});
  EXPECT_LE(pool.openFiles(), 20u) << "only as many more as threads read at the same moment";
}

TEST(FilePool, ReadsNothingBeyondTheEnd) {
  const test::Folder folder;
  test::writeBytes(folder / "a", contentOf(0, 10));
  FilePool pool;
  pool.add(folder / "a");
  std::vector<std::byte> buffer(8);
  EXPECT_EQ(pool.read(0, 6, buffer), 4u);
  EXPECT_EQ(pool.read(0, 10, buffer), 0u);
  EXPECT_EQ(pool.read(0, 1000000, buffer), 0u);
}

TEST(FilePool, NoticesThatAFileIsAnotherNow) {
  const test::Folder folder;
  FilePool pool(1);
  for (const char* name : {"a", "b"}) {
    test::writeBytes(folder / name, contentOf(0, 10));
    pool.add(folder / name);
  }
  test::writeBytes(folder / "a", contentOf(0, 11));
  std::byte one;
  try {
    pool.read(0, 0, {&one, 1});
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), HasSubstr("a: expected the photograph that was there"));
  }
}

TEST(FilePool, RefusesWhatIsNoFile) {
  const test::Folder folder;
  FilePool pool;
  EXPECT_THROW(pool.add(folder / "nowhere"), Error);
  EXPECT_THROW(pool.add(folder.path()), Error);
  EXPECT_EQ(pool.openFiles(), 0u);
}

}  // namespace
}  // namespace illum
