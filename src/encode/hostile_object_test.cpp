// Objects that are damaged, or made to do harm. Each must end in one sentence, never in a crash, a
// hang or much memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/files.h"
#include "encode/raw_archive.h"
#include "encode/sample_object.h"
#include "encode/temporary_folder.h"
#include "illum/error.h"
#include "illum/object.h"
#include "object/index_file.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint64_t kLimit = 1 << 24;

SampleOptions tiny() {
  SampleOptions options;
  options.size = {12, 9};
  options.poster = false;
  return options;
}

std::span<const std::byte> asBytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return {};
}

/// A file in a folder of its own.
class HostileObject : public testing::Test {
 protected:
  const fs::path& write(std::span<const std::byte> bytes) {
    writeUnflushed(file_, bytes);
    return file_;
  }
  std::string errorOfOpening(std::span<const std::byte> bytes) {
    return errorOf([&] { Object::open(write(bytes)); });
  }
  std::string errorOfOpening(const std::vector<RawEntry>& entries) {
    return errorOfOpening(rawArchive(entries));
  }
  std::vector<std::string> faultsOf(const std::vector<RawEntry>& entries) {
    return verifyObject(write(rawArchive(entries)));
  }

  TemporaryFolder folder_;
  fs::path file_ = folder_ / "a.illum";
};

std::vector<RawEntry> rawSample(const SampleOptions& options) {
  std::vector<RawEntry> entries;
  for (const auto& [name, bytes] : sampleEntries(options))
    entries.push_back(storedEntry(name, bytes));
  return entries;
}

RawEntry& entryOf(std::vector<RawEntry>& entries, const std::string& name) {
  return *std::find_if(entries.begin(), entries.end(),
                       [&](const RawEntry& entry) { return entry.name == name; });
}

/// The sample with its manifest edited as JSON.
std::vector<RawEntry> withManifest(const std::function<void(nlohmann::json&)>& edit) {
  auto entries = rawSample(tiny());
  RawEntry& manifest = entryOf(entries, "object.json");
  auto root = nlohmann::json::parse(
      std::string(reinterpret_cast<const char*>(manifest.data.data()), manifest.data.size()));
  edit(root);
  manifest = storedEntry("object.json", asBytes(root.dump()));
  return entries;
}

TEST_F(HostileObject, TheArchiveBuiltByHandIsSound) {
  EXPECT_EQ(errorOfOpening(rawSample(tiny())), "");
  EXPECT_THAT(verifyObject(file_), IsEmpty());
}

TEST_F(HostileObject, EveryTruncationIsAnError) {
  writeSampleObject(file_, ObjectForm::Archive, tiny());
  const auto bytes = readFile(file_, kLimit);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THAT(errorOfOpening(std::span(bytes).first(length)), HasSubstr(file_.string()))
        << length;
}

// A flip either stops the object from opening, or verify tells of it, or it lies where the format
// gives no meaning (a time, an attribute) and every entry is as it was.
TEST_F(HostileObject, EveryFlippedBitIsFoundOrHarmless) {
  writeSampleObject(file_, ObjectForm::Archive, tiny());
  auto bytes = readFile(file_, kLimit);
  const auto expected = sampleEntries(tiny());
  std::size_t harmless = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto flip = static_cast<std::byte>(1 << i % 8);
    bytes[i] ^= flip;
    write(bytes);
    bytes[i] ^= flip;
    try {
      if (!verifyObject(file_).empty()) continue;
      ++harmless;
      const Object object = Object::open(file_);
      for (const auto& [name, contents] : expected)
        EXPECT_EQ(object.entry(name), contents) << "byte " << i << ", " << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input) << "byte " << i << ": " << error.what();
    }
  }
  EXPECT_LT(harmless, bytes.size() / 10);
}

TEST_F(HostileObject, EveryFlippedBitOfAFolderIsFound) {
  const fs::path object = folder_ / "folder";
  writeSampleObject(object, ObjectForm::Folder, tiny());
  for (const auto& name :
       {"object.json", "basis.bin", "planes/0/0/0_0.png", "mask/0/0/0_0.png", "index.bin"}) {
    const auto sound = readFile(object / name, kLimit);
    auto bytes = sound;
    for (std::size_t i = 0; i < bytes.size(); i += 7) {
      bytes[i] ^= static_cast<std::byte>(1 << i % 8);
      writeUnflushed(object / name, bytes);
      bytes[i] = sound[i];
      std::vector<std::string> faults;
      const std::string error = errorOf([&] { faults = verifyObject(object); });
      EXPECT_TRUE(!error.empty() || !faults.empty()) << name << " byte " << i;
    }
    writeFileAtomically(object / name, sound);
  }
  EXPECT_THAT(verifyObject(object), IsEmpty());
}

TEST_F(HostileObject, WhatIsNoArchiveIsAnError) {
  EXPECT_THAT(errorOfOpening(std::vector<std::byte>{}), HasSubstr("expected"));
  EXPECT_THAT(errorOfOpening(asBytes("hello, world")), HasSubstr("expected a zip archive"));
  EXPECT_THAT(errorOfOpening(sampleEntries(tiny())[2].second), HasSubstr("expected a zip archive"));
  std::vector<std::byte> noise(100000);
  std::mt19937 random(1);
  for (auto& byte : noise) byte = static_cast<std::byte>(random());
  EXPECT_THAT(errorOfOpening(noise), HasSubstr("expected a zip archive"));
}

TEST_F(HostileObject, AnArchiveOfAnotherKindIsAnError) {
  EXPECT_THAT(
      errorOfOpening({storedEntry("readme.txt", asBytes("hello"))}),
      HasSubstr("expected an .illum object, found an archive or folder without object.json"));
  EXPECT_THAT(errorOfOpening(std::vector<RawEntry>{}), HasSubstr("expected"));
}

TEST_F(HostileObject, WhatIsNotThereIsAnError) {
  EXPECT_THAT(errorOf([&] { Object::open(folder_ / "nothing"); }),
              HasSubstr("nothing: cannot open"));
  EXPECT_THAT(errorOf([&] { Object::open(folder_ / "no/thing"); }), HasSubstr("cannot open"));
  EXPECT_THAT(errorOf([&] { Object::open(folder_.path()); }),
              HasSubstr("folder without index.bin"));
  EXPECT_THAT(errorOf([&] { Object::open("/dev/null"); }),
              HasSubstr("neither a file nor a folder"));
}

TEST_F(HostileObject, NamesThatLeaveTheObjectAreErrors) {
  using namespace std::string_literals;
  for (const std::string& name : {"../evil"s, "/etc/passwd"s, "a/../../b"s, "a\\..\\b"s, "C:\\x"s,
                                  "planes//0"s, "./x"s, ""s, "planes/0/0/0_0.png/.."s, "bell\a"s}) {
    auto entries = rawSample(tiny());
    entries.push_back(storedEntry(name, asBytes("x")));
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("names that stay inside")) << name;
  }
}

TEST_F(HostileObject, ANameTwiceIsAnError) {
  for (const std::string name : {"object.json", "planes/0/0/0_0.png", "stranger"}) {
    auto entries = rawSample(tiny());
    entries.push_back(storedEntry("stranger", asBytes("x")));
    entries.push_back(storedEntry(name, asBytes("x")));
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("twice")) << name;
  }
}

TEST_F(HostileObject, ZipBombsAreRefusedBeforeTheyUnfold) {
  const std::string spaces(100 << 20, ' ');
  {
    auto entries = rawSample(tiny());
    entryOf(entries, "object.json") = deflatedEntry("object.json", asBytes(spaces));
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("object.json: expected at most 50331648 bytes"));
    // The same with a lie about the size: nothing beyond what was declared is unfolded.
    entryOf(entries, "object.json").size = 1000;
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("object.json is damaged"));
  }
  {
    auto entries = rawSample(tiny());
    entryOf(entries, "basis.bin") = deflatedEntry("basis.bin", asBytes(spaces + spaces + spaces));
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("basis.bin: expected at most 268435456 bytes"));
  }
  {
    auto entries = rawSample(tiny());
    entryOf(entries, "planes/0/0/0_0.png") = deflatedEntry("planes/0/0/0_0.png", asBytes(spaces));
    EXPECT_THAT(
        errorOfOpening(entries),
        HasSubstr("planes/0/0/0_0.png: expected a stored entry, found compression method 8"));
  }
}

TEST_F(HostileObject, DeclaredSizesThatTheArchiveCannotHoldAreErrors) {
  for (const std::string name : {"object.json", "planes/0/0/0_0.png", "mask/0/0/0_0.png"})
    for (const std::uint32_t size : {0u, 1u, 100000000u, 0xfffffffeu}) {
      auto entries = rawSample(tiny());
      entryOf(entries, name).size = size;
      EXPECT_NE(errorOfOpening(entries), "") << name << " of " << size;
    }
}

TEST_F(HostileObject, EncryptedAndOddlyCompressedEntriesAreErrors) {
  for (const std::string name : {"object.json", "basis.bin", "planes/0/0/0_0.png"}) {
    auto entries = rawSample(tiny());
    entryOf(entries, name).flags = 1;
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("encrypted")) << name;
    for (const std::uint16_t method : {1, 9, 12, 14, 93, 99, 65535}) {
      entries = rawSample(tiny());
      entryOf(entries, name).method = method;
      EXPECT_NE(errorOfOpening(entries), "") << name << " by method " << method;
    }
  }
}

TEST_F(HostileObject, AWrongChecksumIsFoundOnReading) {
  auto entries = rawSample(tiny());
  entryOf(entries, "planes/0/0/0_0.png").crc32 ^= 1;
  const Object object = Object::open(write(rawArchive(entries)));
  EXPECT_THAT(errorOf([&] { object.planeTile(0, 0, 0, 0); }),
              HasSubstr("planes/0/0/0_0.png is damaged"));
  EXPECT_THAT(verifyObject(file_), Each(HasSubstr("planes/0/0/0_0.png is damaged")));
  for (const std::string name : {"object.json", "basis.bin"}) {
    entries = rawSample(tiny());
    entryOf(entries, name).crc32 ^= 0x80000000u;
    EXPECT_THAT(errorOfOpening(entries), HasSubstr(name + " is damaged"));
  }
}

TEST_F(HostileObject, MissingEntriesAreNamed) {
  for (const std::string name : {"planes/0/0/0_0.png", "mask/0/0/0_0.png"}) {
    auto entries = rawSample(tiny());
    entries.erase(entries.begin() + (&entryOf(entries, name) - entries.data()));
    EXPECT_THAT(faultsOf(entries), testing::ElementsAre(HasSubstr(name + " is missing")));
  }
  auto entries = rawSample(tiny());
  entries.erase(entries.begin() + (&entryOf(entries, "basis.bin") - entries.data()));
  EXPECT_THAT(errorOfOpening(entries), HasSubstr("basis.bin is missing"));
}

TEST_F(HostileObject, UnknownEntriesAreReadOverAndTold) {
  auto entries = rawSample(tiny());
  entries.push_back(storedEntry("notes.txt", asBytes("x")));
  entries.push_back(deflatedEntry("planes/0/0/7_7.png", asBytes("x")));
  entries.back() = storedEntry("planes/0/0/7_7.png", asBytes("x"));
  entries.push_back(storedEntry("empty/", {}));
  EXPECT_EQ(errorOfOpening(entries), "");
  EXPECT_THAT(verifyObject(file_),
              testing::UnorderedElementsAre(HasSubstr("'notes.txt' does not belong"),
                                            HasSubstr("'planes/0/0/7_7.png' does not belong")));
}

TEST_F(HostileObject, SwappedTilesOfDifferentShapeAreFound) {
  auto entries = rawSample({});
  std::swap(entryOf(entries, "planes/0/0/0_0.png").name,
            entryOf(entries, "planes/0/0/1_0.png").name);
  EXPECT_THAT(faultsOf(entries), testing::UnorderedElementsAre(HasSubstr("planes/0/0/0_0.png"),
                                                               HasSubstr("planes/0/0/1_0.png")));
}

TEST_F(HostileObject, DirectoryAndLocalHeadersThatDisagreeAreFound) {
  auto entries = rawSample({});
  entryOf(entries, "planes/0/0/0_0.png").localName = "planes/0/0/1_0.png";
  EXPECT_THAT(faultsOf(entries), testing::Contains(HasSubstr("contradicts itself")));
}

TEST_F(HostileObject, SwappedTilesOfAFolderAreFound) {
  SampleOptions options;
  options.size = {128, 64};
  const fs::path object = folder_ / "folder";
  writeSampleObject(object, ObjectForm::Folder, options);
  const fs::path planes = object / "planes/0/0";
  fs::rename(planes / "0_0.png", planes / "t");
  fs::rename(planes / "1_0.png", planes / "0_0.png");
  fs::rename(planes / "t", planes / "1_0.png");
  EXPECT_THAT(verifyObject(object), testing::UnorderedElementsAre(HasSubstr("0_0.png is damaged"),
                                                                  HasSubstr("1_0.png is damaged")));
}

TEST_F(HostileObject, AFolderWhoseFilesAreNotFilesIsFound) {
  const fs::path object = folder_ / "folder";
  writeSampleObject(object, ObjectForm::Folder, tiny());
  const fs::path tile = object / "planes/0/0/0_0.png";
  fs::remove(tile);
  EXPECT_THAT(verifyObject(object), testing::ElementsAre(HasSubstr("0_0.png: cannot open")));
  ASSERT_EQ(::mkfifo(tile.c_str(), 0600), 0);
  EXPECT_THAT(verifyObject(object), testing::ElementsAre(HasSubstr("no ordinary file")));
  fs::remove(tile);
  fs::create_directory(tile);
  EXPECT_THAT(verifyObject(object), testing::ElementsAre(HasSubstr("no ordinary file")));
  fs::remove(tile);
  fs::create_symlink("0_0.png", tile);
  EXPECT_THAT(verifyObject(object), testing::ElementsAre(HasSubstr("0_0.png: cannot open")));
}

TEST_F(HostileObject, FilesBesideAnIndexAreTold) {
  const fs::path object = folder_ / "folder";
  writeSampleObject(object, ObjectForm::Folder, tiny());
  writeFileAtomically(object / "planes/notes.txt", "x");
  EXPECT_THAT(verifyObject(object),
              testing::ElementsAre(HasSubstr("'planes/notes.txt' is not in index.bin")));
  EXPECT_EQ(Object::open(object).size(), tiny().size);
}

TEST_F(HostileObject, AFutureVersionIsRefusedWithItsSentence) {
  EXPECT_EQ(errorOfOpening(withManifest([](auto& root) {
              root["version"] = {2, 0};
            })),
            file_.string() +
                ": object.json: made by a newer Illumigraph: format 2.0, this program "
                "reads 1.x");
  EXPECT_EQ(errorOfOpening(withManifest([](auto& root) { root["version"] = {1, 7}; })), "");
}

TEST_F(HostileObject, HugeDeclaredPicturesCostNothing) {
  const auto entries = withManifest([](auto& root) {
    root["groups"][0]["geometry"]["size"] = {{"width", 1 << 20}, {"height", 1 << 20}};
    root["tile"] = 1360;
  });
  EXPECT_EQ(errorOfOpening(entries), "");
  const Object object = Object::open(file_);
  EXPECT_THAT(errorOf([&] { object.planeTile(0, 0, 0, 0); }), HasSubstr("0_0.png: expected a PNG"));
  EXPECT_THAT(errorOf([&] { object.planeTile(0, 0, 700, 700); }), HasSubstr("is missing"));
  const auto faults = verifyObject(file_);
  EXPECT_EQ(faults.size(), 1001u);
  EXPECT_THAT(faults.back(), HasSubstr("more faults"));
}

TEST_F(HostileObject, TablesOutsideTheBasisFileAreErrors) {
  for (const auto& [offset, bytes] : std::vector<std::pair<int, int>>{
           {0, 100000}, {100000, 1}, {1, 268435456}, {268435456, 268435456}, {0, 1}, {3, 40}}) {
    const auto entries = withManifest([&](auto& root) {
      root["bases"][0]["tableOffset"] = offset;
      root["bases"][0]["tableBytes"] = bytes;
    });
    EXPECT_THAT(errorOfOpening(entries), HasSubstr("basis.bin")) << offset << " " << bytes;
  }
}

TEST_F(HostileObject, ATableThatIsNotTheManifestsIsAnError) {
  EXPECT_THAT(errorOfOpening(withManifest([](auto& root) {
                root["bases"][0]["coefficients"] = 5;
                root["bases"][0]["mixing"] = nlohmann::json::array();
              })),
              HasSubstr("expected a table of 5 columns"));
  EXPECT_THAT(
      errorOfOpening(withManifest([](auto& root) { root["bases"][0]["domain"] = "sphere"; })),
      HasSubstr("over another domain"));
}

TEST_F(HostileObject, TilesBeyondTheObjectAreWrongUsage) {
  const Object object = Object::open(write(rawArchive(rawSample(tiny()))));
  const std::vector<std::array<int, 4>> places{{1, 0, 0, 0},  {-1, 0, 0, 0}, {0, 1, 0, 0},
                                               {0, -1, 0, 0}, {0, 0, 1, 0},  {0, 0, 0, -1}};
  for (const auto& [group, level, x, y] : places) {
    try {
      object.planeTile(group, level, x, y);
      ADD_FAILURE() << group << level << x << y;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Usage);
    }
  }
}

}  // namespace
}  // namespace illum
