/// The layers of a review page besides bodies: jumps, losses, onion skin, strands, holes in bricks.

#include <gtest/gtest.h>

#include "tests/support/browser/browser.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace review_layers_test {

constexpr const char* kReady = "window.review && review.page.rects";
constexpr const char* kPicture = "document.getElementById('world').toDataURL()";

class ReviewLayers : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
  }
  void TearDown() override {
    if (browser_ == nullptr) return;
    for (const std::string& complaint : browser_->complaints()) ADD_FAILURE() << complaint;
  }
  /// Runs a scene and opens its page.
  void Open(const std::string& scene, const std::string& seconds) {
    const std::string log = folder_ / "run.lcm", page = folder_ / "review.html";
    Program run({BuiltProgram("seam-lab"), "run", "scenes/" + scene + ".toml", "-o", log,
                 "--no-floor", "--impair", "4g", "--seed", "3", "--duration", seconds});
    ASSERT_TRUE(run.Wait(120) && run.status() == 0) << run.Story();
    Program render({BuiltProgram("seam-render"), "--page", log, "-o", page});
    ASSERT_TRUE(render.Wait(120) && render.status() == 0) << render.Story();
    browser_ = std::make_unique<Browser>(1400, 1000);
    ASSERT_TRUE(browser_->Open(page, "", kReady));
  }
  double Number(const std::string& expression) { return browser_->Number(expression); }

  const Workspace folder_;
  std::unique_ptr<Browser> browser_;
};

TEST_F(ReviewLayers, LossesHaveARowForEachChannelWithALabel) {
  Open("crossing", "5");
  EXPECT_EQ(Number("document.getElementById('losses').hidden ? 1 : 0"), 0);
  EXPECT_GE(Number("review.page.losses.rows.length"), 1);
  const std::string text = browser_->Evaluate(
      "(() => { const l = review.page.losses, loss = l.rows[0][1][0];"
      "return l.textAt(l.x((loss[0] + loss[1]) / 2), 10, (t) => t / 60); })()");
  EXPECT_NE(text.find("datagrams"), std::string::npos) << text;
  const std::string before = browser_->Evaluate(kPicture);
  browser_->Press("k");
  browser_->Settle();
  EXPECT_NE(browser_->Evaluate(kPicture), before) << "onion skin";
}

TEST_F(ReviewLayers, RegionsEncloseEachClientsBodiesIfTheSceneFixesNone) {
  Open("derby", "3");
  const std::string view = "review.page.runs[0].views[0]";
  ASSERT_EQ(Number(view + ".peer"), 0);
  EXPECT_GE(Number("heldRegions(" + view + ", 150).length"), 2);
  EXPECT_EQ(Number("review.page.runs[0].regions.length"), 0) << "the scene fixes none";
  // Distance of a held body's centre inside its holder's region, m: its reach and the margin.
  const std::string inside =
      "(() => { const v = " + view +
      "; let least = Infinity, held = 0;"
      "const regions = new Map(heldRegions(v, 150).map((r) => [r.peer, r.corners]));"
      "for (const body of v.worldAt(150).moving) {"
      "const t = v.tracks.bodies.get(body.id), p = poseOf(t, 150);"
      "const peer = p ? Math.floor(t.owner[150] / 3) : 0; if (peer <= 0) continue; ++held;"
      "const [[x0, y0], , [x1, y1]] = regions.get(peer);"
      "least = Math.min(least, p[0] - x0 / 1000, x1 / 1000 - p[0], p[1] - y0 / 1000,"
      "y1 / 1000 - p[1]); } return held > 0 ? least : -1; })()";
  EXPECT_GE(Number(inside), 1);
  browser_->Evaluate("(() => { review.state.tick = 150; review.page.changed(); return 1; })()");
  browser_->Settle();
  const std::string before = browser_->Evaluate(kPicture);
  browser_->Press("r");
  browser_->Settle();
  EXPECT_NE(browser_->Evaluate(kPicture), before) << "the layer of regions";
}

TEST_F(ReviewLayers, StrandsHangAsInTheView) {
  Open("obstacle", "2");
  const std::string view = "review.page.runs[0].views[1]";
  EXPECT_GE(Number(view + ".strands.length"), 1);
  // The first point is on the part: within 2 m of its body, at each tick that is known.
  EXPECT_LT(
      Number("(() => { const v = " + view +
             ", s = v.strands[0]; let most = 0;"
             "for (const [tick, row] of s.rowOf) {"
             "const p = poseOf(v.tracks.bodies.get(s.part), tick - v.run.first); if (!p) continue;"
             "most = Math.max(most, Math.hypot(s.columns[0][row] / 1000 - p[0],"
             "s.columns[1][row] / 1000 - p[1])); } return most; })()"),
      2);
  EXPECT_GT(Number(view + ".strands[0].rowOf.size"), 60);
}

TEST_F(ReviewLayers, BlastedBricksAreHolesFromThenOn) {
  Open("battlefield", "9");
  const std::string worlds = "review.page.runs[0].worlds";
  EXPECT_EQ(Number(worlds + "[0].holes.length"), 0);
  EXPECT_GT(Number("Math.max(..." + worlds + ".map((w) => w.holes.length))"), 0);
}

}  // namespace review_layers_test
}  // namespace seam
