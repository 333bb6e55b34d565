/// seam-relay between real processes, over UDP on this machine.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "tests/support/program.h"

namespace seam {
namespace relay_process_test {

/// The longest that anything is waited for, s.
constexpr double kPatience = 60;

/// Returns the words of a program between two others.
std::string After(const Program& program, const std::string& mark, const std::string& end) {
  const std::string text = program.errors();
  const std::size_t at = text.find(mark);
  EXPECT_NE(at, std::string::npos) << text;
  const std::size_t from = std::min(text.size(), at + mark.size());
  return text.substr(from, text.find(end, from) - from);
}

/// Returns the complete views of a log by tick, those of a later session in place of an earlier
/// one's.
std::map<std::int64_t, View> ViewsOf(const std::string& path) {
  std::vector<std::int64_t> sessions;  // as they follow each other
  std::map<std::int64_t, RecordingBuilder> builders;
  LogReader log(path);
  for (LogEvent event; log.Next(&event);) {
    const std::int64_t session = SessionOf(event.data).value_or(0);
    if (builders.count(session) == 0) sessions.push_back(session);
    builders[session].Add(event.channel, event.data);
  }
  std::map<std::int64_t, View> views;
  for (const std::int64_t session : sessions) {
    for (auto& [peer, of_peer] : builders[session].recording().views) {
      for (auto& [tick, view] : of_peer) views[tick] = view;
    }
  }
  return views;
}

std::string Scene(const std::string& name) {
  return std::filesystem::absolute("scenes/" + name + ".toml").string();
}

class RelayProcesses : public ::testing::Test {
 protected:
  void StartServer(const std::vector<std::string>& more) {
    std::vector<std::string> words = {BuiltProgram("seam-server"),
                                      "--lcm-url",
                                      "none",
                                      "--bind",
                                      "127.0.0.1:0",
                                      "--wait",
                                      "0",
                                      "--duration",
                                      "0"};
    words.insert(words.end(), more.begin(), more.end());
    server_ = std::make_unique<Program>(words, folder_.path());
    ASSERT_TRUE(server_->WaitForErrors("waiting for", kPatience)) << server_->Story();
    server_address_ = After(*server_, ", on ", "\n");
  }
  void StartRelay(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {BuiltProgram("seam-relay"), server_address_, "--bind",
                                      "127.0.0.1:0"};
    words.insert(words.end(), more.begin(), more.end());
    relay_ = std::make_unique<Program>(words, folder_.path());
    ASSERT_TRUE(relay_->WaitForErrors("its key is", kPatience)) << relay_->Story();
    relay_address_ = After(*relay_, "for watchers on ", "\n");
  }
  std::unique_ptr<Program> Client(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {BuiltProgram("seam-client"), relay_address_, "--lcm-url",
                                      "none"};
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Program>(words, folder_.path());
  }

  /// Waits until it is so.
  template <class Condition>
  static bool WaitFor(const Condition& condition) {
    for (int i = 0; i < kPatience * 20 && !condition(); ++i) usleep(50000);
    return condition();
  }
  /// Returns the last view of a log that is being written; tick -1: it has none so far.
  View LastOf(const std::string& log) const {
    View none;
    none.tick = -1;
    try {
      const auto views = ViewsOf(folder_ / log);
      return views.empty() ? none : views.rbegin()->second;
    } catch (const std::exception&) {
      return none;  // not begun yet
    }
  }
  /// True if a folder of rooms has a snapshot.
  bool HasSnapshot(const std::string& rooms) const {
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(folder_ / rooms, error)) {
      if (file.path().extension() == ".snapshot") return true;
    }
    return false;
  }

  Workspace folder_;
  std::unique_ptr<Program> server_, relay_;
  std::string server_address_, relay_address_;
};

TEST_F(RelayProcesses, AWatcherRecordsWhatTheServerRecords) {
  StartServer({Scene("stack"), "--record", "server.lcm"});
  StartRelay();
  const auto first = Client({"--watch", "--publish", "all", "--record", "first.lcm"});
  const auto second = Client({"--watch", "--publish", "all", "--record", "second.lcm"});
  for (const char* log : {"first.lcm", "second.lcm"}) {
    ASSERT_TRUE(WaitFor([&] { return LastOf(log).tick > 340; })) << "the stack comes to rest";
  }
  for (Program* program : {first.get(), second.get(), relay_.get(), server_.get()}) {
    program->Signal(SIGTERM);
    EXPECT_TRUE(program->Wait(kPatience));
    EXPECT_EQ(program->status(), 0) << program->Story();
  }
  EXPECT_NE(relay_->errors().find("2 watchers at most"), std::string::npos) << relay_->Story();
  const auto real = ViewsOf(folder_ / "server.lcm");
  for (const char* log : {"first.lcm", "second.lcm"}) {
    const auto shown = ViewsOf(folder_ / log);
    ASSERT_GT(shown.size(), 100u) << log;
    const auto& [tick, last] = *shown.rbegin();
    ASSERT_EQ(real.count(tick), 1u);
    const View& there = real.at(tick);
    ASSERT_EQ(last.id, there.id);
    for (std::size_t i = 0; i < last.id.size(); ++i) {
      EXPECT_NEAR(last.x[i], there.x[i], 1.0 / 512) << log << " " << last.id[i];
      EXPECT_NEAR(last.y[i], there.y[i], 1.0 / 512) << log << " " << last.id[i];
    }
  }
}

TEST_F(RelayProcesses, APlayerIsSentToTheServerAndAStrangerToldSo) {
  StartServer({Scene("crossing")});
  StartRelay();
  const auto ann = Client({"--name", "ann", "--drive", "bot", "--duration", "3"});
  const auto zed = Client({"--name", "zed"});
  EXPECT_TRUE(zed->Wait(kPatience));
  EXPECT_EQ(zed->status(), 2);
  EXPECT_NE(zed->errors().find("this relay takes watchers alone, play at " + server_address_),
            std::string::npos)
      << zed->errors();
  EXPECT_TRUE(ann->Wait(kPatience));
  EXPECT_EQ(ann->status(), 0) << ann->Story();
  EXPECT_NE(server_->errors().find("ann is here as peer 1"), std::string::npos) << server_->Story();
}

TEST_F(RelayProcesses, WatchersAreToldWhenTheServerEnds) {
  StartServer({Scene("crossing")});
  StartRelay();
  const auto watcher = Client({"--watch", "--publish", "all", "--record", "watch.lcm"});
  ASSERT_TRUE(WaitFor([&] { return LastOf("watch.lcm").tick >= 0; })) << watcher->Story();
  server_->Signal(SIGTERM);
  for (Program* program : {watcher.get(), relay_.get()}) {
    ASSERT_TRUE(program->Wait(kPatience));
    EXPECT_EQ(program->status(), 0) << program->Story();
    EXPECT_NE(program->errors().find("the server closed the room"), std::string::npos);
  }
}

TEST_F(RelayProcesses, WatchersComeBackToTheSameRoomAfterAKillOfTheServer) {
  StartServer({Scene("crossing"), "--state", "rooms"});
  StartRelay();
  const auto watcher = Client({"--watch", "--publish", "all", "--record", "watch.lcm"});
  ASSERT_TRUE(WaitFor([&] { return HasSnapshot("rooms") && LastOf("watch.lcm").tick >= 0; }))
      << server_->Story() << watcher->Story();
  server_->Signal(SIGKILL);
  ASSERT_TRUE(server_->Wait(kPatience));
  const View before = LastOf("watch.lcm");
  const std::string port = server_address_.substr(server_address_.rfind(':') + 1);
  Program again({BuiltProgram("seam-server"), "--lcm-url", "none", "--bind", "127.0.0.1", "--port",
                 port, "--resume", "rooms", "--duration", "0"},
                folder_.path());
  EXPECT_TRUE(WaitFor([&] {
    const View now = LastOf("watch.lcm");
    return now.session != before.session && now.tick > before.tick + 60;
  })) << relay_->Story()
      << again.Story();
  watcher->Signal(SIGTERM);
  ASSERT_TRUE(watcher->Wait(kPatience));
  EXPECT_EQ(watcher->status(), 0) << watcher->Story();
}

TEST_F(RelayProcesses, SaysWhenItIsInHasLostItsServerAndIsBack) {
  StartServer({Scene("crossing"), "--state", "rooms"});
  const std::string port = server_address_.substr(server_address_.rfind(':') + 1);
  server_->Signal(SIGKILL);
  ASSERT_TRUE(server_->Wait(kPatience));
  StartRelay();
  sleep(1);
  EXPECT_EQ(relay_->errors().find("watches"), std::string::npos) << "nobody answered yet";
  Program first({BuiltProgram("seam-server"), Scene("crossing"), "--lcm-url", "none", "--bind",
                 "127.0.0.1", "--port", port, "--state", "later", "--wait", "0", "--duration", "0"},
                folder_.path());
  const std::string in = "watches main at " + server_address_ + " as guest\n";
  ASSERT_TRUE(relay_->WaitForErrors(in, kPatience)) << relay_->Story() << first.Story();
  ASSERT_TRUE(WaitFor([&] { return HasSnapshot("later"); })) << first.Story();
  first.Signal(SIGKILL);
  ASSERT_TRUE(first.Wait(kPatience));
  ASSERT_TRUE(relay_->WaitForErrors("has lost " + server_address_, kPatience)) << relay_->Story();
  Program again({BuiltProgram("seam-server"), "--lcm-url", "none", "--bind", "127.0.0.1", "--port",
                 port, "--resume", "later", "--duration", "0"},
                folder_.path());
  const std::string back = "watches again: main at " + server_address_;
  EXPECT_TRUE(relay_->WaitForErrors(back, kPatience)) << relay_->Story() << again.Story();
}

TEST_F(RelayProcesses, APlayersNameIsRefusedToARelayAndToAWatcher) {
  StartServer({Scene("crossing")});
  Program relay(
      {BuiltProgram("seam-relay"), server_address_, "--bind", "127.0.0.1:0", "--name", "ann"},
      folder_.path());
  relay_address_ = server_address_;
  const auto watcher = Client({"--watch", "--name", "bob"});
  for (Program* program : {&relay, watcher.get()}) {
    ASSERT_TRUE(program->Wait(kPatience));
    EXPECT_EQ(program->status(), 2) << program->Story();
    EXPECT_NE(program->errors().find("is a player of this room: to look on"), std::string::npos)
        << program->Story();
  }
  const auto ann = Client({"--name", "ann", "--drive", "bot", "--duration", "3"});
  EXPECT_TRUE(ann->Wait(kPatience));
  EXPECT_EQ(ann->status(), 0) << ann->Story();
}

TEST_F(RelayProcesses, ATokenOpensARelayThatDemandsOne) {
  StartServer({Scene("crossing")});
  const auto token = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {BuiltProgram("seam-token"), "--key", "op.key"};
    words.insert(words.end(), more.begin(), more.end());
    Program program(words, folder_.path());
    EXPECT_TRUE(program.Wait(kPatience));
    EXPECT_EQ(program.status(), 0) << program.Story();
    return program.output();
  };
  (void)token({"--make-key"});
  folder_.Write("wanda.token", token({"--name", "wanda", "--watch"}));
  StartRelay({"--token-key", "op.key"});
  const auto stranger = Client({"--watch"});
  EXPECT_TRUE(stranger->Wait(kPatience));
  EXPECT_NE(stranger->errors().find("a token is needed here"), std::string::npos);
  const auto wanda = Client({"--watch", "--token", "wanda.token", "--duration", "3"});
  EXPECT_TRUE(wanda->Wait(kPatience));
  EXPECT_EQ(wanda->status(), 0) << wanda->Story();
}

TEST(RelayProgram, SaysWhatIsWrongInOneLine) {
  const Workspace folder;
  folder.Write("empty", "");
  struct Wrong {
    std::vector<std::string> words;
    std::string says;
  };
  const std::vector<Wrong> all = {
      {{}, "which server? for example: seam-relay 127.0.0.1:7777"},
      {{"127.0.0.1:0"}, "no server has port 0"},
      {{"127.0.0.1:1", "--watchers", "0"}, "--watchers"},
      {{"127.0.0.1:1", "--budget", "lots"}, "--budget takes bytes a second"},
      {{"127.0.0.1:1", "--play-at", "127.0.0.1:0"}, "--play-at 127.0.0.1:0: no server has port 0"},
      {{"127.0.0.1:1", "--name", "a b"}, "--name takes 1 to 32 letters"},
      {{"127.0.0.1:1", "--room", "a/b"}, "--room takes 1 to 32 letters"},
      {{"127.0.0.1:1", "--token", "none"}, "--token none: No such file"},
      {{"127.0.0.1:1", "--token", "empty", "--name", "w"}, "not with --name or --room"},
      {{"127.0.0.1:1", "--server-key", "12"}, "--server-key takes the 64 digits"},
      {{"127.0.0.1:1", "--token-key", "none"}, "--token-key"},
      {{"127.0.0.1:1", "--join-timeout", "0.3", "--bind", "127.0.0.1:0"},
       "no answer from 127.0.0.1:1; gave up after 0.3 s"},
  };
  for (const Wrong& wrong : all) {
    std::vector<std::string> words = {BuiltProgram("seam-relay")};
    words.insert(words.end(), wrong.words.begin(), wrong.words.end());
    Program program(words, folder.path());
    EXPECT_TRUE(program.Wait(kPatience));
    EXPECT_EQ(program.status(), 2) << program.Story();
    EXPECT_EQ(program.output(), "");
    EXPECT_NE(program.errors().find(wrong.says), std::string::npos) << program.errors();
  }
}

}  // namespace relay_process_test
}  // namespace seam
