#include "capture/photograph_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "illum/error.h"

namespace illum {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

LightFile lightsNamed(const std::vector<std::string>& names) {
  LightFile lights;
  for (const std::string& name : names) {
    lights.entries.push_back({name, {}, static_cast<int>(lights.entries.size()) + 1});
  }
  return lights;
}

PhotographMatch match(const std::vector<std::string>& entries,
                      const std::vector<std::string>& files) {
  return matchPhotographs(lightsNamed(entries), "lights.lp", files);
}

std::string errorOf(const std::vector<std::string>& entries,
                    const std::vector<std::string>& files) {
  try {
    match(entries, files);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  return "no error";
}

TEST(PhotographMatch, NamesDecideAndNotTheOrder) {
  const auto found = match({"b.jpg", "a.jpg"}, {"a.jpg", "b.jpg", "lights.lp"});
  EXPECT_THAT(found.names, ElementsAre("b.jpg", "a.jpg"));
  EXPECT_THAT(found.remarks, IsEmpty());
}

TEST(PhotographMatch, TheExactNameGoesFirst) {
  const auto found = match({"a.jpg", "A.JPG"}, {"A.JPG", "a.jpg"});
  EXPECT_THAT(found.names, ElementsAre("a.jpg", "A.JPG"));
  EXPECT_THAT(found.remarks, IsEmpty());
}

TEST(PhotographMatch, CaseIsForgivenOnce) {
  const auto found = match({"IMG_1.JPG", "IMG_2.JPG"}, {"img_1.jpg", "img_2.jpg"});
  EXPECT_THAT(found.names, ElementsAre("img_1.jpg", "img_2.jpg"));
  EXPECT_THAT(found.remarks, ElementsAre(HasSubstr("2 of 2 names")));
}

TEST(PhotographMatch, TheEndingIsForgivenOnce) {
  const auto found = match({"a.tif", "B.tif", "c"}, {"a.jpg", "b.jpg", "c.jpg", "a.txt"});
  EXPECT_THAT(found.names, ElementsAre("a.jpg", "b.jpg", "c.jpg"));
  EXPECT_THAT(found.remarks,
              ElementsAre(HasSubstr("3 of 3 names are those of files but for the ending")));
}

TEST(PhotographMatch, DotsInNamesAreNoEndings) {
  const auto found = match({"shot.001", "shot.002"}, {"shot.001.png", "shot.002.png"});
  EXPECT_THAT(found.names, ElementsAre("shot.001.png", "shot.002.png"));
}

TEST(PhotographMatch, PhotographsWithoutALineAreRemarkedOn) {
  const auto found = match({"a.jpg"}, {"a.jpg", "b.jpg", "c.png", "notes.txt"});
  EXPECT_THAT(found.remarks, ElementsAre(HasSubstr("2 photographs in the folder have no line")));
}

TEST(PhotographMatch, AmbiguityIsAnError) {
  EXPECT_EQ(errorOf({"IMG.jpg"}, {"Img.jpg", "img.jpg"}),
            "lights.lp: expected one photograph for \"IMG.jpg\" in line 1, found Img.jpg, img.jpg");
  EXPECT_EQ(errorOf({"a.jpg", "b.tif"}, {"a.jpg", "b.jpg", "b.png"}),
            "lights.lp: expected one photograph for \"b.tif\" in line 2, found b.jpg, b.png");
}

TEST(PhotographMatch, TwoLinesForOnePhotographAreAnError) {
  EXPECT_EQ(errorOf({"a.jpg", "A.jpg"}, {"a.jpg"}),
            "lights.lp: expected a photograph for each line, found a.jpg meant by lines 1 and 2");
}

TEST(PhotographMatch, MissingPhotographsAreCounted) {
  EXPECT_EQ(errorOf({"a.jpg", "b.jpg"}, {"a.jpg"}),
            "lights.lp: expected the photograph \"b.jpg\" of line 2 in the folder, found no such "
            "file");
  EXPECT_THAT(errorOf({"a.jpg", "b.jpg", "c.jpg", "d.jpg"}, {"a.jpg"}),
              HasSubstr("\"b.jpg\" of line 2 and 2 others"));
}

}  // namespace
}  // namespace illum
