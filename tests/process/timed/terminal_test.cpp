/// The messages of server and client to their operator, with real processes.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "common/record/recording.h"
#include "tests/support/program.h"

namespace seam {
namespace terminal_test {

/// The longest that anything is waited for, s.
constexpr double kPatience = 60;

/// A server of two players on a port of its own choice.
class Terminals : public ::testing::Test {
 protected:
  void Start(const std::vector<std::string>& more, const std::string& wait = "1") {
    std::vector<std::string> words = {BuiltProgram("seam-server"),
                                      "crossing",
                                      "--bind",
                                      "127.0.0.1:0",
                                      "--lcm-url",
                                      "none",
                                      "--wait",
                                      wait};
    words.insert(words.end(), more.begin(), more.end());
    server_ = std::make_unique<Program>(words);
    ASSERT_TRUE(server_->WaitForErrors("waiting for", kPatience)) << server_->Story();
    const std::string text = server_->errors(), mark = "on 127.0.0.1:";
    const std::size_t at = text.find(mark);
    ASSERT_NE(at, std::string::npos) << text;
    address_ = "127.0.0.1:" + text.substr(at + mark.size(), text.find('\n', at) - at - mark.size());
  }
  std::vector<std::string> ClientWords(const std::string& name) const {
    return {BuiltProgram("seam-client"), address_, "--name", name, "--lcm-url", "none"};
  }
  /// Returns the message of a refused client; it must end with status 2.
  std::string Refused(const std::string& name) const {
    Program client(ClientWords(name));
    EXPECT_TRUE(client.Wait(kPatience));
    EXPECT_EQ(client.status(), 2) << client.Story();
    return client.errors();
  }
  /// Waits until a program's output has `text`.
  static bool Shows(const Program& program, const std::string& text) {
    for (int i = 0; i < kPatience * 20; ++i, usleep(50000)) {
      if (program.output().find(text) != std::string::npos) return true;
    }
    return false;
  }
  std::unique_ptr<Program> server_;
  std::string address_;
};

TEST_F(Terminals, ATakenOrUnknownNameListsFreeNamesInOneLineWithStatus2) {
  Start({});
  Program ann(ClientWords("ann"));
  ASSERT_TRUE(server_->WaitForErrors("ann is here", kPatience)) << server_->Story();
  EXPECT_EQ(Refused("ann"),
            "seam-client: the server refuses: the name ann is in use; free are bob\n");
  EXPECT_EQ(Refused("bbo"),
            "seam-client: there is no player \"bbo\" here (did you mean bob?); free are bob; "
            "--watch only looks on\n");
  Program bob(ClientWords("bob"));
  ASSERT_TRUE(server_->WaitForErrors("bob is here", kPatience)) << server_->Story();
  EXPECT_EQ(Refused("guest"),
            "seam-client: there is no player \"guest\" here; no player is free; --watch only looks "
            "on\n");
}

TEST_F(Terminals, TheServerReportsJoinsAndLeavesAndEndsWithATable) {
  Start({});
  Program ann(ClientWords("ann"));
  ASSERT_TRUE(server_->WaitForErrors("ann is here as peer 1, 127.0.0.1:", kPatience));
  EXPECT_NE(server_->errors().find("; 1 of 2 players, missing: bob\n"), std::string::npos);
  ASSERT_TRUE(server_->WaitForErrors("the room starts", kPatience));
  sleep(2);
  ann.Signal(SIGINT);
  ASSERT_TRUE(
      server_->WaitForErrors("ann is gone: left; 0 of 2 players, missing: ann, bob\n", kPatience))
      << server_->Story();
  server_->Signal(SIGINT);
  ASSERT_TRUE(server_->Wait(kPatience));
  EXPECT_EQ(server_->status(), 0) << server_->Story();
  const std::string all = server_->errors();
  EXPECT_NE(all.find("\n  client           peer joins "), std::string::npos) << all;
  EXPECT_NE(all.find("\n  ann                 1     1 "), std::string::npos) << all;
  EXPECT_EQ(all.find('\r'), std::string::npos) << "progress is for terminals";
  for (std::size_t at = 0; at < all.size(); at = all.find('\n', at) + 1) {
    EXPECT_LT(all.find('\n', at) - at, 100u) << all.substr(at);
  }
}

TEST_F(Terminals, QuietOmitsJoinsAndLeaves) {
  Start({"--quiet", "--duration", "0.5"});
  Program ann(ClientWords("ann"));
  ASSERT_TRUE(server_->Wait(kPatience));
  EXPECT_EQ(server_->errors().find("ann is here"), std::string::npos) << server_->errors();
  EXPECT_NE(server_->errors().find("\n  ann "), std::string::npos) << "the table is the result";
}

TEST_F(Terminals, DrivingByKeyboardShowsTheWorldAndItsKeys) {
  Start({});
  PseudoTerminal terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminals here";
  const Workspace folder;
  std::string command;
  for (const std::string& word : ClientWords("ann")) command += "'" + word + "' ";
  // script gives it a terminal of its own on all three, and copies its output.
  Program ann({"script", "-qefc", command + "--drive keyboard", folder / "seen"}, "",
              terminal.terminal());
  ASSERT_TRUE(server_->WaitForErrors("the room starts", kPatience)) << server_->Story();
  const std::string dots = "\xe2\xa0";  // of braille
  EXPECT_TRUE(Shows(ann, dots)) << ann.Story();
  sleep(1);
  terminal.Type("q");
  ASSERT_TRUE(ann.Wait(kPatience)) << ann.Story();
  EXPECT_EQ(ann.status(), 0) << ann.Story();
  const std::string seen = ann.output();
  EXPECT_NE(seen.find("keys: arrows or WASD drive"), std::string::npos) << seen.size();
  EXPECT_NE(seen.find("ann: "), std::string::npos);
  Program piped({"sh", "-c", "echo | " + command + "--drive keyboard"});
  ASSERT_TRUE(piped.Wait(kPatience));
  EXPECT_EQ(piped.status(), 2) << "a pipe has no keys: " << piped.Story();
}

TEST_F(Terminals, KeysPressedWhileOthersAreMissingCountWhenTheRoomStarts) {
  const Workspace folder;
  Start({"--record", folder / "session.lcm"}, "2");
  PseudoTerminal terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminals here";
  std::string command;
  for (const std::string& word : ClientWords("ann")) command += "'" + word + "' ";
  Program ann({"script", "-qefc", command + "--drive keyboard", folder / "seen"}, "",
              terminal.terminal());
  ASSERT_TRUE(server_->WaitForErrors("ann is here", kPatience)) << server_->Story();
  terminal.Type("d");
  sleep(2);  // much longer than a key is held
  EXPECT_TRUE(Shows(ann, "waiting for bob")) << "says who is missing";
  EXPECT_TRUE(Shows(ann, "\xe2\xa0")) << "and draws the scene";
  EXPECT_EQ(ann.output().find("round trip 0 ms"), std::string::npos);
  Program bob(ClientWords("bob"));
  ASSERT_TRUE(server_->WaitForErrors("the room starts", kPatience)) << server_->Story();
  sleep(2);
  terminal.Type("q");
  ASSERT_TRUE(ann.Wait(kPatience)) << ann.Story();
  server_->Signal(SIGINT);
  ASSERT_TRUE(server_->Wait(kPatience));
  int driven = 0;
  const Recording recording = ReadRecording(folder / "session.lcm");
  for (const auto& [tick, inputs] : recording.inputs.at(0)) {
    driven += static_cast<int>(std::count(inputs.drive.begin(), inputs.drive.end(), 127));
  }
  EXPECT_GT(driven, 4) << "a tenth of a second";
}

TEST(ClientFlags, AMisspeltDriveIsRefusedBeforeAnythingStarts) {
  for (const char* drive : {"keybord", "Keyboard", "keyboards"}) {
    Program client({BuiltProgram("seam-client"), "127.0.0.1:9", "--name", "ann", "--drive", drive,
                    "--lcm-url", "none"});
    ASSERT_TRUE(client.Wait(5)) << "it does not try to join";
    EXPECT_EQ(client.status(), 2);
    EXPECT_EQ(client.errors(), "seam-client: --drive " + std::string(drive) +
                                   ": there is none, bot, keyboard or a player's name (did you "
                                   "mean 'keyboard'?)\n");
  }
}

}  // namespace terminal_test
}  // namespace seam
