#include "core/files.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "illum/error.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Files : public testing::Test {
 protected:
  Files() : folder_(fs::path(testing::TempDir()) / ("files-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }

  fs::path put(const char* name, std::string_view text) {
    const fs::path file = folder_ / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

template <typename Action>
void expectError(Fault fault, const std::string& part, const Action& action) {
  try {
    action();
    ADD_FAILURE() << "no error, expected one with: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST_F(Files, ReadsWhatIsThere) {
  const std::string text("a\0b\nc", 5);
  const fs::path file = put("a", text);
  EXPECT_EQ(readTextFile(file, 5), text);
  EXPECT_EQ(readFile(file, 100).size(), 5U);
  EXPECT_EQ(readTextFile(put("empty", ""), 0), "");
}

TEST_F(Files, ReadsFilesWhoseSizeIsNotTold) {
  EXPECT_THAT(readTextFile("/proc/self/status", 1 << 20), HasSubstr("VmRSS"));
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(300000, 'x');
  std::thread writer([&] { std::ofstream(pipe) << text; });
  EXPECT_EQ(readTextFile(pipe, 300000), text);
  writer.join();
}

TEST_F(Files, ReadingFailsWithOneSentence) {
  const fs::path file = put("a", "12345");
  expectError(Fault::Input, "cannot open: No such file",
              [&] { readFile(folder_ / "missing", 10); });
  expectError(Fault::Input, "Not a directory", [&] { readFile(file / "b", 10); });
  expectError(Fault::Input, "Is a directory", [&] { readFile(folder_, 10); });
  expectError(Fault::Input, "at most 4 bytes", [&] { readFile(file, 4); });
  expectError(Fault::Input, "at most 100000 bytes", [] { readFile("/dev/zero", 100000); });
}

TEST_F(Files, WritesAndReplaces) {
  const fs::path file = folder_ / "a";
  writeFileAtomically(file, "first");
  EXPECT_EQ(readTextFile(file, 100), "first");
  writeFileAtomically(file, std::string_view());
  EXPECT_EQ(readTextFile(file, 100), "");
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(Files, WritesIntoTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  writeFileAtomically("plain", "text");
  fs::current_path(before);
  EXPECT_EQ(readTextFile(folder_ / "plain", 100), "text");
}

TEST_F(Files, TheLongestPossibleNameCanBeWritten) {
  writeFileAtomically(folder_ / std::string(255, 'n'), "text");
  EXPECT_EQ(filesInFolder(), 1U);
  expectError(Fault::Machine, "File name too long",
              [&] { writeFileAtomically(folder_ / std::string(256, 'n'), "text"); });
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(Files, ReplacingKeepsPermissionsAndNewFilesFollowTheMask) {
  const fs::path old = put("old", "x");
  ::chmod(old.c_str(), 0640);
  writeFileAtomically(old, "y");
  EXPECT_EQ(fs::status(old).permissions(), static_cast<fs::perms>(0640));
  const mode_t mask = ::umask(027);
  writeFileAtomically(folder_ / "new", "z");
  ::umask(mask);
  EXPECT_EQ(fs::status(folder_ / "new").permissions(), static_cast<fs::perms>(0640));
}

TEST_F(Files, WritingThroughALinkKeepsTheLink) {
  const fs::path file = put("a", "old");
  fs::create_symlink("a", folder_ / "link");
  writeFileAtomically(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(readTextFile(file, 100), "new");
}

TEST_F(Files, WritingFailsWithOneSentenceAndLeavesNothing) {
  const fs::path folder = folder_ / "folder";
  fs::create_directory(folder);
  const fs::path file = put("a", "old");
  expectError(Fault::Machine, "cannot write: No such file",
              [&] { writeFileAtomically(folder_ / "missing" / "b", "x"); });
  expectError(Fault::Machine, "cannot write: Is a directory",
              [&] { writeFileAtomically(folder, "x"); });
  expectError(Fault::Machine, "Is a directory", [&] { writeFileAtomically(folder / "", "x"); });
  expectError(Fault::Machine, "Not a directory", [&] { writeFileAtomically(file / "b", "x"); });
  expectError(Fault::Machine, "not an ordinary file",
              [] { writeFileAtomically("/dev/null", "x"); });
  expectError(Fault::Machine, "cannot write", [] { writeFileAtomically("", "x"); });
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(readTextFile(file, 100), "old");
  EXPECT_EQ(filesInFolder(), 2U);
}

TEST_F(Files, NoPermissionIsRespected) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  const fs::path file = put("a", "old");
  ::chmod(file.c_str(), 0400);
  expectError(Fault::Machine, "Permission denied", [&] { writeFileAtomically(file, "x"); });
  ::chmod(folder_.c_str(), 0500);
  expectError(Fault::Machine, "Permission denied",
              [&] { writeFileAtomically(folder_ / "b", "x"); });
  ::chmod(folder_.c_str(), 0700);
  EXPECT_EQ(filesInFolder(), 1U);
}

/// As a disk that fills up: no file may grow beyond a limit while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(Files, AFullDiskKeepsTheOldFile) {
  const fs::path file = put("a", "old");
  {
    const FileSizeLimit limit(1000);
    expectError(Fault::Machine, "cannot write: File too large",
                [&] { writeFileAtomically(file, std::string(5000, 'x')); });
  }
  EXPECT_EQ(readTextFile(file, 100), "old");
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(Files, WithoutCommitNothingHappens) {
  const fs::path file = put("a", "old");
  {
    AtomicFile writing(file);
    writing.write(std::as_bytes(std::span(std::string_view("new"))));
    EXPECT_TRUE(fs::exists(writing.temporary()));
    EXPECT_EQ(writing.temporary().parent_path(), fs::canonical(folder_));
    EXPECT_EQ(readTextFile(file, 100), "old");
  }
  EXPECT_EQ(readTextFile(file, 100), "old");
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(Files, ALibraryMayWriteTheTemporaryByName) {
  AtomicFile writing(folder_ / "a");
  std::ofstream(writing.temporary()) << "by name";
  writing.commit();
  EXPECT_EQ(readTextFile(folder_ / "a", 100), "by name");
  EXPECT_EQ(filesInFolder(), 1U);
}

TEST_F(Files, ManyWritersOfOneFileLeaveOneWholeFile) {
  const fs::path file = folder_ / "a";
  std::vector<std::thread> writers;
  for (char c = 'a'; c < 'i'; ++c)
    writers.emplace_back([&, c] { writeFileAtomically(file, std::string(100000, c)); });
  for (std::thread& writer : writers) writer.join();
  const std::string text = readTextFile(file, 1 << 20);
  EXPECT_EQ(text, std::string(100000, text.at(0)));
  EXPECT_EQ(filesInFolder(), 1U);
}

std::uint32_t crcOfText(std::string_view text, std::uint32_t crc = 0) {
  return crc32Of(std::as_bytes(std::span(text)), crc);
}

TEST(Crc32, CheckValueAndContinuation) {
  EXPECT_EQ(crcOfText("123456789"), 0xCBF43926U);  // the check value of every CRC catalogue
  EXPECT_EQ(crcOfText(""), 0U);
  EXPECT_EQ(crcOfText("6789", crcOfText("12345")), 0xCBF43926U);
}

TEST_F(Files, SyncPathTakesFilesAndFolders) {
  EXPECT_NO_THROW(syncPath(put("a", "x")));
  EXPECT_NO_THROW(syncPath(folder_));
  expectError(Fault::Machine, "No such file", [&] { syncPath(folder_ / "missing"); });
}

}  // namespace
}  // namespace illum
