/// A running session is changed in the browser: its network and settings, and a body that is
/// dragged.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tests/support/browser/browser.h"
#include "tests/support/program.h"

namespace seam {
namespace live_control_test {

constexpr double kWithin_s = 60;
constexpr const char* kReady =
    "window.live && live.controls && live.controls.values && review.page.rects";

/// Waits at most 30 s until an expression is true.
bool Becomes(Browser* browser, const std::string& expression) {
  for (int i = 0; i < 600; ++i) {
    if (browser->Evaluate(expression) == "true") return true;
    usleep(50000);
  }
  return false;
}

/// Types into a field and leaves it.
void Set(Browser* browser, const std::string& field, const std::string& value) {
  browser->Evaluate("(() => {const input = live.controls.fields." + field +
                    ".input; input.focus(); input.value = '" + value +
                    "'; input.dispatchEvent(new Event('change')); input.blur();})()");
}

class LiveControl : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
    play_ = std::make_unique<Program>(std::vector<std::string>{
        BuiltProgram("seam"), "play", "crossing", "--no-browser", "--impair", "perfect"});
    ASSERT_TRUE(play_->WaitForErrors("Ctrl-C ends it", kWithin_s)) << play_->Story();
    const std::string text = play_->errors();
    const std::size_t at = text.find("http://127.0.0.1:");
    address_ = text.substr(at, text.find('\n', at) - at);
  }
  void TearDown() override {
    if (play_ == nullptr) return;
    play_->Signal(SIGINT);
    EXPECT_TRUE(play_->Wait(kWithin_s)) << play_->Story();
    EXPECT_EQ(play_->status(), 0) << play_->Story();
  }

  std::unique_ptr<Program> play_;
  std::string address_;
};

TEST_F(LiveControl, ChangesTheNetworkAndTheSettingsAndSaysThemToThoseWhoOnlyWatch) {
  Browser browser(1200, 900);
  ASSERT_TRUE(browser.Open(address_, "", kReady));
  EXPECT_EQ(browser.Evaluate("live.controls.values.impair"), "perfect");
  Set(&browser, "impair", "delay=60ms");
  Set(&browser, "input_delay", "4");
  Set(&browser, "show_age", "3");
  EXPECT_TRUE(Becomes(&browser, "live.controls.values.impair === 'delay=60ms'"));
  EXPECT_TRUE(Becomes(&browser, "live.controls.values.input_delay.ticks === 4"));
  EXPECT_TRUE(Becomes(&browser, "live.controls.values.show_age.ticks === 3"));
  EXPECT_EQ(browser.Evaluate("live.controls.fields.input_delay.now.textContent"),
            "now 4 ticks (67 ms)");
  // The change is an event of the room, and the clients measure it.
  EXPECT_TRUE(
      Becomes(&browser, "review.page.runs[0].events.some((e) => e.text.includes('delay=60ms'))"));
  EXPECT_TRUE(Becomes(&browser,
                      "review.page.runs[0].views.some((v) => v.stats.some((s) => s[1] > 110000))"));
  Set(&browser, "impair", "4gg");
  EXPECT_TRUE(Becomes(&browser, "live.controls.text.textContent.includes('did you mean')"));
  EXPECT_EQ(browser.Evaluate("live.controls.fields.impair.input.value"), "delay=60ms");
  // Keys that are typed into a field neither drive nor command the page.
  browser.Evaluate("live.controls.fields.impair.input.focus()");
  browser.Press("d");
  browser.Press("l");
  EXPECT_EQ(browser.Evaluate("live.driver.held.size"), "0");
  // A watcher on a phone, without the token.
  Browser watcher(390, 800);
  ASSERT_TRUE(watcher.Open(address_.substr(0, address_.find('?')), "", kReady));
  EXPECT_EQ(watcher.Number("document.querySelectorAll('.control input, .control button').length"),
            0);
  EXPECT_NE(watcher.Evaluate("live.controls.text.textContent").find("Network delay=60ms"),
            std::string::npos);
  EXPECT_EQ(watcher.Evaluate("Boolean(review.page.hand)"), "false");
  EXPECT_LE(watcher.Number("document.scrollingElement.scrollWidth"), 390);
  Browser phone(390, 800);
  ASSERT_TRUE(phone.Open(address_, "", kReady));
  EXPECT_LE(phone.Number("document.scrollingElement.scrollWidth"), 390);
  EXPECT_EQ(phone.Number("document.querySelectorAll('.control input').length"), 3);
  for (Browser* one : {&browser, &watcher, &phone})
    for (const std::string& complaint : one->complaints()) {
      if (complaint.find("400") == std::string::npos) ADD_FAILURE() << complaint;
    }
}

TEST_F(LiveControl, DragsABodyInEveryView) {
  Browser browser(1200, 900);
  ASSERT_TRUE(browser.Open(address_, "", kReady));
  ASSERT_TRUE(Becomes(&browser, "Boolean(review.page.hand)"));
  ASSERT_TRUE(Becomes(&browser, "review.state.follow !== null"));
  browser.Evaluate(
      "window.brick = [...review.page.runs[0].names].find((n) => n[1] === 'brick')[0]");
  browser.Evaluate(
      "review.state.follow = null, review.state.camera = {x: 6, y: 6, height: 20}, "
      "review.page.changed()");
  browser.Settle();
  // The brick's place on the first panel, as a share of the canvas.
  browser.Evaluate(
      "window.spot = () => {const r = review.page.rects[0], v = new Viewport(r, "
      "review.page.camera), p = poseOf(review.page.views()[0].tracks.bodies.get(brick), "
      "review.state.tick), c = document.getElementById('world'); return [v.x(p[0]) / "
      "c.clientWidth, v.y(p[1]) / c.clientHeight]}");
  const std::string heights =
      "Math.min(...review.page.runs[0].views.map((v) => poseOf(v.tracks.bodies.get(brick), "
      "Math.floor(review.state.tick) - 2)[1]))";
  EXPECT_LT(browser.Number(heights), 2);
  const double x = browser.Number("spot()[0]"), y = browser.Number("spot()[1]");
  browser.Point("mousePressed", "#world", x, y);
  EXPECT_EQ(browser.Evaluate("review.page.hand.held && review.page.hand.held.body.name"), "brick");
  for (int i = 1; i <= 10; ++i) browser.Point("mouseMoved", "#world", x, y - 0.04 * i);
  EXPECT_TRUE(Becomes(&browser, heights + " > 5")) << browser.Number(heights);
  EXPECT_EQ(browser.Evaluate("live.controls.text.textContent"), "Dragging brick.");
  browser.Point("mouseReleased", "#world", x, y - 0.4);
  EXPECT_EQ(browser.Evaluate("review.page.hand.held"), "null");
  EXPECT_TRUE(Becomes(&browser, heights + " < 2")) << "it falls again";
  EXPECT_TRUE(Becomes(&browser, "live.controls.values.dragged.length === 0"));
  EXPECT_TRUE(
      Becomes(&browser, "review.page.runs[0].events.some((e) => e.text === 'brick is let go')"));
  for (const std::string& complaint : browser.complaints()) ADD_FAILURE() << complaint;
}

}  // namespace live_control_test
}  // namespace seam
