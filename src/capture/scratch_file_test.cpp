#include "capture/scratch_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "capture/test_photographs.h"

namespace illum {
namespace {

using testing::HasSubstr;

TEST(ScratchFile, GivesBackWhatWasWrittenAndHasNoName) {
  const test::Folder folder;
  ScratchFile file(folder.path(), 1000);
  EXPECT_TRUE(file.isOpen());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const std::vector<std::byte> first(100, std::byte{1}), second(50, std::byte{2});
  file.write(900, first);
  file.write(0, second);
  std::vector<std::byte> read(100);
  file.read(900, read);
  EXPECT_EQ(read, first);
  read.resize(50);
  ScratchFile moved = std::move(file);
  moved.read(0, read);
  EXPECT_EQ(read, second);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ScratchFile, ReadingBeyondTheEndIsAnError) {
  const test::Folder folder;
  const ScratchFile file(folder.path(), 10);
  std::vector<std::byte> read(11);
  EXPECT_THROW(file.read(0, read), Error);
}

std::string errorOf(const std::filesystem::path& folder, std::uint64_t bytes) {
  try {
    const ScratchFile file(folder, bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Machine);
    return error.what();
  }
  return "no error";
}

TEST(ScratchFile, TellsTheSizeWhenThereIsNoRoom) {
  const test::Folder folder;
  // More than any file system holds, and less than what offsets can say.
  EXPECT_THAT(errorOf(folder.path(), std::uint64_t{1} << 60),
              HasSubstr("cannot reserve a scratch file of 1048576.0 TiB"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ScratchFile, NeedsAFolder) {
  const test::Folder folder;
  EXPECT_THAT(errorOf(folder / "nowhere", 10), HasSubstr("nowhere: cannot make a scratch file"));
}

}  // namespace
}  // namespace illum
