/// seam-server --state is killed, and --resume goes on.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "client/client.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"
#include "tests/process/timed/kept_rooms.h"

namespace seam {
namespace resume_test {

constexpr double kPatience = kKeptPatience;

using Resume = KeptRooms;

/// Returns the number of parts of kYard in the views of a tick: five, and what its script has made.
std::size_t PartsAt(std::int64_t tick) { return 5 + static_cast<std::size_t>((tick - 1) / 120); }

std::map<std::pair<int, int>, float> ValuesOf(const Recording& recording) {
  std::map<std::pair<int, int>, float> values;
  for (const Meta& meta : recording.meta) {
    for (std::size_t i = 0; i < meta.id.size(); ++i) {
      values[{meta.kind[i] * 1000 + meta.id[i], meta.key[i]}] = meta.value[i];
    }
  }
  return values;
}

/// Returns N of the last event "second N"; 0: there is none.
int LastSecond(const Recording& recording) {
  int last = 0;
  for (const Event& event : recording.events) {
    if (event.text.rfind("second ", 0) == 0) last = std::stoi(event.text.substr(7));
  }
  return last;
}

TEST_F(Resume, AKilledServerGoesOnWithItsWorldAndItsPlayers) {
  SEAM_INSIDE_ONLY();
  folder_.Write("yard.toml", kYard);
  std::vector<std::unique_ptr<Program>> clients;
  auto server = std::make_unique<Program>(
      Server({folder_ / "yard.toml", "--state", State(), "--store", folder_ / "past.db"}));
  for (const char* name : {"ann", "bob"}) {
    clients.push_back(std::make_unique<Program>(Client(name)));
  }
  double worst_back_s = 0, worst_jump_m = 0, worst_pause_s = 0;
  std::int64_t most_lost = 0;
  for (int round = 0; round < 3; ++round) {
    // Some seconds of play, and a part of a second that differs.
    const std::int64_t from = round == 0 ? 0 : LastView(ReadRecording(Log()), 0)->tick;
    ASSERT_TRUE(WaitForLog([&](const Recording& r) {
      return r.views.count(0) != 0 && LastView(r, 0)->tick > from + 150 &&
             ValuesOf(r).size() >= (round == 0 ? 1u : 0u);
    })) << server->Story()
        << clients[0]->Story();
    usleep(static_cast<useconds_t>(137000 + 211000 * round));
    server->Signal(SIGKILL);
    ASSERT_TRUE(server->Wait(kPatience));
    const Recording was = ReadRecording(Log());
    EXPECT_TRUE(DamageLines(was).empty()) << DamageLines(was).front();
    const View before = *LastView(was, 0);
    const std::int64_t begin_us = SteadyClockUs();
    server = std::make_unique<Program>(
        Server({"--resume", State(), "--store", folder_ / "past.db", "--summary",
                folder_ / ("sum" + std::to_string(round) + ".json")}));
    ASSERT_TRUE(WaitForLog([&](const Recording& r) {
      return r.sessions.size() == was.sessions.size() + 1 && r.views.count(0) != 0;
    })) << server->Story();
    worst_back_s = std::max(worst_back_s, static_cast<double>(SteadyClockUs() - begin_us) * 1e-6);
    const Recording is = ReadRecording(Log());
    const View after = is.views.at(0).begin()->second;
    EXPECT_EQ(after.tick, before.tick + 1) << "the room's clock goes on";
    most_lost = std::max(most_lost, before.tick + 1 - after.tick);
    for (const View& view : {before, after}) {
      ASSERT_EQ(view.id.size(), PartsAt(view.tick)) << "with those of the script, once each";
    }
    ASSERT_TRUE(std::equal(before.id.begin(), before.id.end(), after.id.begin()));
    for (std::size_t i = 0; i < before.id.size(); ++i) {
      const double moved = std::hypot(static_cast<double>(after.x[i] - before.x[i]),
                                      static_cast<double>(after.y[i] - before.y[i]));
      const double speed =
          std::hypot(static_cast<double>(before.vx[i]), static_cast<double>(before.vy[i]));
      worst_jump_m = std::max(worst_jump_m, std::fabs(moved - speed / 60));
    }
    // The players come back by themselves, to their own places, and not into tick 0.
    for (const int peer : {0, 1}) {
      const int player = peer;
      ASSERT_TRUE(WaitForLog([&](const Recording& r) {
        const auto inputs = r.inputs.find(player);
        return inputs != r.inputs.end() && inputs->second.rbegin()->first > after.tick + 1;
      })) << server->Story()
          << clients[static_cast<std::size_t>(peer)]->Story();
    }
    worst_pause_s = std::max(worst_pause_s, static_cast<double>(SteadyClockUs() - begin_us) * 1e-6);
    const Recording back = ReadRecording(Log());
    EXPECT_GE(back.first_tick, before.tick) << "nobody begins at tick 0";
    // The killed session is summed up in the log, up to its last tick.
    const auto killed = std::find_if(
        back.summaries.begin(), back.summaries.end(),
        [](const Summary& sum) { return sum.ended == static_cast<std::int8_t>(Ended::kKilled); });
    ASSERT_NE(killed, back.summaries.end());
    EXPECT_EQ(killed->of, was.room.session);
    EXPECT_EQ(killed->tick, before.tick);
    ASSERT_EQ(killed->names, "ann bob");
    EXPECT_EQ(killed->score[0], 7);
    EXPECT_GT(killed->present_ticks[0], 100);
    EXPECT_LE(killed->present_ticks[0], killed->ticks);
    ASSERT_TRUE(WaitForLog([&](const Recording& r) { return LastSecond(r) > 0; }));
    const int second = LastSecond(was);
    for (const Event& event : ReadRecording(Log()).events) {
      if (event.text.rfind("second ", 0) != 0) continue;
      EXPECT_EQ(event.text, "second " + std::to_string(second + 1)) << "the script has its table";
      break;
    }
  }
  std::printf(
      "killed 3 times: back after %.2f s, %lld ticks lost, bodies jump %.1e m, all players are "
      "back after %.1f s\n",
      worst_back_s, static_cast<long long>(most_lost), worst_jump_m, worst_pause_s);
  EXPECT_LT(worst_jump_m, 0.05);
  // One that is told nothing waits for so long since the kill, which was a moment before.
  EXPECT_LT(worst_pause_s, 0.9e-6 * Client::kLostUs)
      << "a server that does not know a session says so";
  server->Signal(SIGTERM);
  EXPECT_TRUE(server->Wait(kPatience));
  EXPECT_EQ(server->status(), 0) << server->Story();
  const std::string errors = server->errors();
  EXPECT_NE(errors.find(" killed: "), std::string::npos) << "both sums: " << errors;
  EXPECT_NE(errors.find(" ended: "), std::string::npos) << errors;
  const std::string json = ReadPlainFile(folder_ / "sum2.json", 1 << 20);
  EXPECT_NE(json.find(R"("ended":"killed")"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("rejoins":1)"), std::string::npos) << json;
  Program top({BuiltProgram("seam-log"), "top", folder_ / "past.db"});
  EXPECT_TRUE(top.Wait(kPatience));
  const std::string ranks = top.output();
  EXPECT_NE(ranks.find("   1  ann                           7 "), std::string::npos) << ranks;
  int ended = 0, killed = 0;
  for (std::size_t at = 0; (at = ranks.find("  killed\n", at)) != std::string::npos; ++at) ++killed;
  for (std::size_t at = 0; (at = ranks.find("  ended\n", at)) != std::string::npos; ++at) ++ended;
  EXPECT_EQ(killed, 3) << ranks;
  EXPECT_EQ(ended, 2) << "the name of the column, and the last session: " << ranks;
  // Scores are told to those who join: the first session has them, and a resumed room keeps them.
  Program measure({BuiltProgram("seam-measure"), Log()});
  EXPECT_TRUE(measure.Wait(kPatience));
  EXPECT_EQ(measure.status(), 0) << measure.Story();
  // Four sessions of one room, done again from its first tick on.
  Program replay({LabProgram(), "replay", Log()});
  EXPECT_TRUE(replay.Wait(kPatience));
  EXPECT_EQ(replay.status(), 0) << replay.Story();
  const std::int64_t last = LastView(ReadRecording(Log()), 0)->tick;
  const std::size_t at = replay.output().find(": ");
  ASSERT_NE(at, std::string::npos) << replay.Story();
  EXPECT_GE(std::atoll(replay.output().c_str() + at + 2), last) << replay.Story();
}

TEST_F(Resume, ARoomRunsOnWithoutAStoreThatCannotBeWritten) {
  SEAM_INSIDE_ONLY();
  folder_.Write("cats.db", std::string(3000, 'c'));
  auto flags = Server({"crossing", "--wait", "0", "--store", folder_ / "cats.db"});
  flags[std::find(flags.begin(), flags.end(), "--duration") - flags.begin() + 1] = "2";
  Program server(flags);
  ASSERT_TRUE(server.Wait(kPatience));
  EXPECT_EQ(server.status(), 1) << server.Story();
  EXPECT_NE(server.errors().find("not a database; the room runs on"), std::string::npos)
      << server.Story();
  EXPECT_NE(server.errors().find("120 ticks"), std::string::npos) << server.Story();
}

TEST_F(Resume, MistakesAreOneLine) {
  SEAM_INSIDE_ONLY();
  folder_.Write("yard.toml", kYard);
  std::filesystem::create_directory(folder_ / "empty");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--resume", folder_ / "none"}, "cannot be read"},
      {{"--resume", folder_ / "empty"}, "no room in it"},
      {{"crossing", "--resume", folder_ / "empty"}, "not with a scene"},
      {{"crossing", "--state", State(), "--record", folder_ / "a.lcm"}, "not with --record"},
      {{"crossing", "--mode", "oracle", "--state", State()}, "mode oracle"}};
  for (const auto& [flags, says] : wrong) {
    Program server(Server(flags));
    ASSERT_TRUE(server.Wait(kPatience));
    EXPECT_EQ(server.status(), 2) << server.Story();
    EXPECT_NE(server.errors().find(says), std::string::npos) << server.Story();
    const std::string errors = server.errors();
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  }
}

}  // namespace resume_test
}  // namespace seam
