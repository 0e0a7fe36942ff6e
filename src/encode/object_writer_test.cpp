#include "encode/object_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "encode/sample_object.h"
#include "illum/object.h"

namespace illum {
namespace {

TEST(ObjectWriter, WritesWhatObjectReads) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "ow";
  std::filesystem::create_directories(folder);
  for (const auto form : {ObjectForm::Archive, ObjectForm::Folder}) {
    for (const Coding coding : {Coding::Png, Coding::Avif, Coding::Jpeg}) {
      SampleOptions options;
      options.coding = coding;
      const auto out = folder / "a.illum";
      std::filesystem::remove_all(out);
      writeSampleObject(out, form, options);
      const Object object = Object::open(out);
      EXPECT_EQ(object.size(), (Size{100, 70}));
      EXPECT_THAT(verifyObject(out), testing::IsEmpty());
      if (coding == Coding::Png) {
        EXPECT_EQ(object.planeTile(0, 0, 1, 1), sampleCodes(object.manifest(), 0, 1, 1));
      }
      EXPECT_EQ(object.maskTile(0, 0, 1, 1), sampleMask(object.manifest(), 0, 1, 1));
    }
  }
}

}  // namespace
}  // namespace illum
