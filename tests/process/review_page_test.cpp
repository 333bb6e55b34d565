/// A review page in a browser: clicks, drags and keys work, its numbers equal seam-measure's, and
/// nothing leaves the file.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "common/base/plain_file.h"
#include "render/page/document.h"
#include "tests/support/browser/browser.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace review_page_test {

constexpr const char* kReady = "window.review && review.page.rects";
constexpr const char* kPicture = "document.getElementById('world').toDataURL()";

/// Runs a program to its end and returns what it printed.
std::string RunWell(const std::vector<std::string>& words) {
  Program program(words);
  EXPECT_TRUE(program.Wait(120) && program.status() == 0) << program.Story();
  return program.output();
}

/// A page of two runs of crossing, opened in a browser.
class ReviewPage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
    RunWell({BuiltProgram("seam-lab"), "run", "scenes/crossing.toml", "-o",
             folder_ / "rollback.lcm", "--no-floor", "--impair", "4g", "--seed", "3"});
    RunWell({BuiltProgram("seam-lab"), "run", "scenes/crossing.toml", "-o", folder_ / "strict.lcm",
             "--no-floor", "--impair", "4g", "--seed", "3", "--mode", "strict"});
    RunWell({BuiltProgram("seam-render"), "--page", folder_ / "rollback.lcm",
             folder_ / "strict.lcm", "-o", page()});
    browser_ = std::make_unique<Browser>(1400, 1000);
    ASSERT_TRUE(browser_->Open(page(), "", kReady));
  }
  void TearDown() override {
    if (browser_ == nullptr) return;
    for (const std::string& complaint : browser_->complaints()) ADD_FAILURE() << complaint;
  }
  std::string page() const { return folder_ / "review.html"; }

  const Workspace folder_;
  std::unique_ptr<Browser> browser_;
};

/// The one row of seam-measure's table of a log, by column, and the errors shown ("shown rms").
std::map<std::string, double> MeasureOf(const std::string& log, const std::string& csv,
                                        double from_s, double to_s) {
  const std::string text =
      RunWell({BuiltProgram("seam-measure"), log, "--more", "--from", std::to_string(from_s),
               "--to", std::to_string(to_s), "--csv", csv});
  std::istringstream lines(ReadPlainFile(csv, 1 << 20));
  std::string names, values;
  std::getline(lines, names);
  std::getline(lines, values);
  std::istringstream name_cells(names), value_cells(values);
  std::map<std::string, double> row;
  for (std::string name, value;
       std::getline(name_cells, name, ',') && std::getline(value_cells, value, ',');)
    row[name] = std::strtod(value.c_str(), nullptr);
  const std::size_t shown = text.find("error shown");
  EXPECT_EQ(std::sscanf(text.c_str() + std::min(shown, text.size()),
                        "error shown %lf m RMS, %lf m p95, %lf m at most", &row["shown rms"],
                        &row["shown p95"], &row["shown max"]),
            3);
  return row;
}

TEST_F(ReviewPage, IsScrubbedByMouseAndByKeys) {
  const std::string before = browser_->Evaluate(kPicture);
  browser_->Click("#scrub");
  const double middle = browser_->Number("review.state.tick");
  EXPECT_NEAR(middle, browser_->Number("review.page.player.last / 2"), 4);
  EXPECT_NE(browser_->Evaluate(kPicture), before);
  EXPECT_EQ(browser_->Evaluate("document.getElementById('clock').textContent.includes('tick " +
                               std::to_string(static_cast<int>(middle)) + "')"),
            "true");
  browser_->Press("ArrowRight");
  EXPECT_EQ(browser_->Number("review.state.tick"), middle + 1);
  browser_->Press("ArrowLeft");
  browser_->Press("ArrowLeft");
  EXPECT_EQ(browser_->Number("review.state.tick"), middle - 1);
  // From one event to the next and back again, wherever this run has them.
  browser_->Evaluate("review.page.player.go(0)");
  browser_->Click("#next");
  const double first = browser_->Number("review.state.tick");
  EXPECT_GT(first, 0);
  EXPECT_GT(browser_->Number("review.page.events().filter((event) => event.at === " +
                             std::to_string(first) + ").length"),
            0);
  EXPECT_NE(browser_->Evaluate("document.getElementById('event-text').textContent"), "");
  browser_->Click("#next");
  EXPECT_GT(browser_->Number("review.state.tick"), first);
  browser_->Click("#previous");
  EXPECT_EQ(browser_->Number("review.state.tick"), first);
  // Slowly, so that it does not end by itself on a machine that draws few pictures a second.
  browser_->Evaluate("(review.state.speed = 1 / 16, review.page.player.go(60))");
  browser_->Click("#play");
  const double begun = browser_->Number("review.state.tick");
  for (int i = 0; i < 20; ++i) browser_->Settle();
  EXPECT_GT(browser_->Number("review.state.tick"), begun);
  browser_->Click("#play");
  EXPECT_EQ(browser_->Evaluate("review.state.playing"), "false");
}

TEST_F(ReviewPage, ADraggedDividerWipesBetweenTwoRuns) {
  browser_->Click("#worst");
  browser_->Click("[data-mode=wipe]");
  const std::string half = browser_->Evaluate(kPicture);
  // From the middle of the panel's width to 15 % of it.
  const double wide = browser_->Number("document.getElementById('world').clientWidth");
  const double divider = browser_->Number("document.getElementById('divider').offsetWidth");
  browser_->Drag("#divider", 0.5, 0.5 - 0.35 * wide / divider);
  EXPECT_NEAR(browser_->Number("review.state.wipe"), 0.15, 0.01);
  EXPECT_NE(browser_->Evaluate(kPicture), half);
  // All of one side is that view alone.
  browser_->Evaluate("(review.state.wipe = 1, review.page.changed())");
  browser_->Settle();
  const std::string first = browser_->Evaluate(kPicture);
  browser_->Evaluate("(review.state.wipe = 0, review.page.changed())");
  browser_->Settle();
  EXPECT_NE(browser_->Evaluate(kPicture), first);
}

TEST_F(ReviewPage, ADraggedRangesNumbersAreSeamMeasures) {
  browser_->Drag("#strip", 0.45, 0.75);
  const double from = browser_->Number("review.state.range[0]");
  const double to = browser_->Number("review.state.range[1]");
  ASSERT_GT(to - from, 60);
  const std::string cells =
      "[...document.querySelectorAll('#range-body tr')].find((row) => row.textContent.startsWith('";
  for (const std::string run : {"rollback", "strict"}) {
    const double first = browser_->Number("review.page.runs[0].first");
    const auto row = MeasureOf(folder_ / (run + ".lcm"), folder_ / (run + ".csv"),
                               (from + first) / 60, (to + first) / 60);
    const auto cell = [&](int column) {
      return browser_->Number(cells + run + " · all views')).children[" + std::to_string(column) +
                              "].dataset.value");
    };
    EXPECT_NEAR(cell(1), row.at("shown rms"), 5e-5) << run;
    EXPECT_NEAR(cell(2), row.at("shown p95"), 5.1e-5 + 1e-5 * cell(2)) << run;
    EXPECT_NEAR(cell(3), row.at("shown max"), 5.1e-5 + 1e-5 * cell(3)) << run;
    EXPECT_GT(row.at("shown max"), 0.01) << run << ": nothing to compare";
  }
  browser_->Evaluate("(review.state.measure = 'stutter', review.page.changed())");
  browser_->Settle();
  const double first = browser_->Number("review.page.runs[0].first");
  const auto row = MeasureOf(folder_ / "strict.lcm", folder_ / "stutter.csv", (from + first) / 60,
                             (to + first) / 60);
  const double stutter =
      browser_->Number(cells + "strict · all views')).children[1].dataset.value");
  EXPECT_NEAR(stutter, row.at("stutter_shown_mps2"), 0.01 + 1e-4 * stutter);
  EXPECT_GT(stutter, 1);
}

TEST_F(ReviewPage, ItsAddressRestoresTheView) {
  browser_->Click("#worst");
  browser_->Click("[data-mode=difference]");
  browser_->Click("[data-layer=heat]");
  browser_->Drag("#strip", 0.3, 0.6);
  browser_->Click("#bodies-body button");
  const std::string chosen =
      "JSON.stringify([review.state.tick, review.state.mode, "
      "review.state.layers.heat, review.state.range, review.state.follow])";
  const std::string before = browser_->Evaluate(chosen);
  const std::string picture = browser_->Evaluate(kPicture);
  const std::string fragment = browser_->Evaluate("location.hash.slice(1)");
  ASSERT_TRUE(browser_->Open(page(), fragment, kReady));
  EXPECT_EQ(browser_->Evaluate(chosen), before);
  EXPECT_EQ(browser_->Evaluate(kPicture), picture);
}

TEST_F(ReviewPage, ExportsPicturesAndNumbers) {
  browser_->Click("#worst");
  const std::string svg = "new DOMParser().parseFromString(svgOf(review.page), 'image/svg+xml')";
  EXPECT_EQ(browser_->Evaluate(svg + ".querySelectorAll('parsererror').length"), "0");
  EXPECT_GT(browser_->Number(svg + ".querySelectorAll('path').length"), 20);
  const std::string rows = "csvOf(review.page.views(), [10, 19]).trim().split('\\n').length";
  // A heading, then two views of ten ticks of four bodies.
  EXPECT_EQ(browser_->Number(rows), 1 + 2 * 10 * 4);
}

TEST(ReviewPageNames, NamesInARecordingAreTextAndNeverMarkup) {
  if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
  const std::string hostile = "</script><img src=x onerror=\"hacked=1\"><b>&amp;'";
  Scene scene = synthetic::MakeScene();
  scene.title = scene.parts[1].name = scene.parts[4].name = scene.players[0].name = hostile;
  Recording recording = synthetic::MakeRecording(6);
  recording.room.impair = recording.room.scene_name = recording.room.reconcile = hostile;
  Event event;
  event.tick = 40;
  event.text = hostile;
  recording.events.push_back(event);
  const Playback playback(recording, scene, synthetic::MakeOracle());
  const Workspace folder;
  const std::string html = PageHtml({{hostile, &playback}, {"b", &playback}});
  EXPECT_EQ(html.find("onerror"), std::string::npos);
  folder.Write("hostile.html", html);
  Browser browser(1200, 900);
  ASSERT_TRUE(browser.Open(folder / "hostile.html", "", kReady));
  browser.Evaluate("(review.state.layers.names = true, review.page.changed())");
  browser.Click("#next");
  browser.Click("#worst");
  EXPECT_EQ(browser.Evaluate("typeof hacked"), "undefined");
  EXPECT_EQ(browser.Number("document.querySelectorAll('img, b').length"), 0);
  EXPECT_EQ(browser.Evaluate("document.body.textContent.includes('<img src=x')"), "true");
  for (const std::string& complaint : browser.complaints()) ADD_FAILURE() << complaint;
}

}  // namespace review_page_test
}  // namespace seam
