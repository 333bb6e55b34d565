/// seam-view: a session that runs is watched in a browser, by several at once, with a way back.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tests/support/browser/browser.h"
#include "tests/support/program.h"

namespace seam {
namespace live_page_test {

constexpr double kWithin_s = 60;
constexpr const char* kReady = "window.review && review.page.tape && review.page.rects";

/// Returns the address that a program has printed.
std::string AddressOf(const Program& program) {
  const std::string text = program.errors();
  const std::size_t at = text.find("http://127.0.0.1:");
  return at == std::string::npos ? "" : text.substr(at, text.find_first_of("; \n", at) - at);
}

/// A room with logs that are being written, and a view of them.
class LivePage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
  }
  void Start(const std::string& scene, const std::vector<std::string>& names) {
    std::vector<std::string> view{BuiltProgram("seam-view"), "--port", "0", folder_ / "server.lcm"};
    Run({BuiltProgram("seam-server"), scene, "--bind", "127.0.0.1:0", "--lcm-url", "none",
         "--duration", "0", "--record", folder_ / "server.lcm", "--impair", "4g"});
    ASSERT_TRUE(programs_[0]->WaitForErrors("waiting for", kWithin_s)) << programs_[0]->Story();
    const std::string text = programs_[0]->errors(), mark = "on 127.0.0.1:";
    const std::size_t at = text.find(mark) + mark.size();
    const std::string address = "127.0.0.1:" + text.substr(at, text.find('\n', at) - at);
    for (const std::string& name : names) {
      const std::string log = folder_ / (name + ".lcm");
      Run({BuiltProgram("seam-client"), address, "--name", name, "--drive", "bot", "--lcm-url",
           "none", "--record", log});
      view.push_back(log);
    }
    Run(view);
    ASSERT_TRUE(programs_.back()->WaitForErrors("http://", kWithin_s)) << programs_.back()->Story();
    address_ = AddressOf(*programs_.back());
  }
  void Run(const std::vector<std::string>& words) {
    programs_.push_back(std::make_unique<Program>(words));
  }

  const Workspace folder_;
  std::vector<std::unique_ptr<Program>> programs_;
  std::string address_;
};

TEST_F(LivePage, FollowsPausesGoesBackAndFollowsAgain) {
  Start("crossing", {"ann", "bob"});
  Browser browser(1400, 1000);
  ASSERT_TRUE(browser.Open(address_, "", kReady));
  for (int i = 0; i < 400 && browser.Number("review.page.runs[0].views.length") < 3; ++i)
    usleep(50000);
  EXPECT_EQ(browser.Number("review.state.panels.length"),
            browser.Number("review.page.rects.length"));
  EXPECT_EQ(browser.Evaluate("review.page.runs[0].views.map((v) => v.name).join()"),
            "server,ann (peer 1),bob (peer 2)");
  for (int i = 0; i < 400 && browser.Number("review.state.tick") < 150; ++i) usleep(50000);
  // It follows: the tick goes on by itself, close behind the newest.
  const double before = browser.Number("review.state.tick");
  usleep(700000);
  EXPECT_GT(browser.Number("review.state.tick"), before + 10);
  EXPECT_LT(browser.Number("review.page.player.last - review.state.tick"), 60);
  EXPECT_EQ(browser.Evaluate("review.state.live"), "true");
  // Every body of the scene is there in nearly all ticks of half a second, in each view; the newest
  // may still be on their way.
  EXPECT_GT(
      browser.Number("Math.min(...review.page.runs[0].views.map((v) => Math.min(...[...v."
                     "tracks.bodies.values()].map((t) => t.has.slice(Math.floor(review.state."
                     "tick) - 60, Math.floor(review.state.tick) - 30).reduce((n, x) => n + x, "
                     "0)))))"),
      25);
  // A pause holds the picture while ticks come.
  browser.Click("#play");
  const double held = browser.Number("review.state.tick");
  const double last = browser.Number("review.page.player.last");
  usleep(500000);
  EXPECT_EQ(browser.Number("review.state.tick"), held);
  EXPECT_GT(browser.Number("review.page.player.last"), last);
  // Back by the slider, by keys, and to the present again.
  browser.Evaluate("window.before = document.getElementById('world').toDataURL()");
  browser.Click("#scrub");
  EXPECT_LT(browser.Number("review.state.tick"), held);
  EXPECT_EQ(browser.Evaluate("window.before === document.getElementById('world').toDataURL()"),
            "false");
  const double middle = browser.Number("review.state.tick");
  browser.Press("ArrowLeft");
  EXPECT_EQ(browser.Number("review.state.tick"), middle - 1);
  browser.Press("l");
  usleep(500000);
  EXPECT_LT(browser.Number("review.page.player.last - review.state.tick"), 60);
  // A second watcher comes late, and has the scene, the present and some of the past.
  Browser second(800, 600);
  ASSERT_TRUE(second.Open(address_, "", kReady));
  EXPECT_EQ(second.Number("review.page.runs[0].views.length"), 3);
  EXPECT_GT(second.Number("review.page.player.last"), 100);
  EXPECT_EQ(second.Evaluate("document.getElementById('title').textContent"),
            browser.Evaluate("document.getElementById('title').textContent"));
  // The end of the session is said, and what came stays.
  programs_[0]->Signal(SIGINT);
  ASSERT_TRUE(programs_[0]->Wait(kWithin_s));
  for (int i = 0;
       i < 100 && browser.Evaluate("document.getElementById('live-state').hidden") == "true"; ++i)
    usleep(50000);
  EXPECT_NE(browser.Evaluate("document.getElementById('live-state').textContent")
                .find("Nothing has come"),
            std::string::npos);
  for (Browser* one : {&browser, &second})
    for (const std::string& complaint : one->complaints()) ADD_FAILURE() << complaint;
}

TEST(LivePageMistakes, AreOneLineEach) {
  const Workspace folder;
  folder.Write("text.lcm", "this is no log at all, but a text\n");
  Program other({BuiltProgram("seam-view"), "--port", "0", folder / "text.lcm"});
  ASSERT_TRUE(other.Wait(kWithin_s));
  EXPECT_EQ(other.status(), 2);
  EXPECT_EQ(other.errors(),
            "seam-view: " + folder / "text.lcm" + ": not an LCM log: no event in it\n");
  const Workspace empty;
  Program place({BuiltProgram("seam-view"), empty.path()});
  ASSERT_TRUE(place.Wait(kWithin_s));
  EXPECT_EQ(place.status(), 2);
  EXPECT_EQ(place.errors(), "seam-view: " + empty.path() + ": no log in this folder\n");
  Program both({BuiltProgram("seam-view"), "a.lcm", "--lcm-url", "none"});
  ASSERT_TRUE(both.Wait(kWithin_s));
  EXPECT_EQ(both.status(), 2);
}

}  // namespace live_page_test
}  // namespace seam
