/// Still bodies: every change of one is reported to callers that cache it.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/base/random.h"
#include "common/physics/world.h"

namespace seam {
namespace world_still_test {

const char* const kBoxes = R"(
[[player]]
name = "ann"
[[part]]
name = "ground"
chain = [[-50, 0], [100, 0]]
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.5]
repeat = {count = 24, step = [1.5, 0]}
)";

std::vector<std::uint64_t> StillOf(const World& world) {
  std::vector<std::uint64_t> all;
  for (int body = 0; body < world.body_count(); ++body) all.push_back(world.still(body));
  return all;
}

/// One of the things that are done to a world, drawn.
void DoSomething(World* world, Random* random) {
  const int body = static_cast<int>(random->Next() % 24);
  switch (random->Next() % 8) {
    case 0: world->SetActivity(body, Activity::kDisplayed); break;
    case 1: world->SetActivity(body, Activity::kSimulated); break;
    case 2: world->SetAwake(body, random->Chance(0.5)); break;
    case 3: {
      BodyState state = world->Read(body);
      state.position.x() += static_cast<float>(random->Uniform(-0.1, 0.1));
      world->Write(body, state, random->Chance(0.5));
      break;
    }
    case 4: {
      BodyState state = world->Read(body);
      state.velocity = Vec2(0.5f, 0);
      world->Write(body, state);
      break;
    }
    case 5: world->Settle(); break;
    case 6: {
      const WorldSnapshot snapshot = world->Barrier();
      world->Step();
      EXPECT_TRUE(world->Restore(snapshot).ok());
      break;
    }
    default:
      for (int i = 0; i < 5; ++i) world->Step();
      break;
  }
}

TEST(WorldStill, ReportsEveryChangeOfAStillBody) {
  int told = 0, still = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    World world(ParseScene(kBoxes, "boxes.toml"));
    Random random(seed);
    std::vector<std::uint64_t> before = StillOf(world);
    std::uint64_t change = world.last_change();
    for (int round = 0; round < 200; ++round) {
      for (int i = static_cast<int>(random.Next() % 4); i >= 0; --i) DoSomething(&world, &random);
      const std::vector<std::uint64_t> now = StillOf(world);
      std::vector<int> changed;
      if (world.ChangedSince(change, &changed)) {
        ++told;
        for (int body = 0; body < world.body_count(); ++body) {
          const auto i = static_cast<std::size_t>(body);
          still += now[i] != 0 ? 1 : 0;
          // Bodies that were not still are checked anyway.
          if (before[i] == 0 || now[i] == before[i]) continue;
          EXPECT_EQ(std::count(changed.begin(), changed.end(), body) > 0, true)
              << "seed " << seed << ", round " << round << ", body " << body;
        }
      } else {
        EXPECT_TRUE(changed.empty());
      }
      before = now;
      change = world.last_change();
    }
  }
  EXPECT_GT(told, 2000);
  EXPECT_GT(still, 2000);
}

TEST(WorldStill, ForgetsChangesTooLongAgo) {
  World world(ParseScene(kBoxes, "boxes.toml"));
  world.SetActivity(3, Activity::kDisplayed);
  world.Step();
  const std::uint64_t change = world.last_change();
  std::vector<int> changed;
  EXPECT_TRUE(world.ChangedSince(change, &changed));
  EXPECT_TRUE(changed.empty());
  BodyState state = world.Read(3);
  for (int i = 0; i < 2000; ++i) {
    state.position.x() += 0.001f;
    world.Write(3, state, false);
  }
  EXPECT_FALSE(world.ChangedSince(change, &changed));
  EXPECT_TRUE(changed.empty());
  world.Write(3, BodyState{}, false);
  EXPECT_TRUE(world.ChangedSince(world.last_change() - 1, &changed));
  EXPECT_EQ(changed, std::vector<int>{3});
}

}  // namespace world_still_test
}  // namespace seam
