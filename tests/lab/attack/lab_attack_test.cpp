/// A client that lies wins nothing; an honest one is not doubted. docs/trust.md has the figures of
/// more networks and seeds (seam-lab attack).

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "common/measure/contents/log_audit.h"
#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/cheat.h"
#include "tests/lab/attack/honest.h"
#include "tests/support/soak.h"

namespace seam {
namespace lab_attack_test {

ClusterConfig Room(const std::string& impair, std::int64_t seed) {
  std::ifstream file("tests/lab/attack/trust.toml");
  ClusterConfig config;
  config.scene = "trust";
  config.scene_text.assign(std::istreambuf_iterator<char>(file), {});
  config.impair = impair;
  config.seed = seed;
  config.duration_s = 16;
  return config;
}

TEST(Attack, AGrossLiarLosesItsBodiesWithinFiveSeconds) {
  for (const char* attack : {"x1.2", "x1.5", "ram", "vel10", "fly", "lift", "freeze", "tear"}) {
    for (const char* impair : {"perfect", "4g"}) {
      for (const int seed : SoakSeeds(1, 1)) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(Room(impair, seed), attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_LT(ActedAfterS(outcome), 5);
        EXPECT_EQ(outcome.won, 0);
        EXPECT_EQ(outcome.others_step, 0) << "bob is honest";
      }
    }
  }
}

TEST(Attack, ATeleportWinsNoCoin) {
  for (const char* attack : {"silence", "firstword"}) {
    for (const char* impair : {"perfect", "demo", "terrible"}) {
      for (const int seed : SoakSeeds(1, 1)) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(Room(impair, seed), attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_EQ(outcome.won, 0);
        EXPECT_GE(outcome.step, static_cast<int>(TrustStep::kServerHolds));
      }
    }
  }
}

TEST(Attack, ASlightlyFasterCarIsFoundWithinHalfAMinute) {
  for (const int seed : SoakSeeds(1, 1)) {
    ClusterConfig config = Room("demo", seed);
    config.duration_s = 33;
    config.drive = Drive::kBot;
    const AttackOutcome outcome = RunAttack(config, "x1.05");
    EXPECT_LT(ActedAfterS(outcome), 30);
  }
}

/// Two ships in empty space: nothing but their engines moves them, by 5 m/s in each second.
const char* const kShips = R"(
gravity = [0, 0]
duration = 20
[[player]]
name = "ann"
vehicle = "ann-ship"
script = [[0, {drive = 1}], [3, {drive = -1}], [9, {drive = 1}], [15, {drive = -1}]]
[[player]]
name = "bob"
vehicle = "bob-ship"
script = [[0, {drive = -1}], [3, {drive = 1}], [9, {drive = -1}]]
[[part]]
name = "ann-ship"
box = [2, 1]
owner = "ann"
[[part]]
name = "bob-ship"
box = [2, 1]
position = [0, 30]
owner = "bob"
[[thrust]]
name = "ann-engine"
part = "ann-ship"
force = [10, 0]
player = "ann"
axis = "drive"
[[thrust]]
name = "bob-engine"
part = "bob-ship"
force = [10, 0]
player = "bob"
axis = "drive"
)";

/// An engine that is 2 % too strong differs by 3 mm/s in each message: only the sum shows it.
TEST(Attack, AnEngineThatIsALittleTooStrongIsFound) {
  for (const char* impair : {"perfect", "4g", "terrible"}) {
    for (const int seed : SoakSeeds(1, 1)) {
      ClusterConfig config = Room(impair, seed);
      config.scene = "ships";
      config.scene_text = kShips;
      EXPECT_EQ(RunAttack(config, "none").step, 0) << impair;
      for (const char* attack : {"gain0.1", "gain0.2", "gain0.5"}) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(config, attack);
        EXPECT_GT(outcome.lies, 5);
        EXPECT_LT(ActedAfterS(outcome), 10);
        EXPECT_EQ(outcome.others_step, 0);
      }
    }
  }
}

/// Without the server's doubts, afterwards.
TEST(Attack, ARecordingShowsWhoseEngineIsTooStrong) {
  for (const char* attack : {"none", "gain0.5"}) {
    for (const char* impair : {"demo", "4g", "terrible"}) {
      SCOPED_TRACE(std::string(attack) + " over " + impair);
      ClusterConfig config = Room(impair, 1);
      config.scene = "ships";
      config.scene_text = kShips;
      config.trust = TrustMode::kOff;
      const Scene scene = ParseScene(kShips, "ships");
      Cheat cheat(attack, scene);
      config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) {
        return client == 0 ? cheat.Around(std::move(net)) : std::move(net);
      };
      Cluster cluster(config);
      cluster.Run();
      const std::vector<AuditedPeer> peers = AuditRecording(cluster.recording());
      ASSERT_EQ(peers.size(), 2u);
      EXPECT_EQ(peers[0].lies(), std::string(attack) != "none") << peers[0].gain_mps2;
      EXPECT_FALSE(peers[1].lies()) << peers[1].gain_mps2;
    }
  }
}

TEST(Attack, PartsThatAScriptInsertsAreToldOf) {
  for (const char* attack : {"x1.05", "gain0.1", "bounce1.2", "tear", "fly"}) {
    SCOPED_TRACE(attack);
    ClusterConfig room = Room("perfect", 1);
    room.duration_s = 8;
    room.scene_text += R"(
[[script]]
name = "spawner"
code = '''
function on_tick(t)
  local at = world.tick()
  if at % 3 == 0 then
    world.add_part{name = "x" .. at, box = {0.2, 0.2}, position = {-200, 30}}
  end
  if world.part("x" .. at - 60) then world.remove_part("x" .. at - 60) end
end
'''
)";
    EXPECT_GT(RunAttack(room, attack).lies, 10);
  }
}

TEST(Attack, GlueWithoutALoadDoesNotBreak) {
  const AttackOutcome outcome = RunAttack(Room("demo", 1), "break");
  EXPECT_GT(outcome.lies, 5);
  EXPECT_EQ(outcome.broken, 0);
  EXPECT_GE(outcome.step, static_cast<int>(TrustStep::kServerHolds));
}

TEST(Attack, ALieAboutImpactsHurtsNobody) {
  const AttackOutcome outcome = RunAttack(Room("demo", 1), "impact");
  EXPECT_GT(outcome.lies, 10);
  EXPECT_EQ(outcome.hurt, 0);
}

/// The room with three balls that roll from ann's region into bob's, one a second.
ClusterConfig RoomOfBalls(const std::string& impair, std::int64_t seed) {
  ClusterConfig config = Room(impair, seed);
  config.scene_text += R"(
[[part]]
name = "ball"
circle = 0.5
position = [-7, 0.5]
velocity = [1.2, 0]
repeat = {count = 3, step = [1.5, 0]}
)";
  return config;
}

TEST(Attack, AFalseStateAtAHandOverIsRefused) {
  for (const char* impair : {"perfect", "demo", "4g", "terrible"}) {
    for (const int seed : SoakSeeds(1, 1)) {
      SCOPED_TRACE(impair);
      const AttackOutcome honest = RunAttack(RoomOfBalls(impair, seed), "none");
      EXPECT_EQ(honest.refused, 0);
      const AttackOutcome outcome = RunAttack(RoomOfBalls(impair, seed), "exact");
      EXPECT_GT(outcome.lies, 0);
      EXPECT_GT(outcome.refused, 0);
      EXPECT_EQ(outcome.others_step, 0) << "bob takes the server's states over, not the lie";
    }
  }
}

TEST(Attack, AHolderThatDoesNotLetGoHoldsNothing) {
  for (const char* impair : {"perfect", "demo", "4g", "terrible"}) {
    for (const int seed : SoakSeeds(1, 1)) {
      SCOPED_TRACE(impair);
      const AttackOutcome outcome = RunAttack(RoomOfBalls(impair, seed), "withhold");
      EXPECT_GT(outcome.lies, 0);
      EXPECT_LT(ActedAfterS(outcome), 10);
      EXPECT_EQ(outcome.others_step, 0);
    }
  }
}

/// Number of edits at the end.
int EditsIn(ClusterConfig config) {
  config.keep = false;
  Cluster cluster(config);
  cluster.Run();
  return cluster.server().replica().revision();
}

/// Mode strict: the server simulates no copy, and the told momentum explains a break, or does not.
TEST(Attack, TrustRefusesNoHonestEditInModeStrict) {
  ClusterConfig config = Room("demo", 1);
  config.mode = "strict";
  EXPECT_EQ(RunAttack(config, "break").broken, 0);
  ClusterConfig honest;
  honest.scene = "playground";
  honest.mode = "strict";
  honest.trust = TrustMode::kOff;
  const int edits = EditsIn(honest);
  EXPECT_GT(edits, 3);
  honest.trust = TrustMode::kAct;
  EXPECT_EQ(EditsIn(honest), edits);
}

TEST(Attack, AnHonestClientIsNotDoubted) {
  for (const char* impair : {"perfect", "demo", "4g", "3g", "terrible"}) {
    for (const Drive drive : {Drive::kScript, Drive::kBot}) {
      SCOPED_TRACE(impair);
      ClusterConfig config = Room(impair, 1);
      config.drive = drive;
      const AttackOutcome outcome = RunAttack(config, "none");
      EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kWatched));
      EXPECT_LE(outcome.others_step, static_cast<int>(TrustStep::kWatched));
    }
  }
}

/// A sample of seam-lab trust: scenes in which glue breaks, bodies are inserted and collide.
TEST(Attack, NoHonestStateIsRefused) {
  struct Case {
    const char *scene, *impair, *method;
    Drive drive;
    bool shown;
  };
  const Case cases[] = {
      {"playground", "terrible", "buffer", Drive::kScript, true},
      {"freight", "4g", "buffer", Drive::kScript, true},
      {"gluehouse", "demo", "buffer", Drive::kScript, true},
      {"gluehouse", "demo", "strict", Drive::kScript, true},
      {"derby", "3g", "buffer", Drive::kBot, true},
      {"derby", "terrible", "buffer", Drive::kScript, false},
      {"seesaw", "3g", "buffer", Drive::kScript, false},
      {"crossing", "perfect", "buffer", Drive::kScript, false},
      {"battlefield", "3g", "buffer", Drive::kBot, false},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.impair + " " + c.method);
    ClusterConfig config;
    config.scene = c.scene;
    config.impair = c.impair;
    config.mode = c.method;
    config.drive = c.drive;
    config.duration_s = 10;
    const HonestOutcome outcome = RunHonest(config, c.shown);
    EXPECT_GT(outcome.judged, 100);
    EXPECT_EQ(outcome.refused, 0);
    EXPECT_EQ(outcome.breaks_refused, 0);
    EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kWatched));
    EXPECT_LE(outcome.impacts_refused * 100, outcome.impacts_accepted);
    EXPECT_LT(outcome.drift, 0.5) << "of the sum that is doubted";
  }
}

TEST(Attack, AnHonestRoomIsTheSameToTheBitWithAndWithoutTrust) {
  for (const char* scene : {"crossing", "wall", "playground", "derby"}) {
    for (const char* impair : {"demo", "terrible"}) {
      SCOPED_TRACE(std::string(scene) + " " + impair);
      ClusterConfig config;
      config.scene = scene;
      config.impair = impair;
      config.drive = Drive::kBot;
      config.duration_s = 5;
      const std::vector<std::uint64_t> hashes = HashesByTrust(config);
      EXPECT_EQ(hashes[0], hashes[1]);
      EXPECT_EQ(hashes[0], hashes[2]);
    }
  }
}

}  // namespace lab_attack_test
}  // namespace seam
