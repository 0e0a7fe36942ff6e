#include "capture/light_file_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/test_photographs.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

struct Case {
  std::vector<std::string> files;
  std::string found;   // empty: an error
  std::string saying;  // part of the remark or the error
};

TEST(LightFileSearch, PrefersWhatIsClearlyMeant) {
  const std::vector<Case> cases{
      {{"a.lp", "a.jpg"}, "a.lp", ""},
      {{"A.LP", "lights.txt"}, "A.LP", ""},
      {{"a.lp", "lights.lp", "z.lp"}, "lights.lp", "among a.lp, lights.lp, z.lp"},
      {{"a.lp", "dirs.lp"}, "dirs.lp", "dirs.lp"},
      {{"lights.lp", "dirs.lp"}, "lights.lp", "lights.lp"},
      {{"a.lp", "b.lp"}, "", "expected one light file, found a.lp, b.lp"},
      {{"lights.lp", "Lights.LP"}, "", "found Lights.LP, lights.lp"},
      {{"lights.txt", "readme.txt"}, "lights.txt", ""},
      {{"readme.txt", "light_directions.txt", "light_intensities.txt"}, "light_directions.txt", ""},
      {{"dirs.csv", "dirs.txt"}, "", "found dirs.csv, dirs.txt"},
      {{"Lights.CSV", "table.csv"}, "Lights.CSV", ""},
      {{"table.csv", "photo.jpg"}, "table.csv", ""},
      {{"a.csv", "b.csv"}, "", "found a.csv, b.csv"},
      {{"readme.txt", "photo.jpg"}, "", "expected a light file"},
      {{".hidden.lp", "photo.jpg"}, "", "expected a light file"},
      {{}, "", "expected a light file"},
  };
  for (const Case& test : cases) {
    const test::Folder folder;
    for (const std::string& name : test.files) folder.writeText(name, "x");
    SCOPED_TRACE(testing::PrintToString(test.files));
    try {
      const FoundLightFile found = findLightFile(folder.path());
      EXPECT_EQ(found.file, folder / test.found);
      EXPECT_THAT(found.remark, HasSubstr(test.saying));
      EXPECT_EQ(found.remark.empty(), test.saying.empty());
    } catch (const Error& error) {
      EXPECT_EQ(test.found, "") << error.what();
      EXPECT_THAT(error.what(), HasSubstr(test.saying));
    }
  }
}

TEST(LightFileSearch, FoldersAreNoLightFiles) {
  const test::Folder folder;
  std::filesystem::create_directory(folder / "lights.lp");
  EXPECT_THROW(findLightFile(folder.path()), Error);
}

TEST(LightFileSearch, AMissingFolderIsAnError) {
  const test::Folder folder;
  EXPECT_THROW(findLightFile(folder / "nowhere"), Error);
}

}  // namespace
}  // namespace illum
