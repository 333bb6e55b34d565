#include "server/authority/crowds.h"

#include <gtest/gtest.h>

#include "common/base/random.h"

namespace seam {
namespace {

MovingBox Box(const Vec2& min, const Vec2& max, int group) {
  return {min, max, Vec2(5, 0), 0, group};
}

/// By group, the lowest of those on which it presses, found by comparing all with all.
std::vector<int> PressingSlowly(const std::vector<MovingBox>& boxes, std::size_t groups) {
  std::vector<std::pair<int, int>> pairs;
  for (const MovingBox& a : boxes) {
    for (const MovingBox& b : boxes) {
      if (a.group < b.group && Gap(a, b) <= kPressGap) pairs.emplace_back(a.group, b.group);
    }
  }
  return Components(static_cast<int>(groups), pairs);
}

TEST(Crowds, WhatPressesIsFoundAmongAllPairs) {
  Random random(3);
  std::size_t pressed = 0, alone = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<MovingBox> boxes;
    for (int i = 0; i < 60; ++i) {
      const Vec2 at(static_cast<float>(random.Uniform(0, 24)),
                    static_cast<float>(random.Uniform(0, 6)));
      boxes.push_back(Box(at, at + Vec2(0.5f, 0.5f), i / 2));
    }
    const std::vector<int> lowest = Pressing(boxes, 30);
    EXPECT_EQ(lowest, PressingSlowly(boxes, 30));
    for (std::size_t m = 0; m < lowest.size(); ++m) {
      ++(lowest[m] == static_cast<int>(m) ? alone : pressed);
    }
  }
  EXPECT_GT(pressed, 300u);
  EXPECT_GT(alone, 300u);
}

TEST(Crowds, PressesWhatIsFiveCentimetresAway) {
  EXPECT_EQ(Pressing({Box({0, 0}, {1, 1}, 0), Box({1.06f, 0}, {2, 1}, 1)}, 2),
            (std::vector<int>{0, 1}));
  EXPECT_EQ(Pressing({Box({0, 0}, {1, 1}, 0), Box({1.04f, 0}, {2, 1}, 1)}, 2),
            (std::vector<int>{0, 0}));
}

}  // namespace
}  // namespace seam
