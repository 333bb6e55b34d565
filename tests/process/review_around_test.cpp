/// The strip of a review page around one event, with the curves of all panels over each other; and
/// texts on panels, none of which covers another.

#include <gtest/gtest.h>

#include "tests/support/browser/browser.h"
#include "tests/support/program.h"

namespace seam {
namespace review_around_test {

constexpr const char* kReady = "window.review && review.page.rects";

void RunWell(const std::vector<std::string>& words) {
  Program program(words);
  ASSERT_TRUE(program.Wait(120) && program.status() == 0) << program.Story();
}

/// A page of several methods on one scene.
class ReviewAround : public ::testing::Test {
 protected:
  void Make(const std::string& scene, const std::vector<std::string>& methods) {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
    std::vector<std::string> page = {BuiltProgram("seam-render"), "--page"};
    for (const std::string& method : methods) {
      page.push_back(folder_ / (method + ".lcm"));
      RunWell({BuiltProgram("seam-lab"), "run", "scenes/" + scene + ".toml", "-o", page.back(),
               "--no-floor", "--duration", "5", "--impair", "delay=100ms,jitter=10ms,loss=1.25%",
               "--reconcile", method});
    }
    page.insert(page.end(), {"-o", folder_ / "page.html"});
    RunWell(page);
  }
  void Open(int width, int height, const std::string& fragment) {
    browser_ = std::make_unique<Browser>(width, height);
    ASSERT_TRUE(browser_->Open(folder_ / "page.html", fragment, kReady));
  }
  void TearDown() override {
    if (browser_ == nullptr) return;
    for (const std::string& complaint : browser_->complaints()) ADD_FAILURE() << complaint;
  }
  std::string Text(const std::string& id) {
    return browser_->Evaluate("document.getElementById('" + id + "').textContent");
  }

  const Workspace folder_;
  std::unique_ptr<Browser> browser_;
};

TEST_F(ReviewAround, CurvesOfAllPanelsLieOverEachOtherAtTheEvent) {
  Make("crossing", {"rollback", "fade"});
  if (IsSkipped()) return;
  Open(1400, 1000, "v=0.1,1.1&t=150");
  browser_->Press("e");
  EXPECT_EQ(browser_->Evaluate("document.getElementById('around').getAttribute('aria-pressed')"),
            "true");
  EXPECT_EQ(browser_->Evaluate("review.page.around.kind"), "impact");
  EXPECT_NE(Text("around-text").find("0 s is the impact at rollback "), std::string::npos);
  EXPECT_NE(Text("around-text").find(", fade "), std::string::npos);
  // Each run's own event is at the strip's 0 s.
  const double same = browser_->Number(
      "review.page.views().filter((view, i) => {"
      " const {around} = review.page; const at = around.events[i].at;"
      " const cut = around.cut(view.curve('error'), i);"
      " return cut.every((value, k) =>"
      "   Object.is(value, view.curve('error')[at - around.before + k] ?? NaN)); }).length");
  EXPECT_EQ(same, 2);
  EXPECT_EQ(browser_->Number("review.page.around.seconds(review.page.around.before)"), 0);
  // A click at 0 s goes to the event, whatever the page's width.
  browser_->Evaluate("review.page.player.go(10)");
  const double share = browser_->Number(
      "review.page.strip.x(review.page.around.before) / document.getElementById('strip')"
      ".clientWidth");
  browser_->Drag("#strip", share, share);
  EXPECT_EQ(browser_->Number("review.state.tick"), browser_->Number("review.page.around.event.at"));
  // The numbers beside it.
  EXPECT_EQ(browser_->Evaluate("aroundCsv(review.page.around, review.page.views(), 'error')"
                               ".split('\\n')[0]"),
            "run,view,event,event_s,after_s,measure,value");
  EXPECT_GT(browser_->Number("aroundCsv(review.page.around, review.page.views(), 'error')"
                             ".split('\\n').filter((row) => row.startsWith('fade,ann')).length"),
            100);
  EXPECT_NE(browser_->Evaluate("location.hash").find("&e="), std::string::npos);
  browser_->Click("#around");
  EXPECT_EQ(browser_->Evaluate("review.page.around"), "null");
  EXPECT_EQ(Text("around-text"), "");
}

TEST_F(ReviewAround, NoTextOfAPanelCoversAnother) {
  Make("rally", {"rollback", "fade"});
  if (IsSkipped()) return;
  Open(1400, 1000, "v=0.1,1.1&l=truth,names,heat&t=60");
  browser_->Evaluate(
      "(() => { window.boxes = []; const context = CanvasRenderingContext2D.prototype;"
      " const fill = context.fillText;"
      " context.fillText = function (text, x, y) {"
      "  if (this.canvas.id === 'world') {"
      "   const size = this.measureText(text);"
      "   const left = x - {left: 0, center: 0.5, right: 1}[this.textAlign] * size.width;"
      "   boxes.push([left, y - size.actualBoundingBoxAscent, left + size.width,"
      "    y + size.actualBoundingBoxDescent, text]); }"
      "  return fill.call(this, text, x, y); }; return 1; })()");
  // The bats' names are led through the corners, over titles and scales, by a camera that moves.
  const std::string covered = browser_->Evaluate(
      "(() => { const found = []; let texts = 0; let names = 0;"
      " const names_of = new Set(review.page.runs[0].names.values());"
      " for (const mode of ['side', 'difference', 'wipe']) {"
      "  review.state.mode = mode;"
      "  for (let y = -6; y <= 14; y += 0.5) for (let x = -16; x <= 16; x += 2) {"
      "   review.state.camera = {x, y, height: 9}; boxes.length = 0; review.page.draw(0);"
      "   texts += boxes.length; names += boxes.filter((b) => names_of.has(b[4])).length;"
      "   boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => {"
      "    if (mode === 'wipe' && a[4] === b[4]) return;"  // drawn on both sides of the divider
      "    if (a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3])"
      "     found.push(mode + ': ' + a[4] + ' and ' + b[4]); })); } }"
      " return texts < 1000 || names < 300 ? 'few texts: ' + texts + ', ' + names :"
      "  found.length === 0 ? 'none' : found.length + ', ' + found.slice(0, 5).join('; '); })()");
  EXPECT_EQ(covered, "none");
}

TEST_F(ReviewAround, ALongNetworksNameFitsAPhone) {
  Make("crossing", {"rollback"});
  if (IsSkipped()) return;
  Open(390, 800, "");
  EXPECT_LE(browser_->Number("document.scrollingElement.scrollWidth"), 390);
  EXPECT_LE(browser_->Number("document.getElementById('help-open').getBoundingClientRect().right"),
            390);
}

}  // namespace review_around_test
}  // namespace seam
