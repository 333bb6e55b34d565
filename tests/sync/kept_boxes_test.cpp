#include "common/sync/reach/kept_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace kept_boxes_test {

MovingBox BoxAt(Random* random, float wide, float side) {
  const Vec2 at(static_cast<float>(random->Uniform(-wide, wide)),
                static_cast<float>(random->Uniform(-20, 20)));
  MovingBox box;
  box.min = at;
  box.max = at + Vec2(side, side);
  return box;
}

TEST(KeptBoxes, FindsEachOverlappingBoxOnceAndNoOther) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    constexpr int kNumbers = 300;
    KeptBoxes kept;
    kept.Clear(kNumbers);
    std::map<int, MovingBox> truth;
    int found_in_all = 0;
    for (int round = 0; round < 60; ++round) {
      for (int i = 0; i < 20; ++i) {
        const int number = static_cast<int>(random.Next() % kNumbers);
        if (random.Chance(0.3)) {
          kept.Take(number);
          truth.erase(number);
        } else {
          const float side = random.Chance(0.05) ? 60 : 1;
          truth[number] = BoxAt(&random, random.Chance(0.05) ? 5000 : 200, side);
          kept.Put(number, truth[number]);
        }
      }
      if (random.Chance(0.5)) kept.Tidy();
      const MovingBox asked = BoxAt(&random, 250, 30);
      std::vector<int> found, expected;
      kept.EachWithin(asked.min, asked.max, [&](int number, const MovingBox& box) {
        found.push_back(number);
        EXPECT_EQ(box.min, truth.at(number).min);
        EXPECT_EQ(kept.at(number).max, truth.at(number).max);
      });
      for (const auto& [number, box] : truth) {
        const bool apart = (box.min.array() > asked.max.array()).any() ||
                           (asked.min.array() > box.max.array()).any();
        if (!apart) expected.push_back(number);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << "seed " << seed << ", round " << round;
      found_in_all += static_cast<int>(found.size());
      for (int number = 0; number < kNumbers; ++number) {
        EXPECT_EQ(kept.Has(number), truth.count(number) == 1);
      }
    }
    EXPECT_GT(found_in_all, 60);
  }
}

}  // namespace kept_boxes_test
}  // namespace seam
