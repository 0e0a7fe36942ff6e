#include "oiio/oiio_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace illum {
namespace {

using testing::HasSubstr;

TEST(OiioModule, IsFoundOnceForAll) {
  std::vector<const OiioModule*> found(8);
  std::vector<std::thread> threads;
  for (const OiioModule*& module : found) {
    threads.emplace_back([&module] { module = &oiioModule("a.tif", "TIFF"); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(found.front(), nullptr);
  EXPECT_THAT(found, testing::Each(found.front()));
}

TEST(OiioModule, OfAnotherBuildIsNotTaken) {
  const LoadedOiioModule other = loadOiioModule(ILLUM_OTHER_OIIO_BUILD);
  EXPECT_EQ(other.functions, nullptr);
  EXPECT_THAT(other.fault, HasSubstr("does not belong to this program"));
  EXPECT_THAT(other.fault, HasSubstr("found 0.0.9-other"));
}

TEST(OiioModule, ThatIsMissingOrSomethingElseIsNotTaken) {
  const LoadedOiioModule missing = loadOiioModule("illum_oiio_that_is_not_there.so");
  EXPECT_EQ(missing.functions, nullptr);
  EXPECT_THAT(missing.fault, HasSubstr("cannot be loaded: illum_oiio_that_is_not_there.so"));
  const LoadedOiioModule other = loadOiioModule("libz.so.1");
  EXPECT_EQ(other.functions, nullptr);
  EXPECT_THAT(other.fault, HasSubstr("is something else"));
}

}  // namespace
}  // namespace illum
