#include "core/memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "illum/error.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

TEST(Memory, SizesAsPeopleWriteThem) {
  const std::pair<const char*, std::uint64_t> cases[] = {
      {"0", 0},
      {"1073741824", 1ULL << 30},
      {"512M", 512ULL << 20},
      {"2G", 2ULL << 30},
      {"1.5GiB", 3ULL << 29},
      {"800000k", 800000ULL << 10},
      {"3 gb", 3ULL << 30},
      {"0.5t", 1ULL << 39},
      {"17B", 17},
      {"9007199254740993", 9007199254740992},  // sizes are exact to 2^53
  };
  for (const auto& [text, bytes] : cases) EXPECT_EQ(bytesFromText(text), bytes) << text;
}

TEST(Memory, SizesThatAreNone) {
  for (const char* text : {"", "M", "-1", "-1M", "1X", "1GG", "1Gi b", "1e3", "nan", "inf", "0x10",
                           "1,5G", "G1", "1 2", "99999999999T"}) {
    try {
      ADD_FAILURE() << text << " was taken as " << bytesFromText(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Usage) << text;
    }
  }
}

TEST(Memory, SizesAsTheyAreShown) {
  EXPECT_EQ(textFromBytes(0), "0 B");
  EXPECT_EQ(textFromBytes(1023), "1023 B");
  EXPECT_EQ(textFromBytes(1024), "1.0 KiB");
  EXPECT_EQ(textFromBytes(3ULL << 29), "1.5 GiB");
  EXPECT_EQ(textFromBytes((1ULL << 20) - 1), "1.0 MiB");
  EXPECT_EQ(textFromBytes(std::numeric_limits<std::uint64_t>::max()), "16777216.0 TiB");
}

TEST(Memory, ShownSizesAreReadBack) {
  for (const std::uint64_t bytes : {1ULL, 1000ULL, 5ULL << 10, 3ULL << 29, 7ULL << 40})
    EXPECT_EQ(bytesFromText(textFromBytes(bytes)), bytes);
}

TEST(Memory, TheMachineHasSome) {
  EXPECT_GT(machineMemoryBytes(), 1ULL << 26);
  EXPECT_LE(machineMemoryBytes(), static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                                      static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
}

class ControlGroups : public testing::Test {
 protected:
  ControlGroups()
      : root_(fs::path(testing::TempDir()) / ("groups-" + std::to_string(::getpid()))) {}
  ~ControlGroups() override { fs::remove_all(root_); }

  void put(const fs::path& file, const char* text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  fs::path root_;
};

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

TEST_F(ControlGroups, NoneMeansNoLimit) {
  EXPECT_EQ(controlGroupLimitBytes(root_, ""), kNone);
  EXPECT_EQ(controlGroupLimitBytes(root_, "0::/missing\nnonsense\n"), kNone);
}

TEST_F(ControlGroups, TheLowestOnTheWayUpCounts) {
  put("a/b/memory.max", "max\n");
  put("a/memory.max", "1000\n");
  put("memory.max", "2000\n");
  EXPECT_EQ(controlGroupLimitBytes(root_, "0::/a/b\n"), 1000U);
  EXPECT_EQ(controlGroupLimitBytes(root_, "0::/\n"), 2000U);
}

TEST_F(ControlGroups, VersionOneNamesItsController) {
  put("memory/box/memory.limit_in_bytes", "4096\n");
  put("box/memory.max", "1\n");
  EXPECT_EQ(controlGroupLimitBytes(root_, "3:cpu,memory:/box\n1:name=systemd:/box\n"), 4096U);
  EXPECT_EQ(controlGroupLimitBytes(root_, "3:cpu:/box\n"), kNone);
}

}  // namespace
}  // namespace illum
