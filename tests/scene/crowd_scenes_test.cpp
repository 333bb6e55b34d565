/// Scenes with many bodies on a seam: each matches its title in a single world.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/gas_room.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace crowd_scenes_test {

TEST(Gas, KeepsItsEnergyForAMinuteAndImpactsCrossTheSeam) {
  ScriptedWorld run("gas");
  ASSERT_EQ(run.world.body_count(), 200);
  const double at_first = KineticEnergy(run.world);
  std::set<std::pair<int, int>> touching;
  int across = 0;
  while (run.world.tick() < 3600) {
    run.Step();
    std::set<std::pair<int, int>> now;
    for (const Touch& t : run.world.touches()) {
      now.insert({t.body_a, t.body_b});
      if (touching.count({t.body_a, t.body_b}) != 0) continue;
      const float a = run.world.Read(t.body_a).position.y();
      across += a * run.world.Read(t.body_b).position.y() < 0 ? 1 : 0;
    }
    touching = std::move(now);
    if (run.world.tick() % 60 != 0) continue;
    ASSERT_NEAR(KineticEnergy(run.world) / at_first, 1, 1e-4) << run.world.tick() / 60 << " s";
  }
  EXPECT_GE(2 * across, 20 * 200) << "two discs each";
  for (int b = 0; b < 200; ++b) {
    const Vec2 at = run.world.Read(b).position;
    EXPECT_TRUE(std::abs(at.x()) < 22 && std::abs(at.y()) < 3) << "a disc is out";
  }
}

TEST(Gas, ALongerRoomHoldsMoreDiscsAndTheirEnergy) {
  std::ifstream in("scenes/gas.toml");
  std::stringstream file;
  file << in.rdbuf();
  EXPECT_EQ(GasRoomText(200), file.str());
  ScriptedWorld run(ParseScene(GasRoomText(500), "gas-500.toml"));
  ASSERT_EQ(run.world.body_count(), 500);
  const double at_first = KineticEnergy(run.world);
  run.StepTo(600);
  EXPECT_NEAR(KineticEnergy(run.world) / at_first, 1, 1e-4);
}

TEST(Heap, BothBladesMoveItAndTheSeamRunsThroughIt) {
  ScriptedWorld run("heap");
  const auto middle = [&run] {
    double sum = 0;
    int left = 0, boxes = 0;
    for (const Part& part : run.world.scene().parts) {
      if (part.name.rfind("box.", 0) != 0) continue;
      const float x = run.Read(part.name).position.x();
      sum += x;
      left += x < 0 ? 1 : 0;
      ++boxes;
    }
    EXPECT_EQ(boxes, 60);
    EXPECT_TRUE(left >= 20 && left <= 40) << left;
    return sum / boxes;
  };
  const auto touched_by = [&run](const char* blade) {
    const int body = run.Body(blade);
    const auto& touches = run.world.touches();
    return std::count_if(touches.begin(), touches.end(),
                         [body](const Touch& t) { return t.body_a == body || t.body_b == body; });
  };
  const double at_first = middle();
  run.StepTo(180);
  EXPECT_GE(touched_by("blade-a"), 2);
  EXPECT_GE(touched_by("blade-b"), 2);
  const double pushed_right = middle();
  EXPECT_GT(pushed_right, at_first + 0.2);
  run.StepTo(285);
  EXPECT_LT(middle(), pushed_right - 0.2) << "ann has drawn back, bob pushes";
}

TEST(Train, CrossesThreeSeamsWithItsCouplingsShutAndPushesTheCratesAhead) {
  ScriptedWorld run("train");
  const Composition& c = run.world.composition();
  ASSERT_EQ(c.mechanisms.size(), 3u) << "the train and two crates";
  for (const Mechanism& m : c.mechanisms) EXPECT_EQ(m.owner, -1);
  const char* const cars[] = {"loco", "wagon-1", "wagon-2", "wagon-3", "wagon-4"};
  double widest = 0;
  bool pushed = false;
  while (run.world.tick() < 720) {
    run.Step();
    for (int i = 0; i < 4; ++i) {
      // Half a metre of buffer at either end; the hinges' own drift is checked as a distance.
      const BodyState front = run.Read(cars[i]), back = run.Read(cars[i + 1]);
      const auto end = [](const BodyState& s, float x) {
        const Vec2 arm(x, -0.1f);
        return Vec2(s.position + Vec2(std::cos(s.angle) * arm.x() - std::sin(s.angle) * arm.y(),
                                      std::sin(s.angle) * arm.x() + std::cos(s.angle) * arm.y()));
      };
      widest = std::max<double>(widest, (end(front, -2.5f) - end(back, 2.5f)).norm());
    }
    const float nose = run.Read("loco").position.x() + 2.3f;
    for (const char* crate : {"crate.0", "crate.1"}) {
      ASSERT_LT(nose, run.Read(crate).position.x() - 0.4f) << "through " << crate;
    }
    pushed |= run.Read("crate.1").velocity.x() > 5;
  }
  EXPECT_LT(widest, 0.02);
  EXPECT_TRUE(pushed);
  EXPECT_LT(ScriptedWorld("train").Read("loco").position.x(), -20) << "all of it begins at ann's";
  for (const char* car : cars) EXPECT_GT(run.Read(car).position.x(), 22) << car;
}

}  // namespace crowd_scenes_test
}  // namespace seam
