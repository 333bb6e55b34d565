#include "server/authority/plan_ground.h"

#include <gtest/gtest.h>

#include "common/base/random.h"

namespace seam {
namespace plan_ground_test {

MovingBox Box(const Vec2& min, const Vec2& max, int group) {
  return {min, max, Vec2(5, 0), 0, group};
}

/// By group, the lowest group on which it presses, found by comparing all pairs.
std::vector<int> PressingSlowly(const std::vector<MovingBox>& boxes, std::size_t groups) {
  std::vector<std::pair<int, int>> pairs;
  for (const MovingBox& a : boxes) {
    for (const MovingBox& b : boxes) {
      if (a.group < b.group && Gap(a, b) <= kPressGap) pairs.emplace_back(a.group, b.group);
    }
  }
  return Components(static_cast<int>(groups), pairs);
}

TEST(PlanGround, FindsTouchingBodiesAsAllPairsDo) {
  Random random(3);
  std::size_t pressed = 0, alone = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<MovingBox> boxes;
    for (int i = 0; i < 60; ++i) {
      const Vec2 at(static_cast<float>(random.Uniform(0, 24)),
                    static_cast<float>(random.Uniform(0, 6)));
      boxes.push_back(Box(at, at + Vec2(0.5f, 0.5f), i / 2));
    }
    const std::vector<int> lowest = FindTouching(boxes, BoxClusters(boxes), 30).lowest;
    EXPECT_EQ(lowest, PressingSlowly(boxes, 30));
    for (std::size_t m = 0; m < lowest.size(); ++m) {
      ++(lowest[m] == static_cast<int>(m) ? alone : pressed);
    }
  }
  EXPECT_GT(pressed, 300u);
  EXPECT_GT(alone, 300u);
}

std::vector<int> Lowest(const std::vector<MovingBox>& boxes, std::size_t groups) {
  return FindTouching(boxes, BoxClusters(boxes), groups).lowest;
}

TEST(PlanGround, BodiesFiveCentimetresApartTouch) {
  EXPECT_EQ(Lowest({Box({0, 0}, {1, 1}, 0), Box({1.06f, 0}, {2, 1}, 1)}, 2),
            (std::vector<int>{0, 1}));
  EXPECT_EQ(Lowest({Box({0, 0}, {1, 1}, 0), Box({1.04f, 0}, {2, 1}, 1)}, 2),
            (std::vector<int>{0, 0}));
}

TEST(PlanGround, EachPairOfBoxesThatTouchesIsAContact) {
  // Two cars of two boxes, bumper to bumper and one wheel on the other's.
  const std::vector<MovingBox> boxes = {Box({0, 0}, {2, 1}, 0), Box({1, -1}, {2, 0}, 0),
                                        Box({2, 0}, {4, 1}, 1), Box({2, -1}, {3, 0}, 1)};
  const Touching touching = FindTouching(boxes, BoxClusters(boxes), 2);
  EXPECT_EQ(touching.touched.size(), 4u) << "either of one and either of the other";
  EXPECT_EQ(touching.lowest, (std::vector<int>{0, 0}));
}

/// Every box is in one cluster, of its group alone, which is around it and not too long.
void ExpectClusters(const std::vector<MovingBox>& boxes, std::size_t count) {
  const BoxClusters clusters(boxes);
  EXPECT_EQ(clusters.count(), count);
  std::size_t next = 0;
  for (std::size_t c = 0; c < clusters.count(); ++c) {
    EXPECT_EQ(clusters.begin(c), next);
    next = clusters.end(c);
    const MovingBox& around = clusters.around()[c];
    const bool several = clusters.end(c) - clusters.begin(c) > 1;
    if (several) {
      EXPECT_LE((around.max - around.min).maxCoeff(), BoxClusters::kLongest);
    }
    clusters.Each(c, [&](std::size_t i) {
      EXPECT_EQ(boxes[i].group, clusters.GroupOf(c));
      EXPECT_TRUE((boxes[i].min.array() >= around.min.array()).all());
      EXPECT_TRUE((boxes[i].max.array() <= around.max.array()).all());
    });
  }
  EXPECT_EQ(next, boxes.size());
}

TEST(PlanGround, ACarIsOneClusterAndAChainSeveral) {
  ExpectClusters({}, 0);
  ExpectClusters({Box({0, 0}, {3, 1}, 0), Box({0, -1}, {1, 0}, 0), Box({2, -1}, {3, 0}, 0)}, 1);
  ExpectClusters({Box({0, 0}, {1, 1}, 0), Box({0, 0}, {1, 1}, 1), Box({0, 0}, {1, 1}, 0)}, 3);
  std::vector<MovingBox> chain, heap;
  for (int link = 0; link < 12; ++link) {
    const auto x = static_cast<float>(link);
    chain.push_back(Box({x, 0}, {x + 1, 1}, 0));
    heap.push_back(Box({0, 0}, {1, 1}, 0));
  }
  ExpectClusters(chain, 2);                                              // of six metres
  ExpectClusters(heap, 2);                                               // of eight and of four
  ExpectClusters({Box({0, 0}, {40, 1}, 0), Box({0, 0}, {1, 1}, 0)}, 2);  // a plank
}

}  // namespace plan_ground_test
}  // namespace seam
