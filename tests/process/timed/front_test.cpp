/// `seam`, the program in front of the others: its verbs, and a session that one command starts and
/// ends.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "client/front/verbs.h"
#include "tests/support/browser/browser.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace front_test {

constexpr double kPatience_s = 60;

std::vector<std::string> Seam(const std::vector<std::string>& more) {
  std::vector<std::string> words{BuiltProgram("seam")};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Returns the processes below a process, as [id, command line].
std::vector<std::pair<int, std::string>> ChildrenOf(int pid) {
  std::vector<std::pair<int, std::string>> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream stat(entry.path() / "stat");
    std::string text((std::istreambuf_iterator<char>(stat)), {});
    const std::size_t end = text.rfind(')');
    if (end == std::string::npos) continue;
    std::istringstream rest(text.substr(end + 1));
    std::string state;
    int parent = 0;
    rest >> state >> parent;
    if (parent != pid || state == "Z") continue;
    std::ifstream line(entry.path() / "cmdline");
    std::string command((std::istreambuf_iterator<char>(line)), {});
    std::replace(command.begin(), command.end(), '\0', ' ');
    children.emplace_back(std::stoi(name), command);
  }
  return children;
}

/// Returns the address of the page that a program has printed; "" if it does not.
std::string PageOf(Program* program) {
  if (!program->WaitForErrors("Ctrl-C ends it", kPatience_s)) return "";
  const std::string text = program->errors();
  const std::size_t at = text.find("http://127.0.0.1:");
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

/// True if all these processes end soon.
bool AllGone(const std::vector<std::pair<int, std::string>>& children) {
  for (int i = 0; i < 500; ++i) {
    if (std::none_of(children.begin(), children.end(),
                     [](const auto& child) { return kill(child.first, 0) == 0; }))
      return true;
    usleep(20000);
  }
  return false;
}

TEST(Front, ListsItsVerbsAndKnowsWhatWasMeant) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{}, {"help"}, {"--help"}}) {
    Program help(Seam(words));
    ASSERT_TRUE(help.Wait(kPatience_s));
    EXPECT_EQ(help.status(), 0) << help.Story();
    for (const char* verb : {"play", "demo", "view", "server", "join", "record", "replay",
                             "measure", "render", "export", "import", "lab", "swarm", "top"})
      EXPECT_NE(help.output().find("\n  " + std::string(verb) + " "), std::string::npos) << verb;
  }
  Program wrong(Seam({"mesure", "a.lcm"}));
  ASSERT_TRUE(wrong.Wait(kPatience_s));
  EXPECT_EQ(wrong.status(), 2);
  EXPECT_NE(wrong.errors().find("did you mean"), std::string::npos) << wrong.errors();
  EXPECT_NE(wrong.errors().find("measure"), std::string::npos) << wrong.errors();
}

TEST(Front, AVerbIsTheOtherProgramItself) {
  for (const auto& [verb, name] : {std::pair<const char*, const char*>{"measure", "seam-measure"},
                                   {"lab", "seam-lab"},
                                   {"join", "seam-client"},
                                   {"server", "seam-server"}}) {
    Program direct({BuiltProgram(name), "--flag-that-is-none"}),
        through(Seam({verb, "--flag-that-is-none"}));
    ASSERT_TRUE(direct.Wait(kPatience_s) && through.Wait(kPatience_s));
    EXPECT_EQ(through.status(), direct.status());
    EXPECT_EQ(through.errors(), direct.errors());
    Program helped(Seam({"help", verb})), help({BuiltProgram(name), "--help"});
    ASSERT_TRUE(helped.Wait(kPatience_s) && help.Wait(kPatience_s));
    EXPECT_EQ(helped.output(), help.output());
  }
}

TEST(Front, MistakesOfPlayAreOneLineAndStartNothing) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"play", "crosing"},
                                             {"play", "crossing", "--name", "anna"},
                                             {"play", "crossing", "--impair", "4gg"},
                                             {"play", "crossing", "--mode", "bufer"}}) {
    Program program(Seam(words));
    ASSERT_TRUE(program.Wait(kPatience_s)) << words[1];
    EXPECT_EQ(program.status(), 2) << program.Story();
    const std::string line = program.errors();
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
    EXPECT_NE(line.find("did you mean"), std::string::npos) << line;
  }
}

TEST(Front, OneDrivesInTheBrowserAndCtrlCEndsEverything) {
  Program play(Seam({"play", "crossing", "--no-browser", "--impair", "perfect"}));
  const std::string page = PageOf(&play);
  ASSERT_NE(page, "") << play.Story();
  const auto children = ChildrenOf(play.pid());
  EXPECT_EQ(children.size(), 4u) << "a server, a view, a bot and the player";
  if (!Browser::Find().empty()) {
    Browser browser(1200, 900);
    ASSERT_TRUE(
        browser.Open(page, "", "window.live && live.driver && review.state.follow !== null"));
    const std::string where =
        "poseOf(review.page.views()[0].tracks.bodies.get(review.state.follow), "
        "review.page.player.last - 2)[0]";
    usleep(300000);
    browser.Hold("d", true);
    const double before = browser.Number(where);
    usleep(1500000);
    browser.Hold("d", false);
    EXPECT_GT(browser.Number(where), before + 3) << "the car was driven";
    EXPECT_EQ(browser.Evaluate("live.driver.sent"), "0 0 0");
    for (const std::string& complaint : browser.complaints()) ADD_FAILURE() << complaint;
  }
  play.Signal(SIGINT);
  ASSERT_TRUE(play.Wait(kPatience_s));
  EXPECT_EQ(play.status(), 0) << play.Story();
  EXPECT_TRUE(AllGone(children));
}

TEST(Front, TheEndOfAProgramEndsTheOthersAndIsSaid) {
  Program demo(Seam({"demo", "crossing", "--no-browser"}));
  ASSERT_NE(PageOf(&demo), "") << demo.Story();
  const auto children = ChildrenOf(demo.pid());
  EXPECT_EQ(children.size(), 4u) << "a server, a view and two bots";
  for (const auto& [pid, command] : children) {
    if (command.find("seam-server") != std::string::npos) kill(pid, SIGKILL);
  }
  ASSERT_TRUE(demo.Wait(kPatience_s));
  EXPECT_EQ(demo.status(), 1) << demo.Story();
  EXPECT_NE(demo.errors().find("\nseam: seam-server was killed by signal 9\n"), std::string::npos)
      << demo.Story();
  EXPECT_TRUE(AllGone(children));
}

/// A scene whose script greets at 0.5 s, and fails at 1 s, on line 15.
const char* const kFails =
    "[[player]]\nname = \"ann\"\nvehicle = \"crate\"\n[[part]]\nname = \"ground\"\n"
    "chain = [[-9, 0], [9, 0]]\n[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [0, 2]\n"
    "[[script]]\nname = \"host\"\ncode = '''\nfunction on_tick(t)\n"
    "if t > 1 then world.say(nil .. 'x') end\n"
    "if t > 0.5 and not room.said then room.said = true; world.say('good evening') end\n"
    "end\n'''\n";

TEST(Front, AStoppedScriptIsSaidAndTheStatusIsOne) {
  const Workspace folder;
  folder.Write("s.toml", kFails);
  const std::string line = "seam-server: script host is stopped: s.toml:15: ";
  for (const char* duration : {"0", "2"}) {
    Program play({BuiltProgram("seam"), "play", "s.toml", "--no-browser", "--duration", duration},
                 folder.path());
    ASSERT_TRUE(play.WaitForErrors(line, kPatience_s)) << play.Story();
    if (duration[0] == '0') play.Signal(SIGINT);
    ASSERT_TRUE(play.Wait(kPatience_s));
    EXPECT_EQ(play.status(), 1) << play.Story();
    const std::string text = play.errors();
    EXPECT_EQ(text.find(line), text.rfind(line)) << "once\n" << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << "page, keys, script\n" << text;
  }
}

TEST(Front, TheLivePageHasTheLinesOfScripts) {
  if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
  const Workspace folder;
  folder.Write("s.toml", kFails);
  Program play({BuiltProgram("seam"), "play", "s.toml", "--no-browser"}, folder.path());
  const std::string page = PageOf(&play);
  ASSERT_NE(page, "") << play.Story();
  Browser browser(1200, 900);
  ASSERT_TRUE(browser.Open(page, "", "window.live && live.page && live.warning"));
  EXPECT_EQ(browser.Evaluate("live.page.runs[0].events.some((e) => e.text === 'good evening')"),
            "true");
  const char* const shown = "document.getElementById('live-state').textContent";
  usleep(200000);
  EXPECT_EQ(browser.Evaluate(shown).rfind("Warning: script host is stopped: s.toml:15", 0), 0u)
      << browser.Evaluate(shown);
  const std::string told = browser.Evaluate("document.getElementById('event-text').textContent");
  EXPECT_NE(told.find("script host is stopped"), std::string::npos) << told;
  for (const std::string& complaint : browser.complaints()) ADD_FAILURE() << complaint;
}

TEST(Front, HasAVerbForEachProgram) {
  std::set<std::string> programs;
  for (const std::string& line : Lines(Root() / "tests/process/interface.txt")) {
    const std::string word = line.substr(0, line.find(' '));
    if (word.rfind("seam-", 0) == 0) programs.insert(word);
  }
  EXPECT_GT(programs.size(), 8u);
  for (const Verb& verb : Verbs()) programs.erase(verb.program);
  for (const std::string& program : programs) ADD_FAILURE() << "no verb runs " << program;
}

}  // namespace front_test
}  // namespace seam
