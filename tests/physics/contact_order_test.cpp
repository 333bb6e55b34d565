/// The motion of a pile depends on the pile alone, not on distant bodies.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "common/base/bytes.h"
#include "common/physics/world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace contact_order_test {

/// A ball shoved into a heap of crates; with many more crates around it, which come first, after
/// and in between by their ids.
std::unique_ptr<World> Heap() {
  return SmallWorld(R"(
[[part]]
name = "ground"
chain = [[-400, 20], [-400, 0], [400, 0], [400, 20]]
friction = 0.6
[[part]]
name = "left"
box = [0.7, 0.7]
position = [-300, 0.36]
repeat = {count = [20, 2], step = [1.5, 0.71]}
[[part]]
name = "crate"
box = [0.7, 0.7]
position = [3, 0.36]
density = 0.5
friction = 0.4
repeat = {count = [6, 3], step = [1.1, 0.71]}
[[part]]
name = "right"
circle = 0.35
position = [200, 0.4]
repeat = {count = 40, step = [1.2, 0]}
[[part]]
name = "ball"
circle = 0.5
position = [0, 0.55]
velocity = [9, 0]
density = 5
)");
}

constexpr int kFirst = 40, kPast = 58;  // the crates among the moving bodies
constexpr int kBall = 98;

void SendAway(World* world) {
  for (int body = 0; body < world->body_count(); ++body) {
    const bool far = std::fabs(world->Read(body).position.x()) > 100;
    if (far) world->SetActivity(body, Activity::kDisplayed);
  }
}

TEST(ContactOrder, DoesNotDependOnOtherBodies) {
  const std::unique_ptr<World> whole = Heap(), part = Heap();
  SendAway(part.get());
  for (int tick = 0; tick <= 240; ++tick) {
    if (tick % 2 == 0) {
      whole->Barrier();
      part->Barrier();
    }
    ASSERT_LT(part->present().size(), whole->present().size());
    for (int body = kFirst; body <= kBall; ++body) {
      if (body >= kPast && body < kBall) continue;
      const BodyState a = whole->Read(body), b = part->Read(body);
      ASSERT_EQ(a.position, b.position) << "body " << body << ", tick " << tick;
      ASSERT_EQ(a.angle, b.angle) << "body " << body << ", tick " << tick;
    }
    whole->Step();
    part->Step();
  }
  EXPECT_GT(whole->Read(kFirst).position.x(), 3.5f) << "the ball went into the heap";
}

TEST(ContactOrder, ReplaysTheSameFromABarrierAmongAbsentBodies) {
  const std::unique_ptr<World> whole = Heap(), part = Heap();
  SendAway(part.get());
  const WorldSnapshot snapshot = whole->Barrier();
  part->Barrier();
  Steps(whole.get(), 90);
  Steps(part.get(), 90);  // no barrier in between: contacts that a step finds are in order, too
  EXPECT_EQ(whole->Read(kBall).position, part->Read(kBall).position);
  for (int body = kFirst; body < kPast; ++body) {
    EXPECT_EQ(whole->Read(body).position, part->Read(body).position) << body;
  }
}

/// 48 boxes fall into a heap, and a heavy disc is shot into it; `before` and `after` are other
/// parts of the scene, before and after these.
std::string Pile(const std::string& before, const std::string& after) {
  return before + R"(
[[part]]
name = "g"
chain = [[-90, 0], [90, 0]]
[[part]]
name = "p"
box = [0.5, 0.5]
position = [-2, 2]
angle = 0.1
repeat = {count = [6, 8], step = [0.6, 0.6]}
[[part]]
name = "shot"
circle = 0.4
position = [-30, 1]
velocity = [25, 3]
density = 5
)" + after;
}

/// Links of a chain and discs fall onto a row of anchored boxes.
std::string Yard(const std::string& before, const std::string& after) {
  return before + R"(
[[part]]
name = "g"
box = [2, 1]
position = [-20, -0.5]
anchored = true
repeat = {count = 20, step = [2, 0]}
[[part]]
name = "link"
box = [1, 0.2]
position = [-3, 5]
angle = 0.2
group = -1
repeat = {count = 5, step = [1, 0]}
[[part]]
name = "disc"
circle = 0.3
position = [-3, 1]
repeat = {count = [8, 4], step = [0.7, 0.65]}
[[joint]]
name = "j"
kind = "revolute"
a = "link.0"
b = "link.1"
anchor = [-2.5, 5.1]
repeat = {count = 4, step = [1, 0]}
)" + after;
}

std::string Far(const std::string& name, const std::string& shape) {
  return "[[part]]\nname = \"" + name + "\"\n" + shape + "\n";
}

/// Returns a hash of the poses of the moving parts whose names do not begin with "far".
std::uint64_t HashOfTheNear(const std::string& text) {
  const Scene scene = ParseScene(text, "test.toml");
  World world(scene);
  std::uint64_t hash = Fnv1a("", 0);
  for (int tick = 0; tick < 600; ++tick) {
    world.Step();
    for (int body = 0; body < world.body_count(); ++body) {
      if (scene.parts[static_cast<std::size_t>(world.id(body))].name.rfind("far", 0) == 0) continue;
      const BodyState s = world.Read(body);
      const float numbers[] = {s.position.x(), s.position.y(), s.angle};
      hash = Fnv1a(numbers, sizeof numbers, hash);
    }
  }
  return hash;
}

TEST(ContactOrder, AWorldWithoutBarriersDoesNotDependOnOtherBodies) {
  const std::string box = Far("far", "box = [1, 1]\nposition = [70, 20]\nangle = 0.3");
  const std::string wall = Far("far_wall", "box = [1, 9]\nposition = [80, 4]\nanchored = true");
  const std::string row =
      Far("far_row", "circle = 0.4\nposition = [40, 3]\nrepeat = {count = [9, 3], step = [1, 1]}");
  for (const auto& scene : {Pile, Yard}) {
    const std::uint64_t alone = HashOfTheNear(scene("", ""));
    for (const std::string& far : {box, wall, row, box + wall + row}) {
      EXPECT_EQ(HashOfTheNear(scene(far, "")), alone) << far;
      EXPECT_EQ(HashOfTheNear(scene("", far)), alone) << far;
    }
    EXPECT_EQ(HashOfTheNear(scene(box, row)), alone);
  }
}

/// Three boxes at rest, and a fourth that will fall onto them.
std::unique_ptr<World> Sleepers() {
  const Scene scene = ParseScene(R"(
[[part]]
name = "ground"
chain = [[-40, 0], [40, 0]]
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.51]
repeat = {count = 3, step = [0.1, 1.01]}
[[part]]
name = "hammer"
box = [0.5, 0.5]
position = [20, 0.26]
)",
                                 "test.toml");
  return std::make_unique<World>(scene);
}

/// The hammer is put above the boxes and falls.
void Strike(World* world) {
  BodyState state = world->Read(3);
  state.position = {0.3f, 6};
  world->Write(3, state);
  world->SetAwake(3, true);
}

TEST(ContactOrder, ABarrierOfSleepersEqualsRebuildingThem) {
  const std::unique_ptr<World> saved = Sleepers(), built = Sleepers();
  for (int tick = 0; tick < 400; ++tick) {
    if (tick == 240) {
      for (int body = 0; body < 4; ++body) ASSERT_FALSE(saved->awake(body)) << body;
    }
    if (tick == 301) {
      Strike(saved.get());
      Strike(built.get());
    }
    if (tick % 2 == 0) {
      saved->Barrier();
      ASSERT_TRUE(built->Restore(built->Barrier()).ok());
    }
    ASSERT_EQ(saved->Hash(), built->Hash()) << tick;
    saved->Step();
    built->Step();
  }
  EXPECT_GT(saved->Read(3).position.y(), 0.2f);
  EXPECT_LT(saved->Read(3).position.y(), 5) << "it fell";
}

}  // namespace contact_order_test
}  // namespace seam
