#include "encode/object_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "core/files.h"
#include "encode/archive_writer.h"
#include "encode/sample_object.h"
#include "encode/temporary_folder.h"
#include "illum/error.h"
#include "illum/object.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint64_t kLimit = 1 << 24;

struct Failure {
  std::string sentence;
  Fault fault = Fault::Usage;
};

Failure failureOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return {error.what(), error.fault()};
  }
  return {};
}

std::vector<std::string> contentsOf(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::byte> sampleBytes(ObjectForm form) {
  const TemporaryFolder folder;
  writeSampleObject(folder / "a", form, {});
  return readFile(form == ObjectForm::Archive ? folder / "a" : folder / "a/index.bin", kLimit);
}

/// Runs `action` in a process of its own; the value that waitpid gives.
int statusOfChild(const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

class BothForms : public testing::TestWithParam<ObjectForm> {};
INSTANTIATE_TEST_SUITE_P(ObjectWriter, BothForms,
                         testing::Values(ObjectForm::Archive, ObjectForm::Folder),
                         [](const auto& tested) {
                           return tested.param == ObjectForm::Archive ? "Archive" : "Folder";
                         });

TEST_P(BothForms, WhatIsWrittenIsRead) {
  for (const Coding coding : {Coding::Png, Coding::Avif, Coding::Jpeg}) {
    const TemporaryFolder folder;
    SampleOptions options;
    options.coding = coding;
    const fs::path out = folder / "a.illum";
    writeSampleObject(out, GetParam(), options);
    EXPECT_THAT(contentsOf(folder.path()), testing::ElementsAre("a.illum")) << nameOf(coding);
    EXPECT_THAT(verifyObject(out), IsEmpty()) << nameOf(coding);

    const Object object = Object::open(out);
    const auto expected = sampleEntries(options);
    const auto names = object.entries();
    ASSERT_EQ(names.size(), expected.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      EXPECT_EQ(names[i], expected[i].first);
      EXPECT_EQ(object.entry(names[i]), expected[i].second) << names[i];
    }
    EXPECT_EQ(object.size(), options.size);
    EXPECT_EQ(object.planes(), 12);
    EXPECT_EQ(object.basis(0).planes(), 12);
    EXPECT_EQ(object.maskTile(0, 0, 1, 1), sampleMask(object.manifest(), 0, 0, 1, 1));
  }
}

TEST_P(BothForms, LosslessTilesComeBackExactlyAtEveryDepth) {
  for (const int bits : {8, 10, 12, 16}) {
    const TemporaryFolder folder;
    SampleOptions options;
    options.bits = bits;
    writeSampleObject(folder / "a", GetParam(), options);
    const Object object = Object::open(folder / "a");
    const Manifest& m = object.manifest();
    const TileGrid grid = m.grid(0);
    for (int level = 0; level < grid.levels(); ++level)
      for (int y = 0; y < grid.tilesDown(level); ++y)
        for (int x = 0; x < grid.tilesAcross(level); ++x)
          EXPECT_EQ(object.planeTile(0, level, x, y), sampleCodes(m, 0, level, x, y))
              << bits << " bits, level " << level << ", tile " << x << "," << y;
  }
}

TEST_P(BothForms, ManyThreadsReadOneObject) {
  const TemporaryFolder folder;
  writeSampleObject(folder / "a", GetParam(), {});
  const Object object = Object::open(folder / "a");
  std::vector<int> right(4);
  std::vector<std::thread> threads;
  for (int& count : right)
    threads.emplace_back([&object, &count] {
      for (int i = 0; i < 40; ++i) {
        const int x = i % 2, y = i / 2 % 2;
        count += object.planeTile(0, 0, x, y) == sampleCodes(object.manifest(), 0, 0, x, y);
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(right, testing::Each(40));
}

TEST_P(BothForms, TheSameEntriesInAnyOrderGiveTheSameBytes) {
  const TemporaryFolder folder;
  auto entries = sampleEntries({});
  std::reverse(entries.begin(), entries.end());
  {
    ObjectWriter writer(folder / "a", GetParam(), "another fingerprint", false, false);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 3; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t i = t; i < entries.size(); i += 3)
          writer.add(entries[i].first, entries[i].second);
      });
    for (auto& thread : threads) thread.join();
    const auto bytes = writer.finish();
    EXPECT_EQ(bytes, Object::open(folder / "a").fileBytes());
  }
  const fs::path file = GetParam() == ObjectForm::Archive ? folder / "a" : folder / "a/index.bin";
  EXPECT_EQ(readFile(file, kLimit), sampleBytes(GetParam()));
}

TEST_P(BothForms, AWriterKilledAnywhereIsResumedToTheSameBytes) {
  const auto expected = sampleBytes(GetParam());
  const auto entries = sampleEntries({});
  for (std::size_t done = 0; done <= entries.size(); done += 3) {
    const TemporaryFolder folder;
    const fs::path out = folder / "a";
    const int status = statusOfChild([&] {
      ObjectWriter writer(out, GetParam(), "same", false, false);
      for (std::size_t i = 0; i < done; ++i) writer.add(entries[i].first, entries[i].second);
      ::raise(SIGKILL);
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_FALSE(fs::exists(out));
    // What a kill in the middle of writing an entry leaves.
    fs::create_directories(folder / "a.partial/entries/planes/0/0");
    writeFileAtomically(folder / "a.partial/entries/planes/0/0/.illum-1-2.tmp", "half");
    writeFileAtomically(folder / "a.partial/scratch/leftover", "scratch");
    writeFileAtomically(folder / "a.partial/packed.zip.Xy12", "half");
    {
      ObjectWriter writer(out, GetParam(), "same", true, false);
      EXPECT_THAT(contentsOf(writer.scratchFolder()), IsEmpty());
      for (std::size_t i = 0; i < entries.size(); ++i) {
        EXPECT_EQ(writer.has(entries[i].first), i < done) << entries[i].first;
        if (i >= done) writer.add(entries[i].first, entries[i].second);
      }
      writer.finish();
    }
    EXPECT_THAT(contentsOf(folder.path()), testing::ElementsAre("a"));
    EXPECT_THAT(verifyObject(out), IsEmpty());
    EXPECT_EQ(readFile(GetParam() == ObjectForm::Archive ? out : out / "index.bin", kLimit),
              expected)
        << done << " entries before the kill";
  }
}

TEST_P(BothForms, EntriesThatWereDamagedAreNotFinished) {
  const auto entries = sampleEntries({});
  const TemporaryFolder folder;
  const fs::path out = folder / "a", kept = folder / "a.partial/entries";
  {
    ObjectWriter writer(out, GetParam(), "same", false, false);
    for (const auto& [name, bytes] : entries) writer.add(name, bytes);
    writer.keepPartial();
  }
  // Cut short, one bit turned, not noted because the machine stopped in between.
  fs::resize_file(kept / entries[0].first, entries[0].second.size() - 1);
  auto turned = entries[1].second;
  turned[turned.size() / 2] ^= std::byte{1};
  writeFileAtomically(kept / entries[1].first, turned);
  const fs::path journal = folder / "a.partial/finished.txt";
  fs::resize_file(journal, fs::file_size(journal) - 1);
  {
    ObjectWriter writer(out, GetParam(), "same", true, false);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const bool whole = i > 1 && i + 1 < entries.size();
      EXPECT_EQ(writer.has(entries[i].first), whole) << entries[i].first;
      if (!whole) writer.add(entries[i].first, entries[i].second);
    }
    writer.finish();
  }
  EXPECT_EQ(readFile(GetParam() == ObjectForm::Archive ? out : out / "index.bin", kLimit),
            sampleBytes(GetParam()));
}

TEST_P(BothForms, ForceReplacesFilesAndObjects) {
  for (const auto old : {ObjectForm::Archive, ObjectForm::Folder}) {
    const TemporaryFolder folder;
    SampleOptions before;
    before.size = {10, 10};
    writeSampleObject(folder / "a", old, before);
    writeSampleObject(folder / "a", GetParam(), {});
    EXPECT_THAT(contentsOf(folder.path()), testing::ElementsAre("a"));
    EXPECT_EQ(Object::open(folder / "a").size(), SampleOptions().size);
    EXPECT_THAT(verifyObject(folder / "a"), IsEmpty());
  }
}

TEST_P(BothForms, WhatExistsIsRefusedBeforeAnyWork) {
  const TemporaryFolder folder;
  writeFileAtomically(folder / "a", "precious");
  const Failure failure =
      failureOf([&] { ObjectWriter(folder / "a", GetParam(), "f", false, false); });
  EXPECT_THAT(failure.sentence, HasSubstr("a: expected no file there yet (--force replaces it)"));
  EXPECT_EQ(failure.fault, Fault::Input);
  EXPECT_THAT(contentsOf(folder.path()), testing::ElementsAre("a"));
  EXPECT_EQ(readTextFile(folder / "a", kLimit), "precious");
}

TEST_P(BothForms, WhatComesToExistMeanwhileIsNotReplacedAndTheWorkIsKept) {
  const TemporaryFolder folder;
  {
    ObjectWriter writer(folder / "a", GetParam(), "same", false, false);
    for (const auto& [name, bytes] : sampleEntries({})) writer.add(name, bytes);
    writeFileAtomically(folder / "a", "precious");
    EXPECT_THAT(failureOf([&] { writer.finish(); }).sentence, HasSubstr("expected no file there"));
  }
  EXPECT_EQ(readTextFile(folder / "a", kLimit), "precious");
  ObjectWriter writer(folder / "a", GetParam(), "same", true, true);
  EXPECT_TRUE(writer.has("object.json"));
  writer.finish();
  EXPECT_THAT(verifyObject(folder / "a"), IsEmpty());
}

TEST_P(BothForms, AFullDiskIsTheMachinesFaultAndLeavesNothingHalfWritten) {
  const auto entries = sampleEntries({});
  // Limits at which the first entry, the packed archive, or nothing fails.
  for (const rlim_t limit : {rlim_t{600}, rlim_t{20000}}) {
    const TemporaryFolder folder;
    const fs::path out = folder / "a";
    const int status = statusOfChild([&] {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit size{limit, limit};
      ::setrlimit(RLIMIT_FSIZE, &size);
      const Failure failure = failureOf([&] {
        ObjectWriter writer(out, GetParam(), "same", false, false);
        for (const auto& [name, bytes] : entries) writer.add(name, bytes);
        writer.finish();
      });
      ::_exit(failure.sentence.empty() ? 0 : static_cast<int>(failure.fault));
    });
    ASSERT_TRUE(WIFEXITED(status));
    if (GetParam() == ObjectForm::Archive || limit < 20000) {
      EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(Fault::Machine)) << limit;
      const bool nothingDone = limit < 20000;
      EXPECT_THAT(contentsOf(folder.path()),
                  testing::ElementsAreArray(nothingDone ? std::vector<std::string>{}
                                                        : std::vector<std::string>{"a.partial"}))
          << limit;
    }
    // With room again, the same work goes on.
    if (WEXITSTATUS(status) != 0) {
      ObjectWriter writer(out, GetParam(), "same", true, false);
      for (const auto& [name, bytes] : entries)
        if (!writer.has(name)) writer.add(name, bytes);
      writer.finish();
    }
    EXPECT_THAT(verifyObject(out), IsEmpty());
  }
}

TEST(ObjectWriter, TakesNoFolderThatHoldsSomethingElse) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "photos");
  writeFileAtomically(folder / "photos/one.jpg", "precious");
  const auto sentence = failureOf([&] {
                          ObjectWriter(folder / "photos", ObjectForm::Archive, "f", false, true);
                        }).sentence;
  EXPECT_THAT(sentence, HasSubstr("a folder with other contents"));
  EXPECT_THAT(contentsOf(folder.path()), testing::ElementsAre("photos"));
  EXPECT_TRUE(fs::exists(folder / "photos/one.jpg"));
}

TEST(ObjectWriter, EmptiesNoPartialFolderThatItDidNotMake) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "a.partial");
  writeFileAtomically(folder / "a.partial/one.jpg", "precious");
  for (const bool resume : {false, true})
    EXPECT_THAT(failureOf([&] {
                  ObjectWriter(folder / "a", ObjectForm::Archive, "f", resume, true);
                }).sentence,
                HasSubstr("expected a folder of an unfinished object"));
  EXPECT_TRUE(fs::exists(folder / "a.partial/one.jpg"));
}

TEST(ObjectWriter, WithoutResumeThePartialFolderIsEmptied) {
  const TemporaryFolder folder;
  {
    ObjectWriter writer(folder / "a", ObjectForm::Archive, "same", false, false);
    writer.add("basis.bin", {});
    writer.keepPartial();
  }
  ASSERT_TRUE(fs::exists(folder / "a.partial/entries/basis.bin"));
  const ObjectWriter writer(folder / "a", ObjectForm::Archive, "same", false, false);
  EXPECT_FALSE(writer.has("basis.bin"));
}

TEST(ObjectWriter, AnotherFingerprintIsNotResumedAndNotTouched) {
  const TemporaryFolder folder;
  {
    ObjectWriter writer(folder / "a", ObjectForm::Archive, "one", false, false);
    writer.add("basis.bin", {});
    writer.keepPartial();
  }
  const Failure failure =
      failureOf([&] { ObjectWriter(folder / "a", ObjectForm::Archive, "two", true, false); });
  EXPECT_THAT(failure.sentence, HasSubstr("other settings"));
  EXPECT_EQ(failure.fault, Fault::Input);
  EXPECT_TRUE(fs::exists(folder / "a.partial/entries/basis.bin"));
}

TEST(ObjectWriter, AFailedInputRemovesThePartialFolder) {
  const TemporaryFolder folder;
  { ObjectWriter writer(folder / "a", ObjectForm::Archive, "f", false, false); }
  EXPECT_THAT(contentsOf(folder.path()), IsEmpty());
}

TEST(ObjectWriter, TwoProcessesDoNotWriteOneObject) {
  const TemporaryFolder folder;
  ObjectWriter writer(folder / "a", ObjectForm::Archive, "f", false, false);
  for (const bool resume : {false, true}) {
    const Failure failure =
        failureOf([&] { ObjectWriter(folder / "a", ObjectForm::Archive, "f", resume, false); });
    EXPECT_THAT(failure.sentence, HasSubstr("another process is writing this object"));
    EXPECT_EQ(failure.fault, Fault::Machine);
  }
  writer.add("basis.bin", {});
  EXPECT_TRUE(writer.has("basis.bin"));
}

TEST(ObjectWriter, AFolderThatCannotBeWrittenIsTheMachinesFault) {
  const Failure failure =
      failureOf([] { ObjectWriter("/proc/nowhere/a", ObjectForm::Archive, "f", false, false); });
  EXPECT_THAT(failure.sentence, HasSubstr("/proc/nowhere/a.partial"));
  EXPECT_EQ(failure.fault, Fault::Machine);
}

TEST(ObjectWriter, RefusesNamesThatAreNoEntries) {
  const TemporaryFolder folder;
  ObjectWriter writer(folder / "a", ObjectForm::Archive, "f", false, false);
  for (const std::string name : {"", "../x", "/x", "planes/0/0/0_0.gif", "index.bin", "notes"}) {
    EXPECT_THAT(failureOf([&] { writer.add(name, {}); }).sentence, HasSubstr("not the name"))
        << name;
    EXPECT_FALSE(writer.has(name)) << name;
  }
}

TEST(ObjectWriter, FinishesOnlyWhatIsComplete) {
  const auto entries = sampleEntries({});
  for (std::size_t missing = 0; missing < entries.size(); ++missing) {
    const std::string& name = entries[missing].first;
    if (name == "poster.jpg") continue;
    const TemporaryFolder folder;
    ObjectWriter writer(folder / "a", ObjectForm::Archive, "f", false, false);
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (i != missing) writer.add(entries[i].first, entries[i].second);
    EXPECT_THAT(failureOf([&] { writer.finish(); }).sentence, HasSubstr("without " + name));
    EXPECT_FALSE(fs::exists(folder / "a"));
  }
}

TEST(ObjectWriter, ATrailingSlashChangesNothing) {
  const TemporaryFolder folder;
  writeSampleObject(folder / "a/", ObjectForm::Folder, {});
  EXPECT_THAT(contentsOf(folder.path()), testing::ElementsAre("a"));
  EXPECT_THAT(verifyObject(folder / "a/"), IsEmpty());
}

// Frozen: local header, data, directory, end, of one stored entry.
TEST(WriteArchive, BytesAreFrozen) {
  const TemporaryFolder folder;
  writeFileAtomically(folder / "poster.jpg", "abc");
  const std::string names[] = {"poster.jpg"};
  writeArchive(folder / "out.zip", folder.path(), names);
  using namespace std::string_literals;
  const std::string expected =
      "PK\x03\x04\x0a\0\0\0\0\0\0\0\x21\0\xc2\x41\x24\x35\3\0\0\0\3\0\0\0\x0a\0\0\0poster.jpgabc"s +
      "PK\x01\x02\x3f\x03\x0a\0\0\0\0\0\0\0\x21\0\xc2\x41\x24\x35\3\0\0\0\3\0\0\0\x0a\0\0\0"s +
      "\0\0\0\0\0\0\0\0\xa4\x81\0\0\0\0poster.jpg"s +
      "PK\x05\x06\0\0\0\0\1\0\1\0\x38\0\0\0\x2b\0\0\0\0\0"s;
  EXPECT_EQ(testing::PrintToString(readTextFile(folder / "out.zip", kLimit)),
            testing::PrintToString(expected));
}

}  // namespace
}  // namespace illum
