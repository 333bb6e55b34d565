/// LoneWorld: inputs, writes, and saved states that continue bit for bit.

#include "client/embed/lone_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace seam {
namespace lone_world_test {

const char* const kCar = R"(
[[player]]
name = "ann"
vehicle = "car"
actions = [{button = 0, part = "car", impulse = [0, 20]}]
[[part]]
name = "ground"
chain = [[-80, 0], [80, 0]]
[[part]]
name = "car"
box = [2, 0.5]
position = [0, 1]
[[part]]
name = "left"
circle = 0.4
position = [-0.7, 0.5]
[[part]]
name = "right"
circle = 0.4
position = [0.7, 0.5]
[[joint]]
name = "driven"
kind = "wheel"
a = "car"
b = "left"
motor = { player = "ann", axis = "drive", speed = 20, torque = 20 }
[[joint]]
name = "free"
kind = "wheel"
a = "car"
b = "right"
)";

Scene FileScene(const std::string& name) { return LoadScene("scenes/" + name + ".toml"); }

/// Inputs that differ from tick to tick.
Input InputAt(std::int64_t tick) {
  const auto drive = static_cast<std::int8_t>(tick % 90 < 60 ? 100 : -100);
  return {drive, 0, static_cast<std::int16_t>(tick % 40 < 3 ? 1 : 0)};
}

void Drive(LoneWorld* world, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    for (int player = 0; player < world->player_count(); ++player) {
      ASSERT_TRUE(world->SetInput(player, InputAt(world->world().tick() + 7 * player)).ok());
    }
    world->Step(1);
  }
}

TEST(LoneWorld, APlayersInputMovesTheCarAndAPressActsOnce) {
  LoneWorld world(ParseScene(kCar, "car.toml"));
  world.Step(60);
  const int car = world.world().BodyOfId(1);
  const float before = world.world().Read(car).position.x();
  ASSERT_TRUE(world.SetInput(0, {127, 0, 0}).ok());
  world.Step(60);
  EXPECT_GT(std::abs(world.world().Read(car).position.x() - before), 0.5);
  ASSERT_TRUE(world.SetInput(0, {0, 0, 1}).ok());
  const float vy = world.world().Read(car).velocity.y();
  world.Step(1);
  const float after = world.world().Read(car).velocity.y();
  EXPECT_GT(after, vy + 5);
  world.Step(1);
  EXPECT_LT(world.world().Read(car).velocity.y(), after);
  EXPECT_FALSE(world.SetInput(1, {}).ok());
  EXPECT_FALSE(world.SetInput(-1, {}).ok());
}

/// Scenes with joints and motors, glue that breaks, characters and a stack.
class LoneWorldSaved : public ::testing::TestWithParam<const char*> {};

TEST_P(LoneWorldSaved, ContinuesWithTheSameBitsInAnotherWorld) {
  const Scene scene = FileScene(GetParam());
  LoneWorld one(scene), other(scene);
  Drive(&one, 150);
  Drive(&other, 20);  // its own past is forgotten
  const Bytes saved = one.Save();
  ASSERT_TRUE(other.Load(saved).ok());
  EXPECT_EQ(other.world().tick(), one.world().tick());
  EXPECT_EQ(other.world().Hash(), one.world().Hash());
  Drive(&one, 120);
  Drive(&other, 120);
  EXPECT_EQ(other.world().Hash(), one.world().Hash());
  ASSERT_TRUE(one.Load(saved).ok());  // back in its own past
  Drive(&one, 120);
  EXPECT_EQ(other.world().Hash(), one.world().Hash());
}

INSTANTIATE_TEST_SUITE_P(Scenes, LoneWorldSaved,
                         ::testing::Values("crossing", "wall", "relay", "playground", "arena"));

TEST(LoneWorld, ResetIsTheSameAsANewWorld) {
  const Scene scene = FileScene("wall");
  LoneWorld one(scene), fresh(scene);
  Drive(&one, 200);
  one.Reset();
  Drive(&one, 50);
  Drive(&fresh, 50);
  EXPECT_EQ(one.world().Hash(), fresh.world().Hash());
}

TEST(LoneWorld, WritesWhatIsFiniteAndRefusesAllElse) {
  LoneWorld world(ParseScene(kCar, "car.toml"));
  BodyState state;
  state.position = {3, 4};
  state.angle = 0.5f;
  state.velocity = {1, -2};
  ASSERT_TRUE(world.Write(1, state).ok());
  EXPECT_EQ(world.world().Read(world.world().BodyOfId(1)).position, state.position);
  EXPECT_EQ(world.world().Read(world.world().BodyOfId(1)).velocity, state.velocity);
  EXPECT_FALSE(world.Write(0, state).ok()) << "the ground does not move";
  EXPECT_FALSE(world.Write(99, state).ok());
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {infinity, -infinity, std::nanf(""), 1e30f}) {
    for (float* number : {&state.position[0], &state.position[1], &state.angle, &state.velocity[0],
                          &state.velocity[1], &state.spin}) {
      const float good = *number;
      *number = bad;
      EXPECT_FALSE(world.Write(1, state).ok()) << bad;
      *number = good;
    }
  }
  world.Step(60);
}

TEST(LoneWorld, DamagedBytesAndThoseOfAnotherSceneChangeNothing) {
  LoneWorld world(FileScene("wall")), other(FileScene("relay"));
  Drive(&world, 30);
  const std::uint64_t before = world.world().Hash();
  EXPECT_FALSE(world.Load(other.Save()).ok());
  const Bytes saved = world.Save();
  for (std::size_t size = 0; size < saved.size(); size += 1 + size / 8) {
    EXPECT_FALSE(world.Load({saved.data(), size}).ok()) << size;
  }
  for (std::size_t at = 0; at < saved.size(); at += 1 + at / 8) {
    Bytes damaged = saved;
    damaged[at] ^= 0x10;
    EXPECT_FALSE(world.Load(damaged).ok()) << at;
  }
  EXPECT_EQ(world.world().Hash(), before);
  // With a hash that fits, the contents are looked at all the same.
  int refused = 0;
  for (std::size_t at = 32; at < saved.size(); at += 1 + at / 8) {
    Bytes forged = saved;
    forged[at] ^= 0x80;
    const std::uint64_t hash = Fnv1a(forged.data() + 32, forged.size() - 32);
    std::memcpy(forged.data() + 24, &hash, sizeof hash);
    LoneWorld victim(FileScene("wall"));
    refused += victim.Load(forged).ok() ? 0 : 1;
    victim.Step(5);
  }
  EXPECT_GT(refused, 5);
}

}  // namespace lone_world_test
}  // namespace seam
