/// `seam edit`: a saved scene is checked at once, Lua included, and played anew if asked.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/base/process.h"
#include "tests/support/browser/browser.h"
#include "tests/support/program.h"

namespace seam {
namespace edit_test {

constexpr double kPatience_s = 60;
const char* const kGood =
    "[[player]]\nname = \"ann\"\nvehicle = \"crate\"\n[[part]]\nname = \"ground\"\nchain = [[-9, "
    "0], [9, 0]]\n"
    "[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [0, 2]\n";

/// A scene that is edited.
class Edit : public ::testing::Test {
 protected:
  void Start(const std::vector<std::string>& more = {}) {
    folder_.Write("s.toml", kGood);
    std::vector<std::string> words{BuiltProgram("seam"), "edit", "s.toml"};
    words.insert(words.end(), more.begin(), more.end());
    program_ = std::make_unique<Program>(words, folder_.path());
  }
  /// Waits until the program has said `mark` so many times.
  bool Says(const std::string& mark, int times) {
    for (int i = 0; i < 3000; ++i) {
      const std::string text = program_->errors();
      int found = 0;
      for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; ++at) ++found;
      if (found >= times) return true;
      if (program_->Wait(0.02)) return false;
    }
    return false;
  }
  void Stop() {
    program_->Signal(SIGINT);
    ASSERT_TRUE(program_->Wait(kPatience_s));
    EXPECT_EQ(program_->status(), 0) << program_->Story();
  }
  /// Returns the time in the last "checked in N ms"; -1 without one.
  int LastTime() const {
    const std::string text = program_->errors();
    const std::size_t at = text.rfind("checked in ");
    return at == std::string::npos ? -1 : std::atoi(text.c_str() + at + 11);
  }

  /// Returns the addresses of the pages that the program has said.
  std::vector<std::string> Pages() const {
    const std::string text = program_->errors();
    std::vector<std::string> pages;
    for (std::size_t at = 0; (at = text.find("http://127.0.0.1:", at)) != std::string::npos; ++at) {
      pages.push_back(text.substr(at, text.find('\n', at) - at));
    }
    return pages;
  }

  const Workspace folder_;
  std::unique_ptr<Program> program_;
};

TEST_F(Edit, EachSaveIsCheckedAtOnceAndItsMistakeNamed) {
  Start();
  ASSERT_TRUE(Says("seam: ok, checked in", 1)) << program_->Story();
  folder_.Write("s.toml", std::string(kGood) + "density = 8,0\n");
  ASSERT_TRUE(Says("it does not load", 1)) << program_->Story();
  EXPECT_NE(program_->errors().find("s.toml:11: density = 8,0: a decimal point, not a comma: 8.0"),
            std::string::npos)
      << program_->Story();
  folder_.Write("s.toml", std::string(kGood) +
                              "[[script]]\nname = \"rules\"\ncode = \"function on_tick( end\"\n");
  ASSERT_TRUE(Says("checked in", 3)) << program_->Story();
  const std::string lua = program_->output() + program_->errors();
  EXPECT_NE(lua.find("s.toml:13: "), std::string::npos) << "Lua's mistake\n" << lua;
  // An editor that writes another file and renames it.
  folder_.Write("s.toml~", kGood);
  std::filesystem::rename(folder_ / "s.toml~", folder_ / "s.toml");
  ASSERT_TRUE(Says("seam: ok, checked in", 2)) << program_->Story();
  // ms; on a processor that is not busy it takes about 20, half of which is the program's start.
  const std::int64_t begin_us = SteadyClockUs();
  Program start({BuiltProgram("seam-lab"), "--help"});
  ASSERT_TRUE(start.Wait(kPatience_s));
  const double start_ms = static_cast<double>(SteadyClockUs() - begin_us) * 1e-3;
  for (int times = 3; LastTime() > 100 && times < 9; ++times) {
    folder_.Write("s.toml",
                  std::string(kGood) + std::string(static_cast<std::size_t>(times), '\n'));
    ASSERT_TRUE(Says("seam: ok, checked in", times)) << program_->Story();
  }
  EXPECT_LE(LastTime(), 100 + 5 * start_ms);
  folder_.Write("other.toml", "nonsense");
  usleep(400000);
  EXPECT_FALSE(program_->Wait(0));
  EXPECT_EQ(program_->errors().find("other.toml"), std::string::npos);
  Stop();
}

TEST_F(Edit, WithPlayTheRoomBeginsAnewAfterASaveThatLoads) {
  Start({"--play", "--impair", "perfect"});
  ASSERT_TRUE(Says("Ctrl-C ends it", 1)) << program_->Story();
  folder_.Write("s.toml", "nonsense");
  ASSERT_TRUE(Says("it does not load", 1)) << program_->Story();
  folder_.Write("s.toml", kGood);
  ASSERT_TRUE(Says("Ctrl-C ends it", 2)) << program_->Story();
  // The page that is open goes on: port and token are those of before.
  const std::vector<std::string> pages = Pages();
  ASSERT_EQ(pages.size(), 2u) << program_->Story();
  EXPECT_NE(pages[0].find("?token="), std::string::npos);
  EXPECT_EQ(pages[0], pages[1]);
  Stop();
}

TEST_F(Edit, TheOpenPageShowsAndDrivesTheRoomOfTheNextSave) {
  if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
  Start({"--play", "--impair", "perfect"});
  ASSERT_TRUE(Says("Ctrl-C ends it", 1)) << program_->Story();
  Browser browser(900, 700);
  const std::string body = "live.page.runs[0].names.size";
  ASSERT_TRUE(browser.Open(Pages().at(0), "", "window.live && live.driver && " + body + " > 0"));
  const double before = browser.Number(body);
  folder_.Write("s.toml", std::string(kGood) +
                              "[[part]]\nname = \"more\"\nbox = [1, 1]\nposition = [3, 2]\n");
  ASSERT_TRUE(Says("Ctrl-C ends it", 2)) << program_->Story();
  for (int i = 0; i < 100 && browser.Number(body) <= before; ++i) usleep(100000);
  EXPECT_EQ(browser.Number(body), before + 1) << "the page has the new scene";
  const std::string drives = browser.Evaluate(
      "(async () => (await fetch('drive' + location.search, {method: 'POST', "
      "body: '1000000 0 0 0'})).status)()");
  EXPECT_EQ(drives, "204");
  Stop();
}

TEST_F(Edit, AStoppedScriptOfThePlayedRoomIsSaidAndTheStatusIsOne) {
  Start({"--play", "--impair", "perfect"});
  ASSERT_TRUE(Says("Ctrl-C ends it", 1)) << program_->Story();
  // The look of `seam-lab check` takes one second of the session.
  folder_.Write("s.toml", std::string(kGood) +
                              "[[script]]\nname = \"host\"\ncode = '''\nfunction on_tick(t)\n"
                              "if t > 2 then world.say(nil .. 'x') end\nend\n'''\n");
  ASSERT_TRUE(Says("seam-server: script host is stopped: s.toml:15: ", 1)) << program_->Story();
  program_->Signal(SIGINT);
  ASSERT_TRUE(program_->Wait(kPatience_s));
  EXPECT_EQ(program_->status(), 1) << program_->Story();
}

TEST_F(Edit, ASceneThatIsNotThereIsOneLine) {
  Program program({BuiltProgram("seam"), "edit", "nothing-of-that-name"}, folder_.path());
  ASSERT_TRUE(program.Wait(kPatience_s));
  EXPECT_EQ(program.status(), 2);
  EXPECT_NE(program.errors().find("no scene \"nothing-of-that-name\""), std::string::npos)
      << program.Story();
}

}  // namespace edit_test
}  // namespace seam
