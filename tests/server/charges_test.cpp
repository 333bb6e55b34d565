/// Charges: the time and place of each explosion, and which charges a scene may have.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/physics/world.h"
#include "common/scene/charges/charge.h"
#include "server/rules/rules.h"
#include "server/script/script_host.h"

namespace seam {
namespace charges_test {

struct Went {
  std::int64_t tick;
  Vec2 centre;
  float radius, speed, impulse;
};

class Commands : public RoomCommands {
 public:
  explicit Commands(const World& world) : world_(world) {}
  void RemovePart(PartId) override {}
  void BreakJoint(int) override {}
  void Bond(PartId, PartId, float) override {}
  void Push(PartId, const Vec2&) override {}
  void Limp(PartId, float) override {}
  void Blast(const Vec2& centre, float radius, float speed, float impulse) override {
    if (refuses) throw ScriptRefusal("there are too many parts");
    went.push_back({world_.tick(), centre, radius, speed, impulse});
  }
  void LeaveSeat(int) override {}
  void Insert(const std::string&) override {}
  void Say(const Event&) override {}
  void Warn(const std::string& text) override { warned.push_back(text); }
  bool Present(int) const override { return true; }
  Input ReadInput(int) const override { return {}; }

  std::vector<Went> went;
  std::vector<std::string> warned;
  bool refuses = false;

 private:
  const World& world_;
};

struct Room {
  explicit Room(const std::string& text)
      : world(ParseScene("gravity = [0, 0]\n" + text, "c.toml")),
        commands(world),
        rules(world, 1, commands) {}
  void StepTo(std::int64_t tick) {
    while (world.tick() < tick) {
      world.Step();
      rules.AfterTick();
    }
  }
  World world;
  Commands commands;
  Rules rules;
};

const std::string kBall =
    "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [-3, 0]\nvelocity = [6, 0]\n";

TEST(Charges, ExplodeOnceAtTheirTimeAtTheirPart) {
  Room room(kBall +
            "[[charges]]\nname = \"one\"\nposition = [4, 5]\nradius = 3\nimpulse = 7\nat = 0.5\n"
            "[[charges]]\nname = \"two\"\npart = \"ball\"\nposition = [0, 1]\nradius = 2\n"
            "impulse = 9\nat = 1\n");
  EXPECT_TRUE(Rules::Needed(room.world.scene()));
  room.StepTo(29);
  EXPECT_TRUE(room.commands.went.empty());
  room.StepTo(200);
  ASSERT_EQ(room.commands.went.size(), 2u);
  const Went& one = room.commands.went[0];
  const Went& two = room.commands.went[1];
  EXPECT_EQ(one.tick, 30);
  EXPECT_EQ(one.centre, Vec2(4, 5));
  EXPECT_EQ(one.radius, 3);
  EXPECT_EQ(one.impulse, 7);
  EXPECT_EQ(two.tick, 60);
  EXPECT_NEAR(two.centre.x(), 3, 0.01);
  EXPECT_NEAR(two.centre.y(), 1, 0.01);
}

TEST(Charges, ExplodeADelayAfterSomethingEntersTheirTrigger) {
  Room room(kBall +
            "[[trigger]]\nname = \"mine\"\nbox = [2, 2]\nposition = [1, 0]\nfor = \"ball\"\n"
            "[[charges]]\nname = \"c\"\nposition = [1, 0]\nradius = 3\nimpulse = 7\n"
            "trigger = \"mine\"\ndelay = 0.25\n");
  room.StepTo(400);
  ASSERT_EQ(room.commands.went.size(), 1u);
  // 3 m at 6 m/s to the box's side, half a second; then 15 ticks.
  EXPECT_NEAR(static_cast<double>(room.commands.went[0].tick), 30 + 15, 1);
}

TEST(Charges, AChargeThatCannotExplodeWarnsOnceAndEnds) {
  Room room(
      "[[part]]\nname = \"ball\"\ncircle = 0.5\n"
      "[[charges]]\nname = \"c\"\nposition = [4, 5]\nradius = 3\nimpulse = 7\nat = 0.5\n");
  room.commands.refuses = true;
  room.StepTo(100);
  ASSERT_EQ(room.commands.warned.size(), 1u);
  EXPECT_EQ(room.commands.warned[0], "charge c does not go off: there are too many parts");
}

TEST(Charges, AMistakeIsOneLine) {
  const std::string good = "name = \"c\"\nposition = [0, 3]\nradius = 2\nimpulse = 5\nat = 1\n";
  const auto complaint = [](const std::string& charge) -> std::string {
    try {
      ParseScene(kBall + "[[charges]]\n" + charge, "s.toml");
      return "";
    } catch (const OperatorError& e) {
      return e.what();
    }
  };
  EXPECT_EQ(complaint(good), "");
  const std::pair<const char*, const char*> wrong[] = {
      {"name = \"c\"\nposition = [0, 3]\nradius = 11\nimpulse = 5\nat = 1\n", "radius"},
      {"name = \"c\"\nposition = [0, 3]\nradius = nan\nimpulse = 5\nat = 1\n", "radius"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nimpulse = 1e9\nat = 1\n", "impulse"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nimpulse = -1\nat = 1\n", "impulse"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nat = 1\n", "speed or an impulse"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nspeed = 3\nat = 1\n", "no bricks"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nimpulse = 5\n", "'at' or 'trigger'"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nimpulse = 5\nat = 1\ndelay = 2\n", "delay"},
      {"name = \"c\"\nradius = 2\nimpulse = 5\nat = 1\n", "position or a part"},
      {"name = \"c\"\nposition = [0, 3]\nradius = 2\nimpulse = 5\ntrigger = \"x\"\n", "no trigger"},
      {"name = \"c\"\npart = \"x\"\nradius = 2\nimpulse = 5\nat = 1\n", "no part"},
  };
  for (const auto& [charge, what] : wrong) {
    const std::string said = complaint(charge);
    EXPECT_NE(said.find(what), std::string::npos) << charge << said;
    EXPECT_EQ(said.rfind("s.toml:", 0), 0u) << said;
  }
  EXPECT_NE(complaint(good + "[[charges]]\n" + good).find("another charge"), std::string::npos);
}

}  // namespace charges_test
}  // namespace seam
