/// An operator changes a running session of real processes, through the door and through the page.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "common/net/http_page.h"
#include "common/record/events/event_text.h"
#include "common/record/recording.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"

namespace seam {
namespace control_test {

constexpr double kWithin_s = 60;
constexpr std::int64_t kAnswerUs = 5000000;

/// Returns the text between a mark and the line's end.
std::string After(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + mark.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// A server with a door, and a player.
class ControlledSession : public ::testing::Test {
 protected:
  void SetUp() override {
    server_ = std::make_unique<Program>(std::vector<std::string>{
        BuiltProgram("seam-server"), "crossing", "--bind", "127.0.0.1:0", "--lcm-url", "none",
        "--duration", "0", "--wait", "1", "--record", folder_ / "server.lcm", "--control", "0"});
    ASSERT_TRUE(server_->WaitForErrors("Ctrl-C", kWithin_s)) << server_->Story();
    ASSERT_TRUE(server_->WaitForErrors("?token=", kWithin_s)) << server_->Story();
    const std::string door = After(server_->errors(), "control at http://");
    address_ = door.substr(0, door.find('/'));
    target_ = door.substr(address_.size());
    client_ = std::make_unique<Program>(std::vector<std::string>{
        BuiltProgram("seam-client"), "127.0.0.1:" + After(server_->errors(), "on 127.0.0.1:"),
        "--name", "ann", "--drive", "bot", "--lcm-url", "none"});
  }
  /// Ends the session, and returns what a program has recorded.
  Recording End(const std::string& log) {
    for (Program* program : {client_.get(), server_.get()}) {
      program->Signal(SIGINT);
      EXPECT_TRUE(program->Wait(kWithin_s)) << program->Story();
      EXPECT_EQ(program->status(), 0) << program->Story();
    }
    return ReadRecording(folder_ / log);
  }
  HttpAnswer Command(const std::string& command) {
    HttpAnswer answer;
    const Status asked = AskPage(address_, "POST", target_, command, kAnswerUs, &answer);
    EXPECT_TRUE(asked.ok()) << asked.why();
    return answer;
  }

  const Workspace folder_;
  std::unique_ptr<Program> server_, client_;
  std::string address_, target_;
};

TEST_F(ControlledSession, ChangesTheNetworkAndTheClientMeasuresIt) {
  ASSERT_TRUE(server_->WaitForErrors("the room starts", kWithin_s)) << server_->Story();
  sleep(4);
  const HttpAnswer done = Command("impair delay=60ms");
  EXPECT_EQ(done.status, 200);
  EXPECT_NE(done.body.find("\"impair\":\"delay=60ms\""), std::string::npos) << done.body;
  sleep(14);
  const Recording log = End("server.lcm");
  const std::vector<Stats>& stats = log.stats.at(0);  // the round trip to ann
  ASSERT_GE(stats.size(), 10u);
  // A machine that is busy for a moment adds to one of them.
  const auto least_us = [](auto from, auto to) {
    return std::min_element(from, to,
                            [](const Stats& a, const Stats& b) { return a.rtt_us < b.rtt_us; })
        ->rtt_us;
  };
  EXPECT_LT(least_us(stats.begin(), stats.begin() + 4), 40000);
  EXPECT_GE(least_us(stats.end() - 4, stats.end()), 120000);
  EXPECT_LT(least_us(stats.end() - 4, stats.end()), 180000);
  int said = 0;
  for (const Event& event : log.events) said += event.text == "network is now delay=60ms" ? 1 : 0;
  EXPECT_EQ(said, 1);
}

TEST_F(ControlledSession, RefusesStrangersAndMistakesAndTheLogIsDoneAgain) {
  ASSERT_TRUE(server_->WaitForErrors("the room starts", kWithin_s)) << server_->Story();
  HttpAnswer answer;
  ASSERT_TRUE(
      AskPage(address_, "POST", "/control?token=guess", "impair 4g", kAnswerUs, &answer).ok());
  EXPECT_EQ(answer.status, 403);
  ASSERT_TRUE(AskPage(address_, "POST", "/control", "impair 4g", kAnswerUs, &answer).ok());
  EXPECT_EQ(answer.status, 403);
  const HttpAnswer wrong = Command("impair 4gg");
  EXPECT_EQ(wrong.status, 400);
  EXPECT_NE(wrong.body.find("did you mean"), std::string::npos) << wrong.body;
  EXPECT_EQ(Command("input_delay 4").status, 200);
  EXPECT_EQ(Command("show_age 9").status, 200);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(Command("drag brick 0 0 20 9").status, 200);
    usleep(250000);
  }
  EXPECT_EQ(Command("release brick").status, 200);
  sleep(1);
  const Recording log = End("server.lcm");
  EXPECT_GT(log.edits.size(), 10u);
  EXPECT_FALSE(log.meta.empty());
  Program replay({LabProgram(), "replay", folder_ / "server.lcm"});
  ASSERT_TRUE(replay.Wait(kWithin_s));
  EXPECT_EQ(replay.status(), 0) << replay.Story();
  EXPECT_NE(replay.output().find("each with the recorded hash"), std::string::npos);
}

TEST(ControlMistakes, AreOneLineEach) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"seam-server", "crossing", "--rooms", "2", "--control", "0"},
           {"seam-server", "crossing", "--control", "99999"},
           {"seam-view", "--control", "9465"},
           {"seam-view", "--control", "http://127.0.0.1:9465"},
           {"seam-view", "--control", "http://example.org:9465/control?token=1"},
           {"seam-view", "--control", "http://127.0.0.1:9465/control?token=1 2"}}) {
    std::vector<std::string> argv = words;
    argv[0] = BuiltProgram(words[0]);
    Program program(argv);
    ASSERT_TRUE(program.Wait(kWithin_s));
    EXPECT_EQ(program.status(), 2) << program.Story();
    const std::string line = program.errors();
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  }
}

}  // namespace control_test
}  // namespace seam
