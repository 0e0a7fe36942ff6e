#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "illum/evaluate.h"
#include "study/fake_capture_for_test.h"
#include "study/object_for_test.h"
#include "study/report_pictures.h"

namespace illum {
namespace {

using testing::HasSubstr;
using testing::Not;

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

int grey(int, int, int) {
  return 100;
}

/// A report on an object that is wrong by one more under every further light.
std::string reportOn(Size size, const std::vector<LightFileEntry>& lights,
                     const std::string& name) {
  const TemporaryFolder folder("report");
  const Object object = makeObject(folder.path() / name, {size, grey, lights, {}});
  const FakeCapture capture(size, Transfer::Display, lights, [](int light, int, int, int) {
    return static_cast<float>(101 + light) / 255;
  });
  Progress progress;
  return htmlReport(object, capture, evaluate(object, capture, progress));
}

TEST(Report, ShowsTheThreeWorstAndTheThreeBestLights) {
  const std::string html = reportOn({40, 30}, ringOfLights(9), "a.illum");
  EXPECT_EQ(count(html, "<section class=\"trio\">"), 6);
  EXPECT_EQ(count(html, "src=\"data:image/jpeg;base64,"), 18);
  const auto worst = html.find("<h2>Worst lights</h2>"), best = html.find("<h2>Best lights</h2>");
  ASSERT_NE(worst, std::string::npos);
  ASSERT_LT(worst, best);
  EXPECT_LT(html.find("<b>light8.png</b>"), html.find("<b>light6.png</b>"));
  EXPECT_LT(html.find("<b>light6.png</b>"), best);
  EXPECT_GT(html.find("<b>light0.png</b>"), best);
  EXPECT_LT(html.find("<b>light0.png</b>"), html.find("<b>light2.png</b>"));
}

TEST(Report, FewLightsAreShownOnce) {
  for (const int lights : {1, 2, 4, 5})
    EXPECT_EQ(
        count(reportOn({16, 16}, ringOfLights(lights), "a.illum"), "<section class=\"trio\">"),
        lights);
}

TEST(Report, NamesViewAndLightOfTheWorstAndTheBestPictures) {
  const TemporaryFolder folder("reportviews");
  const auto lights = ringOfLights(2);
  FlatObject flat{{40, 30}, grey, lights, {}};
  flat.views = rowOfCameras(4, flat.size);
  flat.views[3].name = "<b>last</b>";
  const Object object = makeObject(folder.path() / "a.illum", flat);
  const FakeCapture capture(flat.views, lights, [](int view, int light, int, int, int) {
    return static_cast<float>(101 + 2 * view + light) / 255;
  });
  Progress progress;
  const Evaluation evaluation = evaluate(object, capture, progress);
  const int before = capture.reads();
  const std::string html = htmlReport(object, capture, evaluation);
  EXPECT_EQ(capture.reads() - before, 6) << "one read for each picture that is shown";
  EXPECT_EQ(count(html, "<section class=\"trio\">"), 6);
  const auto best = html.find("<h2>Best pictures</h2>");
  const auto worst = html.find("<b>light1.png</b><span>view &lt;b&gt;last&lt;/b&gt;</span>");
  EXPECT_LT(html.find("<h2>Worst pictures</h2>"), worst);
  EXPECT_LT(worst, html.find("<b>light1.png</b><span>view front2</span>"));
  EXPECT_LT(html.find("<b>light1.png</b><span>view front2</span>"), best);
  EXPECT_LT(best, html.find("<b>light0.png</b><span>view front0</span>"));
  EXPECT_THAT(html, HasSubstr("4 views of 40 × 30 to 46 × 30 pixels"));
  EXPECT_THAT(html, HasSubstr("<tr><td>front1</td><td>42 × 30</td>"));
  EXPECT_THAT(html, Not(HasSubstr("<b>last")));
}

TEST(Report, AReportOfOneViewSpeaksOfLightsOnly) {
  const std::string html = reportOn({40, 30}, ringOfLights(3), "a.illum");
  EXPECT_THAT(html, Not(HasSubstr("view ")));
  EXPECT_THAT(html, Not(HasSubstr("views")));
}

TEST(Report, StandsAlone) {
  const std::string html = reportOn({40, 30}, ringOfLights(3), "a.illum");
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  for (const char* element : {"div", "section", "table", "svg", "figure", "details", "p", "g"}) {
    const std::string open = std::string("<") + element;
    EXPECT_EQ(count(html, open + ">") + count(html, open + " "),
              count(html, std::string("</") + element + ">"))
        << element;
  }
}

TEST(Report, HostileNamesStayText) {
  auto lights = ringOfLights(2);
  lights[0].name = "\"><img src=x onerror=alert(1)>.jpg";
  lights[1].name = "</style><script>alert(1)</script>";
  const std::string html = reportOn({16, 16}, lights, "<b>&'.illum");
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("<h1>&lt;b&gt;&amp;&#39;.illum</h1>"));
}

ReportPictures onlyPictures(const Object& object, const Capture& capture) {
  const std::vector<int> lights{0};
  return reportPictures(Comparison(object, capture, {}, 1 << 20), lights).at(0);
}

TEST(ReportPictures, AreReducedToABoundedSize) {
  const TemporaryFolder folder("reduced");
  const auto lights = ringOfLights(1);
  for (const Size size : {Size{1500, 20}, Size{20, 641}, Size{640, 10}}) {
    const Object object = makeObject(folder.path() / "a.illum", {size, grey, lights, {}});
    FakeCapture capture(size, Transfer::Display, lights,
                        [](int, int, int, int) { return 103.0f / 255; });
    capture.withBandRows(3);
    const ReportPictures pictures = onlyPictures(object, capture);
    const int factor = size.width > 1280 ? 3 : size.width > 640 || size.height > 640 ? 2 : 1;
    const Size expected{(size.width + factor - 1) / factor, (size.height + factor - 1) / factor};
    EXPECT_EQ(pictures.photograph.size(), expected);
    EXPECT_EQ(pictures.relit.size(), expected);
    // Averages of a constant are that constant, in the last, smaller boxes too.
    for (const auto byte : pictures.photograph.samples()) ASSERT_EQ(byte, 103);
    for (const auto byte : pictures.relit.samples()) ASSERT_EQ(byte, 100);
    for (const auto byte : pictures.error.samples()) ASSERT_EQ(byte, 24);
  }
}

TEST(ReportPictures, LargeErrorsAreWhite) {
  const TemporaryFolder folder("white");
  const auto lights = ringOfLights(1);
  const Object object = makeObject(folder.path() / "a.illum", {{8, 8}, grey, lights, {}});
  const FakeCapture capture({8, 8}, Transfer::Display, lights,
                            [](int, int, int, int) { return 1.0f; });
  const ReportPictures pictures = onlyPictures(object, capture);
  for (const auto byte : pictures.error.samples()) ASSERT_EQ(byte, 255);
}

}  // namespace
}  // namespace illum
