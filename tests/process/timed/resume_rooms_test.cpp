/// Which rooms of a folder go on, for how long, and for whom.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "tests/process/timed/kept_rooms.h"

namespace seam {
namespace resume_rooms_test {

constexpr double kPatience = kKeptPatience;

using ResumeRooms = KeptRooms;

/// Of two rooms one plays and one waits for its players.
TEST_F(ResumeRooms, ARoomThatWaitsOrIsDamagedKeepsNoOtherOut) {
  SEAM_INSIDE_ONLY();
  folder_.Write("yard.toml", kYard);
  const auto snapshots = [&](const std::string& room) {
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(State(), error)) {
      const std::string name = file.path().filename().string();
      if (name.rfind(room + "-0", 0) == 0 && file.path().extension() == ".snapshot")
        found.push_back(file.path().string());
    }
    return found;
  };
  const auto wait_for = [](const auto& done) {
    for (int i = 0; i < kPatience * 20 && !done(); ++i) usleep(50000);
    return done();
  };
  auto server = std::make_unique<Program>(
      Server({folder_ / "yard.toml", folder_ / "yard.toml", "--state", State()}));
  Program ann(Client("ann")), bob(Client("bob"));
  ASSERT_TRUE(wait_for([&] { return !snapshots("main-1").empty(); })) << server->Story();
  EXPECT_TRUE(snapshots("main-2").empty());
  server->Signal(SIGKILL);
  ASSERT_TRUE(server->Wait(kPatience));
  const std::size_t before = snapshots("main-1").size();
  server = std::make_unique<Program>(Server({"--resume", State()}));
  ASSERT_TRUE(wait_for([&] {
    return server->errors().find("resumed at tick") != std::string::npos;
  })) << server->Story();
  EXPECT_EQ(before, 1u);
  server->Signal(SIGTERM);
  ASSERT_TRUE(server->Wait(kPatience));
  EXPECT_EQ(server->status(), 0) << server->Story();
  for (const std::string& file : snapshots("main-1")) std::filesystem::resize_file(file, 1000);
  server = std::make_unique<Program>(Server({"--resume", State()}));
  ASSERT_TRUE(wait_for([&] {
    return server->errors().find(": no snapshot and") != std::string::npos;
  })) << server->Story();
  EXPECT_NE(server->errors().find("its whole log is done again"), std::string::npos);
  EXPECT_EQ(server->errors().find("otherwise than it was"), std::string::npos) << server->Story();
  server->Signal(SIGTERM);
  ASSERT_TRUE(server->Wait(kPatience));
  EXPECT_EQ(server->status(), 0) << server->Story();
  for (const std::string& file : snapshots("main-1")) std::filesystem::resize_file(file, 1000);
  std::filesystem::resize_file(State() + "/main-1.lcm", 1000);
  server = std::make_unique<Program>(Server({"--resume", State()}));
  ASSERT_TRUE(wait_for([&] {
    return server->errors().find("no snapshot that can be read") != std::string::npos;
  })) << server->Story();
  usleep(500000);
  server->Signal(SIGTERM);
  ASSERT_TRUE(server->Wait(kPatience));
  EXPECT_EQ(server->status(), 1) << server->Story();
  EXPECT_NE(server->errors().find("the other rooms go on"), std::string::npos) << server->Story();
}

TEST_F(ResumeRooms, RoomsThatDemandedTokensAreNotOpenedByASlip) {
  SEAM_INSIDE_ONLY();
  folder_.Write("yard.toml", kYard);
  Program keys({BuiltProgram("seam-token"), "--make-key", "--key", folder_ / "op.key"});
  ASSERT_TRUE(keys.Wait(kPatience) && keys.status() == 0) << keys.Story();
  Program server(Server({folder_ / "yard.toml", "--state", State(), "--wait", "0", "--token-key",
                         folder_ / "op.key"}));
  ASSERT_TRUE(WaitForLog([](const Recording& r) { return r.last_tick > 10; })) << server.Story();
  server.Signal(SIGTERM);
  ASSERT_TRUE(server.Wait(kPatience));
  Program open(Server({"--resume", State()}));
  ASSERT_TRUE(open.Wait(kPatience));
  EXPECT_EQ(open.status(), 2) << open.Story();
  EXPECT_NE(open.errors().find("demand tokens: --token-key"), std::string::npos) << open.Story();
}

/// A room of 0.5 s that --duration 0 has kept for longer.
TEST_F(ResumeRooms, ARoomThatIsOlderThanItsScenesDurationGoesOn) {
  SEAM_INSIDE_ONLY();
  folder_.Write("short.toml", "duration = 0.5\n" + std::string(kYard));
  const auto without_duration = [&](std::vector<std::string> words) {
    const auto flag = std::find(words.begin(), words.end(), "--duration");
    words.erase(flag, flag + 2);
    return words;
  };
  const auto older_than = [&](std::size_t sessions, std::int64_t tick) {
    return WaitForLog([&](const Recording& r) {
      const View* const view = LastView(r, 0);
      return r.sessions.size() == sessions && view != nullptr && view->tick > tick;
    });
  };
  Program first(Server({folder_ / "short.toml", "--state", State(), "--wait", "0"}));
  ASSERT_TRUE(older_than(1, 60)) << first.Story();
  first.Signal(SIGKILL);
  ASSERT_TRUE(first.Wait(kPatience));
  Program second(without_duration(Server({"--resume", State()})));
  ASSERT_TRUE(older_than(2, 150)) << second.Story();
  second.Signal(SIGTERM);
  ASSERT_TRUE(second.Wait(kPatience));
  EXPECT_EQ(second.status(), 0) << second.Story();
  EXPECT_NE(second.errors().find("Ctrl-C ends it"), std::string::npos) << second.Story();
  auto words = Server({"--resume", State()});
  *(std::find(words.begin(), words.end(), "--duration") + 1) = "1";
  Program third(words);
  ASSERT_TRUE(third.Wait(kPatience));
  EXPECT_EQ(third.status(), 0) << third.Story();
  EXPECT_NE(third.errors().find("room main is over"), std::string::npos) << third.Story();
  EXPECT_NE(third.errors().find("; then 0 s"), std::string::npos) << third.Story();
}

}  // namespace resume_rooms_test
}  // namespace seam
