/// Active characters that die: the joints that the blow or the blast overloads are torn.

#include "server/rules/tearing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/physics/world.h"
#include "server/rules/rules.h"

namespace seam {
namespace tearing_test {

class Commands : public RoomCommands {
 public:
  void RemovePart(PartId) override {}
  void BreakJoint(int joint) override { broken.push_back(joint); }
  void Bond(PartId, PartId, float) override {}
  void Push(PartId, const Vec2&) override {}
  void Limp(PartId, float) override { ++limp; }
  void LeaveSeat(int) override {}
  void Blast(const Vec2&, float, float, float) override {}
  void Insert(const std::string&) override {}
  void Say(const Event&) override {}
  void Warn(const std::string&) override {}
  bool Present(int) const override { return true; }
  Input ReadInput(int) const override { return {}; }

  std::vector<int> broken;
  int limp = 0;
};

const std::string kMan =
    "gravity = [0, 0]\n[[player]]\nname = \"ann\"\n"
    "[[part]]\nname = \"ground\"\nchain = [[-30, -5], [30, -5]]\n"
    "[[character]]\nname = \"man\"\nkind = \"active\"\nposition = [0, 0]\nhealth = 10\n";

/// A room of one character, and of more things.
struct Room {
  explicit Room(const std::string& more = "")
      : world(ParseScene(kMan + more, "t.toml")), rules(world, 1, commands) {}
  void Step(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      world.Step();
      rules.AfterTick();
    }
  }
  const Part& Limb(CharacterPart limb) const {
    const PartId id = world.scene().characters[0].parts[static_cast<std::size_t>(limb)];
    return world.scene().parts[static_cast<std::size_t>(id)];
  }
  /// Returns the names of the joints that this overloads.
  std::vector<std::string> Torn(const Violence& violence) const {
    const auto read = [this](int body) { return world.Read(body); };
    std::vector<std::string> names;
    for (const int joint : OverloadedJoints(world, world.scene().characters[0], violence, read)) {
      names.push_back(world.scene().joints[static_cast<std::size_t>(joint)].name);
    }
    return names;
  }
  std::vector<std::string> Struck(CharacterPart limb, const Vec2& point, float dv) const {
    return Torn({{{world.BodyOfId(Limb(limb).id), -1, dv, point}}, {}});
  }

  World world;
  Commands commands;
  Rules rules;
};

using Names = std::vector<std::string>;

TEST(Tearing, ABlowTearsTheNearestJointOfThePartThatItStrikes) {
  const Room room;
  EXPECT_EQ(room.Struck(kHead, {0.1f, 1.7f}, 6), Names{"man.neck"});
  EXPECT_EQ(room.Struck(kTorso, {0.1f, 1.6f}, 6), Names{"man.neck"});
  EXPECT_EQ(room.Struck(kLowerLegLeft, {0, 0.5f}, 6), Names{"man.knee-l"});
  EXPECT_EQ(room.Struck(kLowerLegLeft, {0, 0.1f}, 6), Names{"man.ankle-l"});
}

TEST(Tearing, AWeakBlowTearsNothing) {
  EXPECT_EQ(Room().Struck(kHead, {0.1f, 1.7f}, 4), Names{});
  EXPECT_EQ(Room("tears_above = 20\n").Struck(kHead, {0.1f, 1.7f}, 19), Names{});
}

TEST(Tearing, ABlastTearsManyJointsAndNoneBehindAWall) {
  const Violence blast{{}, {{{1, 1}, 6, 0, 40}}};
  EXPECT_GE(Room().Torn(blast).size(), 3u);
  EXPECT_EQ(
      Room("[[part]]\nname = \"wall\"\nbox = [0.1, 6]\nposition = [0.6, 1]\nanchored = true\n")
          .Torn(blast),
      Names{});
  EXPECT_EQ(Room().Torn({{}, {{{1, 1}, 6, 0, 0.1f}}}), Names{});
}

TEST(Tearing, AStrokeThatKillsTearsOneJoint) {
  Room room(
      "[[part]]\nname = \"sword\"\nbox = [1.2, 0.08]\ndensity = 20\nposition = [-3, 1.66]\n"
      "velocity = [15, 0]\nbullet = true\n");
  room.Step(12);
  EXPECT_EQ(room.commands.limp, 1);
  ASSERT_EQ(room.commands.broken.size(), 1u);
  EXPECT_EQ(room.world.scene().joints[static_cast<std::size_t>(room.commands.broken[0])].name,
            "man.neck");
}

TEST(Tearing, ABlastThatAScriptMakesDeadlyTearsMany) {
  Room room(
      "[[script]]\nname = \"s\"\ncode = '''\nfunction on_tick(t)\nif world.tick() == 10 then\n"
      "world.blast(1, 1, 6, 0, 40)\nworld.health(\"man.torso\", -20)\nend\nend\n'''\n");
  room.Step(20);
  EXPECT_EQ(room.commands.limp, 1);
  EXPECT_GE(room.commands.broken.size(), 3u);
}

TEST(Tearing, DeathWithoutABlowOnlyMakesLimp) {
  Room room(
      "[[script]]\nname = \"s\"\ncode = '''\nfunction on_tick(t)\n"
      "if world.tick() == 10 then world.health(\"man.torso\", -20) end\nend\n'''\n");
  room.Step(20);
  EXPECT_EQ(room.commands.limp, 1);
  EXPECT_TRUE(room.commands.broken.empty());
}

}  // namespace tearing_test
}  // namespace seam
