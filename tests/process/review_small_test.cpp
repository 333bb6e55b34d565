/// Review pages that are narrow, change their colours while they are open, are of a damaged log, or
/// of a room without errors.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "common/base/plain_file.h"
#include "tests/support/browser/browser.h"

namespace seam {
namespace review_small_test {

constexpr const char* kReady = "window.review && review.page.rects";

class SmallReview : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
    Run({BuiltProgram("seam-lab"), "run", "scenes/crossing.toml", "-o", log(), "--no-floor",
         "--duration", "2", "--mode", "oracle"},
        0);
  }
  static void Run(const std::vector<std::string>& words, int status) {
    Program program(words);
    ASSERT_TRUE(program.Wait(120) && program.status() == status) << program.Story();
  }
  /// Opens a page of the log, which seam-render makes with that status.
  void Open(int width, int height, int status = 0) {
    Run({BuiltProgram("seam-render"), "--page", log(), "-o", folder_ / "page.html"}, status);
    browser_ = std::make_unique<Browser>(width, height);
    ASSERT_TRUE(browser_->Open(folder_ / "page.html", "", kReady));
  }
  std::string log() const { return folder_ / "log.lcm"; }

  const Workspace folder_;
  std::unique_ptr<Browser> browser_;
};

TEST_F(SmallReview, APageOf320PixelsDoesNotScrollSideways) {
  Open(320, 640);
  // As a live page has it, the longest measure.
  browser_->Evaluate(
      "document.getElementById('measure').append(new Option('Error against the oracle, at the "
      "tick shown'))");
  browser_->Settle();
  EXPECT_LE(browser_->Number("document.documentElement.scrollWidth"), 320);
  EXPECT_LE(browser_->Number("document.getElementById('measure').getBoundingClientRect().right"),
            320);
}

TEST_F(SmallReview, SwatchesFollowTheThemeWhileThePageIsOpen) {
  Open(1000, 800);
  const std::string colours =
      "[...document.querySelectorAll('#panel-heads .swatch, #range-body .swatch')]"
      ".map((s) => getComputedStyle(s).backgroundColor).join()";
  browser_->PreferDark(false);
  const std::string light = browser_->Evaluate(colours);
  browser_->PreferDark(true);
  const std::string dark = browser_->Evaluate(colours);
  EXPECT_NE(light, dark);
  browser_->Evaluate("addPanelHeads(review.page)");
  EXPECT_EQ(browser_->Evaluate(colours), dark) << "as a page that is opened in the dark";
}

TEST_F(SmallReview, AnErrorOfZeroIsKnown) {
  Open(1000, 800);
  browser_->Evaluate("review.page.goWorst()");
  EXPECT_EQ(browser_->Evaluate("document.getElementById('event-text').textContent"),
            "the error is 0 on all views shown");
}

TEST_F(SmallReview, TheScaleOfColoursHasThePagesWord) {
  Open(1000, 800);
  const std::string said = browser_->Evaluate(
      "(() => { const said = [], type = CanvasRenderingContext2D.prototype, draw = type.fillText;"
      "type.fillText = function (...words) { said.push(words[0]); draw.apply(this, words); };"
      "review.page.word = 'distance'; review.state.layers.heat = true;"
      "review.page.draw(performance.now()); type.fillText = draw; return said.join('|'); })()");
  EXPECT_NE(said.find("1 mm|distance|1 m"), std::string::npos) << said;
}

TEST_F(SmallReview, DamageOfTheLogIsShown) {
  Open(1000, 800);
  EXPECT_EQ(browser_->Number("document.getElementById('damage').offsetHeight"), 0);
  std::string bytes = ReadPlainFile(log(), std::size_t{1} << 28);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  folder_.Write("log.lcm", bytes);
  std::remove((folder_ / "page.html").c_str());
  Open(1000, 800, 1);
  EXPECT_GT(browser_->Number("document.getElementById('damage').offsetHeight"), 10);
  const std::string said = browser_->Evaluate("document.getElementById('damage').innerText");
  EXPECT_EQ(said.rfind("Damaged, so figures may be wrong: ", 0), 0u) << said;
  EXPECT_NE(said.find("log"), std::string::npos) << said;
}

}  // namespace review_small_test
}  // namespace seam
