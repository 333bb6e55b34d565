/// Rooms in which parts are made and removed all the time, far from those who are judged: a liar is
/// found as elsewhere, and an honest client keeps its bodies. docs/trust.md has more networks.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/honest.h"
#include "tests/support/soak.h"

namespace seam {
namespace lab_edited_room_test {

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

/// A script that makes and removes a crate far from the liar, `every` ticks apart.
std::string FarEdits(int every, const std::string& place) {
  return R"(
[[script]]
name = "spawner"
code = '''
function on_tick()
  if world.tick() % )" +
         std::to_string(every) + R"( ~= 0 then return end
  room.n = (room.n or 0) + 1
  if room.n % 2 == 1 then
    world.add_part{name = "x" .. room.n, box = {0.3, 0.4}, position = )" +
         place + R"(}
  else
    pcall(world.remove_part, "x" .. (room.n - 1))
  end
end
'''
)";
}

TEST(EditedRoom, ALiarIsFoundWhereOthersBodiesAreMadeAndRemovedAllTheTime) {
  for (const int every : {15, 30}) {
    SCOPED_TRACE(every);
    ClusterConfig config = Room("perfect", 1);
    config.scene_text += FarEdits(every, "{200, 30}");
    config.drive = Drive::kBot;
    config.duration_s = 33;
    const AttackOutcome outcome = RunAttack(config, "x1.05");
    EXPECT_LT(ActedAfterS(outcome), 30);
    EXPECT_LE(outcome.others_step, static_cast<int>(TrustStep::kNoted)) << "bob is honest";
  }
}

/// Beside an edit a told state is judged by its way, which a false velocity would make longer.
TEST(EditedRoom, AFalseVelocityWinsNothing) {
  for (const char* attack : {"vel10", "x1.2", "x1.5"}) {
    for (const char* impair : {"demo", "4g"}) {
      for (const int seed : SoakSeeds(1, 1)) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        ClusterConfig config = Room(impair, seed);
        config.scene_text += FarEdits(15, "{200, 30}");
        config.drive = Drive::kBot;
        const AttackOutcome outcome = RunAttack(config, attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_LT(ActedAfterS(outcome), 5);
        EXPECT_EQ(outcome.won, 0);
        EXPECT_EQ(outcome.others_step, 0) << "bob is honest";
      }
    }
  }
}

TEST(EditedRoom, AnHonestClientKeepsItsBodiesWhereOthersAreMadeAndRemovedAllTheTime) {
  for (const char* impair : {"3g", "4g", "terrible"}) {
    for (const int seed : SoakSeeds(1, 2)) {
      SCOPED_TRACE(std::string(impair) + " " + std::to_string(seed));
      ClusterConfig config;
      config.scene = "crossing";
      config.scene_text = LoadScene("scenes/crossing.toml").text + FarEdits(7, "{-120, 6}");
      config.impair = impair;
      config.seed = seed;
      config.drive = Drive::kBot;
      config.duration_s = 20;
      const HonestOutcome outcome = RunHonest(config, true);
      EXPECT_GT(outcome.judged, 100);
      EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kNoted));
    }
  }
}

}  // namespace lab_edited_room_test
}  // namespace seam
