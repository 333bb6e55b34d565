/// Which mechanisms a player drives: each way in which inputs move one, and no other.

#include "common/sync/reach/driven.h"

#include <gtest/gtest.h>

#include <set>

#include "common/physics/part_places.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace driven_test {

const char* const kYard = R"(
[[player]]
name = "ann"
vehicle = "kart"
actions = [{button = 0, part = "drum", impulse = [0, 5]}]
[[player]]
name = "bob"

[[part]]
name = "ground"
chain = [[-90, 0], [90, 0]]
[[part]]
name = "kart"
box = [1, 1]
position = [0, 1]
[[part]]
name = "flag"
box = [1, 1]
position = [4, 1]
owner = "ann"
[[part]]
name = "drum"
box = [1, 1]
position = [8, 1]
[[part]]
name = "arm"
box = [1, 1]
position = [12, 1]
[[part]]
name = "hand"
box = [1, 1]
position = [13, 1]
[[part]]
name = "rocket"
box = [1, 1]
position = [16, 1]
[[part]]
name = "lorry"
box = [1, 1]
position = [20, 1]
[[part]]
name = "wheel"
circle = 0.5
position = [21, 1]
[[part]]
name = "crate"
box = [1, 1]
position = [24, 1]
[[part]]
name = "bike"
box = [1, 1]
position = [28, 1]
[[part]]
name = "mast"
box = [1, 1]
position = [32, 9]

[[character]]
name = "hero"
player = "bob"
owner = "ann"
position = [40, 0]

[[joint]]
name = "elbow"
kind = "hinge"
a = "arm"
b = "hand"
anchor = [12.5, 1]
motor = {player = "ann", axis = "drive", speed = 3, torque = 9}
[[joint]]
name = "axle"
kind = "hinge"
a = "lorry"
b = "wheel"
anchor = [21, 1]
motor = {player = "cab", axis = "drive", speed = 3, torque = 9}
[[joint]]
name = "mill"
kind = "hinge"
a = "ground"
b = "mast"
anchor = [32, 9]
motor = {player = "ann", axis = "lift", speed = 3, torque = 9}

[[thrust]]
name = "jet"
part = "rocket"
force = [5, 0]
player = "ann"
[[thrust]]
name = "engine"
part = "bike"
force = [5, 0]
player = "bob"

[[seat]]
name = "cab"
part = "lorry"
button = 1
)";

class DrivenTest : public testing::Test {
 protected:
  /// Names of the mechanisms' parts that the player drives, of those that the yard names.
  std::set<std::string> Driven(int player, bool actions = false) const {
    const World& world = yard.world;
    const std::vector<bool> driven = DrivenMechanisms(world, player, actions);
    EXPECT_EQ(driven.size(), world.composition().mechanisms.size());
    std::set<std::string> names;
    for (const Part& part : world.scene().parts) {
      const int m = MechanismOf(world, part.id);
      if (m < 0 || !driven[static_cast<std::size_t>(m)]) continue;
      const bool hero = part.name.rfind("hero", 0) == 0;
      names.insert(hero ? "hero" : part.name);
    }
    return names;
  }

  ScriptedWorld yard{ParseScene(kYard, "yard.toml")};
};

using Names = std::set<std::string>;

TEST_F(DrivenTest, APlayerDrivesItsOwnPartsAndThoseItsAxesMove) {
  EXPECT_EQ(Driven(0), (Names{"kart", "flag", "arm", "hand", "rocket", "mast", "hero"}))
      << "vehicle, owned part, motor with all of its mechanism, thrust, motor against the ground";
  EXPECT_EQ(Driven(1), (Names{"bike", "hero"})) << "thrust, and the character that runs for bob";
}

TEST_F(DrivenTest, ButtonsCountOnRequest) {
  EXPECT_EQ(Driven(0).count("drum"), 0u);
  EXPECT_EQ(Driven(0, true).count("drum"), 1u);
  EXPECT_EQ(Driven(1, true).count("drum"), 0u);
}

TEST_F(DrivenTest, ASeatedPlayerDrivesTheSeatsMotors) {
  for (const int player : {0, 1}) EXPECT_EQ(Driven(player).count("lorry"), 0u) << "nobody sits";
  yard.world.Apply({Edit(SeatEdit{0, 1})});
  EXPECT_EQ(Driven(1).count("wheel"), 1u);
  EXPECT_EQ(Driven(0).count("wheel"), 0u);
  yard.world.Apply({Edit(SeatEdit{0, -1})});
  EXPECT_EQ(Driven(1).count("wheel"), 0u);
}

TEST_F(DrivenTest, ARemovedMotorDrivesNothing) {
  ASSERT_EQ(Driven(0).count("hand"), 1u);
  const std::vector<Joint>& joints = yard.world.scene().joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name != "elbow") continue;
    ASSERT_TRUE(yard.world.Apply({Edit(BreakEdit{static_cast<std::int32_t>(j)})}).has_value());
    break;
  }
  EXPECT_EQ(Driven(0).count("hand"), 0u);
  EXPECT_EQ(Driven(0).count("arm"), 0u);
}

}  // namespace driven_test
}  // namespace seam
