/// Damage, checkpoints, pickups and scripts over a world that is stepped alone.

#include "server/rules/rules.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "server/rules/part_owner.h"
#include "server/rules/script_room.h"
#include "server/script/script_host.h"

namespace seam {
namespace rules_test {

using Lines = std::vector<std::string>;

/// Records the requests.
class FakeRoomCommands : public RoomCommands {
 public:
  Lines asked, said;
  void RemovePart(PartId part) override { asked.push_back("remove " + std::to_string(part)); }
  void BreakJoint(int joint) override { asked.push_back("break " + std::to_string(joint)); }
  void Bond(PartId a, PartId b, float strength) override {
    asked.push_back("bond " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(strength));
  }
  void Push(PartId part, const Vec2& impulse) override {
    asked.push_back("push " + std::to_string(part) + " " + std::to_string(impulse.x()));
  }
  void Limp(PartId part, float seconds) override {
    asked.push_back("limp " + std::to_string(part) + " " + std::to_string(seconds));
  }
  void Blast(const Vec2&, float radius, float, float) override {
    asked.push_back("blast " + std::to_string(radius));
  }
  void LeaveSeat(int seat) override { asked.push_back("unseat " + std::to_string(seat)); }
  void Insert(const std::string& text) override { asked.push_back(text); }
  void Say(const Event& event) override { said.push_back(event.text); }
  void Warn(const std::string& text) override { said.push_back(text); }
  bool Present(int player) const override { return player == 0; }
  Input ReadInput(int) const override { return {}; }
};

struct Game {
  explicit Game(const std::string& text)
      : world(ParseScene("gravity = [0, 0]\n" + text, "g.toml")), rules(world, 1, commands) {
    world.WatchTouches();
  }
  void Step(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      world.Step();
      rules.AfterTick();
    }
  }
  PartId IdOf(const std::string& name) const {
    for (const Part& part : world.scene().parts) {
      if (part.name == name) return part.id;
    }
    return -1;
  }
  float Value(const std::string& part, std::int8_t key = kMetaHealth) const {
    return rules.metadata().Get({kMetaPart, IdOf(part), key});
  }
  float OfPlayer(int player, std::int8_t key) const {
    return rules.metadata().Get({kMetaPlayer, player, key});
  }
  World world;
  FakeRoomCommands commands;
  Rules rules;
};

/// Discs of 1 m that collide without loss; `more` belongs to the second.
std::string Discs(float density, const std::string& more) {
  return "[[player]]\nname = \"ann\"\nvehicle = \"a\"\n[[player]]\nname = \"bob\"\n"
         "[[part]]\nname = \"a\"\ncircle = 0.5\nrestitution = 1\nfriction = 0\nhealth = 100\n"
         "damage = {above = 2, factor = 5}\nvelocity = [10, 0]\n"
         "[[part]]\nname = \"b\"\ncircle = 0.5\nrestitution = 1\nfriction = 0\nposition = [3, 0]\n"
         "density = " +
         std::to_string(density) + "\nhealth = 100\n" + more;
}

TEST(Rules, AnImpactDamagesByTheChangeOfEachBodysOwnVelocity) {
  for (const float ratio : {1.0f, 4.0f, 0.25f}) {
    Game game(Discs(ratio, "damage = {above = 2, factor = 5}\n"));
    EXPECT_EQ(game.Value("a"), 100);
    game.Step(60);
    // Elastic, mass 1 with 10 m/s against mass r at rest: the changes are 20 r / (1 + r) and
    // 20 / (1 + r); health goes by 5 for each m/s above 2.
    const float a = 20 * ratio / (1 + ratio), b = 20 / (1 + ratio);
    EXPECT_NEAR(game.Value("a"), 100 - 5 * (a - 2), 0.5) << ratio;
    EXPECT_NEAR(game.Value("b"), 100 - 5 * (b - 2), 0.5) << ratio;
    EXPECT_EQ(game.commands.said, Lines{});
  }
}

TEST(Rules, DeathBreaksTheMechanismsJointsOnceAndRewardsTheAttacker) {
  Game game(Discs(1, R"(damage = {above = 2, factor = 50}
score = 30
[[part]]
name = "arm"
box = [1, 0.2]
position = [3, 2]
[[part]]
name = "hand"
box = [0.2, 0.2]
position = [3, 3]
[[joint]]
name = "shoulder"
kind = "revolute"
a = "b"
b = "arm"
[[joint]]
name = "glove"
kind = "weld"
a = "arm"
b = "hand"
)"));
  game.Step(60);
  EXPECT_EQ(game.Value("b"), 0);
  EXPECT_EQ(game.commands.asked, Lines{"break 0"}) << "the shoulder; welds hold";
  EXPECT_EQ(game.commands.said, Lines{"b is destroyed by ann"});
  EXPECT_EQ(game.OfPlayer(0, kMetaScore), 30);
  EXPECT_EQ(game.OfPlayer(1, kMetaScore), 0);
}

TEST(Rules, AnActiveCharacterThatDiesGoesLimpOnceAndKeepsItsJoints) {
  Game game(R"(
[[part]]
name = "ground"
chain = [[-20, -1], [20, -1]]
[[player]]
name = "ann"
[[character]]
name = "hero"
position = [0, 0]
health = 50
[[character]]
name = "doll"
kind = "passive"
position = [9, 0]
health = 50
[[script]]
name = "s"
code = '''
function on_tick(t)
  if world.tick() == 5 then
    world.health("hero.head", -50)
    world.health("doll.head", -50)
  end
end
'''
)");
  game.Step(60);
  int limp = 0, broken = 0;
  for (const std::string& asked : game.commands.asked) {
    limp += asked == "limp " + std::to_string(game.IdOf("hero.head")) + " " +
                         std::to_string(kLimpUntilReleased)
                ? 1
                : 0;
    broken += asked.rfind("break ", 0) == 0 ? 1 : 0;
  }
  EXPECT_EQ(limp, 1);
  EXPECT_EQ(broken, 11) << "the doll's";
  EXPECT_EQ(game.commands.said, (Lines{"hero.head is destroyed", "doll.head is destroyed"}));
}

/// A track of length 100 in x, run through by ann's `a` (and bob's `b`, above it).
std::string Track(const std::string& more, const char* of_a = "", const char* of_b = "") {
  return std::string(
             "bounds = [[-9000, -100], [9000, 100]]\n"
             "[[player]]\nname = \"ann\"\nvehicle = \"a\"\n"
             "[[player]]\nname = \"bob\"\nvehicle = \"b\"\n"
             "[[part]]\nname = \"a\"\ncircle = 0.2\nvelocity = [6, 0]\n") +
         of_a + "\n[[part]]\nname = \"b\"\ncircle = 0.2\nposition = [0, 1]\nvelocity = [6, 0]\n" +
         of_b + "\n" + more;
}

TEST(Rules, AHazardTakesHealthByTheSecond) {
  Game game(
      Track("[[trigger]]\nname = \"fire\"\nkind = \"hazard\"\nposition = [6, 0]\n"
            "box = [6, 0.5]\nhealth = 20\n",
            "health = 100"));
  game.Step(180);
  // 6 m at 6 m/s: a second, to the tick at both ends.
  EXPECT_NEAR(game.Value("a"), 80, 2 * 20.0 / 60);
  EXPECT_EQ(game.Value("b"), 0) << "without health nothing is set";
}

TEST(Rules, CheckpointsCountInTheirOrderAndMakeLaps) {
  std::string track;
  const std::pair<int, float> points[] = {{1, 3}, {3, 5}, {2, 7}, {3, 9}, {1, 11}};
  int n = 0;
  for (const auto& [order, x] : points) {
    track += "[[trigger]]\nname = \"c" + std::to_string(n++) +
             "\"\nkind = \"checkpoint\"\nscore = 5\norder = " + std::to_string(order) +
             "\nposition = [" + std::to_string(x) + ", 0]\nbox = [0.5, 0.5]\n";
  }
  Game game(Track(track));
  game.Step(180);
  EXPECT_EQ(game.OfPlayer(0, kMetaLaps), 1) << "1, (not 3 yet), 2, 3";
  EXPECT_EQ(game.OfPlayer(0, kMetaCheckpoint), 1) << "and 1 of the next lap";
  EXPECT_EQ(game.OfPlayer(0, kMetaScore), 20);
  EXPECT_EQ(game.OfPlayer(1, kMetaScore), 0) << "bob flew above them";
  EXPECT_EQ(game.commands.said, (Lines{"ann passes c0", "ann passes c2", "ann passes c3",
                                       "ann has done a lap", "ann passes c4"}));
}

TEST(Rules, APickupIsTakenOnceByTheFirstPermittedPlayer) {
  const std::string coin =
      "[[part]]\nname = \"coin\"\ncircle = 0.1\nposition = [6, 0.5]\nanchored = true\n"
      "permissions = {take = [\"bob\"]}\n"
      "[[trigger]]\nname = \"gold\"\nkind = \"pickup\"\npart = \"coin\"\nbox = [1, 3]\n"
      "score = 7\nhealth = 500\n";
  Game game(Track(coin, "", "health = 40"));
  game.Step(120);
  EXPECT_EQ(game.commands.said, Lines{"bob takes gold"});
  EXPECT_EQ(game.commands.asked, Lines{"remove 2"});
  EXPECT_EQ(game.Value("coin", kMetaTaken), 2) << "1 + bob's place";
  EXPECT_EQ(game.OfPlayer(1, kMetaScore), 7);
  EXPECT_EQ(game.OfPlayer(0, kMetaScore), 0);
  EXPECT_EQ(game.Value("b"), 40) << "no more than the scene gave";
}

TEST(Rules, ScriptsReceiveTouchesTriggersAndPlayers) {
  Game game(Track(R"([[part]]
name = "wall"
box = [1, 4]
position = [6, 0]
anchored = true
[[trigger]]
name = "half"
position = [3, 0]
box = [1, 0.5]
[[script]]
name = "s"
code = '''
function on_touch(a, b) print(a, b, world.tick()) end
function on_trigger(t, part, entered) print(t, part, entered) end
function on_join(p) print(p, "joins", table.concat(world.players(), " ")) end
function on_leave(p) print(p, "leaves") end
function on_tick(t)
  if world.tick() == 10 then
    world.impulse("a", 1, 0)
    world.add_part{name = "new", box = {1, 1}, position = {0, 9.5}, anchored = true}
    world.weld("a", "b", 5)
    print(pcall(world.unweld, "a", "b"))
    world.set("ann", "value3", 4)
    print(pcall(world.impulse, "wall", 1, 0))
    print(pcall(world.impulse, "a", 1e6, 0))
    print(pcall(world.set, "wall", "health", 4))
    print(pcall(world.get, "wall", "colour"))
    print(pcall(world.remove_part, "nothing"))
  end
  if world.tick() == 90 then world.remove_prat("a") end
end
'''
)"));
  game.rules.OnJoin(0);
  game.rules.OnLeave(1);
  game.Step(10);
  EXPECT_EQ(
      game.commands.said,
      (Lines{"ann joins ann", "bob leaves", "false 'a' and 'b' are not welded",
             "false 'wall' is anchored", "false the push makes 'a' faster than the speed_limit",
             "false 'wall' has no health in the scene",
             "false no value 'colour': health, score, checkpoint, laps, taken, value0 .. "
             "value9",
             "false there is no part 'nothing'"}));
  EXPECT_EQ(game.commands.asked, (Lines{"push 0 1.000000",
                                        "[[part]]\nanchored = true\nbox = [1, 1]\nname = \"new\"\n"
                                        "position = [0, 9.5]\n",
                                        "bond 0 1 5.000000"}));
  EXPECT_EQ(game.OfPlayer(0, kMetaScripts + 3), 4);
  game.commands.said.clear();
  game.Step(100);
  ASSERT_GE(game.commands.said.size(), 4u);
  EXPECT_EQ(game.commands.said[0], "half a true");
  EXPECT_EQ(game.commands.said[1], "half a false");
  // 5.3 m at 6 m/s: contact a tick or two early by the engine's margin.
  EXPECT_EQ(game.commands.said[2].rfind("a wall 5", 0), 0u) << game.commands.said[2];
  const std::string& text = game.world.scene().text;
  const auto typo = text.begin() + static_cast<std::ptrdiff_t>(text.find("remove_prat"));
  const std::string line = std::to_string(1 + std::count(text.begin(), typo, '\n'));
  EXPECT_EQ(game.commands.said.back(), "script s is stopped: g.toml:" + line +
                                           ": attempt to call a nil value (field 'remove_prat')");
}

TEST(Rules, APartMovesWithTheRootOfItsBody) {
  Game game(
      "[[part]]\nname = \"a\"\nbox = [2, 2]\nposition = [1, 2]\nangle = 0.5\nspin = 3\n"
      "velocity = [1, 0]\n[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [4, 2]\n"
      "angle = 0.25\nspin = 3\nvelocity = [1, 0]\n"
      "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\n");
  ASSERT_EQ(game.world.body_count(), 1);
  game.Step(40);
  BodyState a, b;
  ASSERT_TRUE(ReadPart(game.world, 0, &a));
  ASSERT_TRUE(ReadPart(game.world, 1, &b));
  EXPECT_NEAR(a.angle, 0.5 + 3 * 40 / 60.0, 1e-3);
  EXPECT_NEAR(b.angle - a.angle, -0.25, 1e-5);
  const float turn = a.angle - 0.5f;
  EXPECT_NEAR(b.position.x() - a.position.x(), 3 * std::cos(turn), 1e-4);
  EXPECT_NEAR(b.position.y() - a.position.y(), 3 * std::sin(turn), 1e-4);
}

}  // namespace rules_test
}  // namespace seam
