/// Which boxes may meet soon, against results by hand and a comparison of all pairs.

#include "common/sync/reach/zones.h"

#include <gtest/gtest.h>

#include <set>

#include "common/base/random.h"

namespace seam {
namespace zones_test {

MovingBox Box(const Vec2& min, const Vec2& max, const Vec2& velocity = {0, 0}, int group = 0) {
  MovingBox box;
  box.min = min;
  box.max = max;
  box.velocity = velocity;
  box.group = group;
  return box;
}

TEST(Zones, TheGapIsTheDistanceOfTheNearestPoints) {
  const MovingBox a = Box({0, 0}, {2, 1});
  EXPECT_FLOAT_EQ(Gap(a, Box({5, 0}, {6, 1})), 3) << "side by side";
  EXPECT_FLOAT_EQ(Gap(a, Box({0, -7}, {2, -2})), 2) << "one below";
  EXPECT_FLOAT_EQ(Gap(a, Box({5, 5}, {6, 6})), 5) << "corner to corner: 3, 4, 5";
  EXPECT_FLOAT_EQ(Gap(a, Box({1, 0.5f}, {9, 9})), 0) << "overlapping";
  EXPECT_FLOAT_EQ(Gap(a, Box({0.5f, 0.2f}, {1, 0.4f})), 0) << "inside";
}

TEST(Zones, TwoMeetWhenTheirRelativeSpeedTakesThemThrough) {
  const MovingBox a = Box({0, 0}, {1, 1}, {6, 0});
  const MovingBox b = Box({11, 0}, {12, 1}, {-4, 0});  // 10 m of gap, 10 m/s
  EXPECT_TRUE(MayMeet(a, b, 1));
  EXPECT_FALSE(MayMeet(a, b, 0.97f));
  MovingBox alike = b;
  alike.velocity = a.velocity;
  EXPECT_FALSE(MayMeet(a, alike, 100)) << "neither comes nearer";
}

TEST(Zones, ADrivenBodyReachesByItsAccelerationToo) {
  MovingBox a = Box({0, 0}, {1, 1});
  MovingBox b = Box({21.1f, 0}, {22, 1});
  EXPECT_FALSE(MayMeet(a, b, 2));
  a.acceleration = kDrivenAcceleration;  // 20 m in 2 s
  EXPECT_TRUE(MayMeet(a, b, 2)) << "with the slack";
  EXPECT_FALSE(MayMeet(a, b, 1.9f));
  a.acceleration = b.acceleration = kDrivenAcceleration / 2;
  EXPECT_TRUE(MayMeet(a, b, 2));
  EXPECT_FALSE(MayMeet(a, b, 1.9f));
}

TEST(Zones, ABodyNearerThanTheSlackTouches) {
  const MovingBox a = Box({0, 0}, {1, 1});
  EXPECT_TRUE(MayMeet(a, Box({1 + 0.9f * kZoneSlack, 0}, {3, 1}), 0));
  EXPECT_FALSE(MayMeet(a, Box({1 + 1.1f * kZoneSlack, 0}, {3, 1}), 0));
}

std::vector<MovingBox> RandomBoxes(Random* random, int count, int groups) {
  std::vector<MovingBox> boxes;
  const auto draw = [&](double from, double to) {
    return static_cast<float>(random->Uniform(from, to));
  };
  for (int i = 0; i < count; ++i) {
    const Vec2 at(draw(-40, 40), draw(-10, 10));
    MovingBox box = Box(at, at + Vec2(draw(0.1, 6), draw(0.1, 3)), {draw(-20, 20), draw(-5, 5)},
                        static_cast<int>(draw(0, groups)));
    if (random->Chance(0.2)) box.acceleration = kDrivenAcceleration;
    boxes.push_back(box);
  }
  return boxes;
}

TEST(Zones, TheSweepFindsThePairsOfAFullComparison) {
  Random random(11);
  std::size_t found = 0, possible = 0;
  for (int round = 0; round < 200; ++round) {
    constexpr int kGroups = 12;
    const std::vector<MovingBox> boxes = RandomBoxes(&random, 30, kGroups);
    const auto longest = static_cast<float>(random.Uniform(0, 0.6));
    const auto seconds_of = [&](int a, int b) {
      EXPECT_NE(a, b);
      return longest * static_cast<float>(1 + (a + b) % 5) / 5;
    };
    std::set<std::pair<int, int>> brute;
    for (const MovingBox& a : boxes) {
      for (const MovingBox& b : boxes) {
        if (a.group >= b.group) continue;
        if (MayMeet(a, b, seconds_of(a.group, b.group))) brute.insert({a.group, b.group});
      }
    }
    const std::vector<std::pair<int, int>> swept = MeetingGroups(boxes, longest, seconds_of);
    const std::vector<std::pair<int, int>> expected(brute.begin(), brute.end());
    EXPECT_EQ(swept, expected) << "round " << round;
    found += brute.size();
    possible += kGroups * (kGroups - 1) / 2;
  }
  EXPECT_GT(found, possible / 10) << "of boxes that never meet nothing is learnt";
  EXPECT_LT(found, possible * 9 / 10);
}

TEST(Zones, OneCommonTimeEqualsATimePerPair) {
  Random random(12);
  const std::vector<MovingBox> boxes = RandomBoxes(&random, 40, 20);
  EXPECT_EQ(MeetingGroups(boxes, 0.3f), MeetingGroups(boxes, 0.3f, [](int, int) { return 0.3f; }));
}

TEST(Zones, NoPairIsCheckedBeyondTheLongestTime) {
  const std::vector<MovingBox> boxes = {Box({0, 0}, {1, 1}, {10, 0}, 0),
                                        Box({11, 0}, {12, 1}, {0, 0}, 1)};
  const auto far = [](int, int) { return 100.0f; };
  EXPECT_EQ(MeetingGroups(boxes, 0.5f, far).size(), 0u);
  EXPECT_EQ(MeetingGroups(boxes, 1.0f, far).size(), 1u);
}

TEST(Zones, ComponentsAreNamedAfterTheirLowestMember) {
  EXPECT_EQ(Components(7, {{5, 6}, {1, 4}, {0, 2}, {2, 4}}),
            (std::vector<int>{0, 0, 0, 3, 0, 5, 5}));
  EXPECT_EQ(Components(3, {}), (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(Components(0, {}).empty());
}

TEST(Zones, ALongChainIsOneComponentInAnyOrderOfLinks) {
  constexpr int kCount = 300;
  Random random(13);
  std::vector<std::pair<int, int>> links;
  for (int i = 1; i < kCount; ++i) links.emplace_back(i - 1, i);
  for (std::size_t i = links.size(); i > 1; --i) {
    const auto other = static_cast<std::size_t>(random.Uniform(0, static_cast<double>(i)));
    std::swap(links[i - 1], links[std::min(other, i - 1)]);
  }
  EXPECT_EQ(Components(kCount, links), std::vector<int>(kCount, 0));
}

}  // namespace zones_test
}  // namespace seam
