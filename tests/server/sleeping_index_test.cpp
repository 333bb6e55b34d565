/// SleepingIndex: a plan without distant sleepers equals the full plan, entry by entry.

#include "server/authority/sleeping_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/random.h"
#include "server/authority/plan.h"
#include "tests/lab/world/plan_worlds.h"

namespace seam {
namespace sleeping_index_test {

/// Puts most undriven mechanisms to sleep as the server's. Returns, by mechanism, 1 for sleepers.
std::vector<char> LayDown(std::uint64_t seed, AuthorityView* view) {
  Random random(seed);
  std::vector<char> lies;
  for (MechanismView& mechanism : view->mechanisms) {
    lies.push_back(mechanism.owner < 0 && random.Uniform() < 0.85 ? 1 : 0);
    if (lies.back() == 0) continue;
    mechanism.moves = false;
    mechanism.asleep = true;
    mechanism.now = {};
  }
  for (MovingBox& box : view->boxes) {
    if (lies[static_cast<std::size_t>(box.group)] != 0) box.velocity.setZero();
  }
  return lies;
}

MovingBox Around(const AuthorityView& view, int mechanism) {
  MovingBox around;
  bool first = true;
  for (const MovingBox& box : view.boxes) {
    if (box.group != mechanism) continue;
    around.min = first ? box.min : around.min.cwiseMin(box.min);
    around.max = first ? box.max : around.max.cwiseMax(box.max);
    first = false;
  }
  return around;
}

/// Mechanisms that the plan has to see, ascending.
std::vector<int> Seen(const AuthorityView& view, const std::vector<char>& lies,
                      SleepingIndex* lying) {
  std::vector<int> seen;
  std::vector<MovingBox> boxes;
  for (int m = 0; m < static_cast<int>(lies.size()); ++m) {
    if (lies[static_cast<std::size_t>(m)] == 0) seen.push_back(m);
  }
  for (const MovingBox& box : view.boxes) {
    if (lies[static_cast<std::size_t>(box.group)] == 0) boxes.push_back(box);
  }
  const std::vector<int> near = lying->Near(boxes, SightOf(view));
  seen.insert(seen.end(), near.begin(), near.end());
  std::sort(seen.begin(), seen.end());
  return seen;
}

AuthorityView Of(const AuthorityView& whole, const std::vector<int>& seen) {
  AuthorityView view = whole;
  view.mechanisms.clear();
  view.boxes.clear();
  for (const int m : seen) view.mechanisms.push_back(whole.mechanisms[static_cast<std::size_t>(m)]);
  for (MovingBox box : whole.boxes) {
    const auto at = std::lower_bound(seen.begin(), seen.end(), box.group);
    if (at == seen.end() || *at != box.group) continue;
    box.group = static_cast<int>(at - seen.begin());
    view.boxes.push_back(box);
  }
  view.left_out = whole.boxes.size() - view.boxes.size();
  return view;
}

struct Counts {
  int differ = 0, left_out = 0, given = 0;
};

/// Over random rooms: differing entries of the plans, omitted sleepers, and sleepers that were
/// granted or followed.
Counts Compare(PlanWorld world, int seeds) {
  world.regions = false;
  Counts counts;
  for (int seed = 1; seed <= seeds; ++seed) {
    AuthorityView whole = RandomView(world, static_cast<std::uint64_t>(seed));
    const std::vector<char> lies = LayDown(static_cast<std::uint64_t>(seed), &whole);
    SleepingIndex lying;
    lying.Clear(lies.size());
    for (int m = 0; m < static_cast<int>(lies.size()); ++m) {
      if (lies[static_cast<std::size_t>(m)] != 0) lying.Put(m, Around(whole, m));
    }
    const std::vector<int> seen = Seen(whole, lies, &lying);
    const AuthorityPlan all = PlanAuthority(whole), part = PlanAuthority(Of(whole, seen));
    std::size_t next = 0;
    for (std::size_t m = 0; m < all.size(); ++m) {
      const bool sees = next < seen.size() && seen[next] == static_cast<int>(m);
      const PlannedAuthority planned = sees ? part[next++] : PlannedAuthority{};
      const bool same = planned.authority == all[m].authority &&
                        planned.secondaries == all[m].secondaries &&
                        planned.decided == all[m].decided;
      counts.differ += same ? 0 : 1;
      counts.left_out += sees ? 0 : 1;
      const bool given = all[m].authority != 0 || !all[m].secondaries.empty();
      counts.given += given && lies[m] != 0 ? 1 : 0;
    }
  }
  return counts;
}

PlanWorld Room(int players, int mechanisms, float width, float height) {
  PlanWorld world;
  world.players = players;
  world.mechanisms = mechanisms;
  world.width = width;
  world.height = height;
  world.follow_bodies = world.server_follow = 30;
  return world;
}

TEST(SleepingIndex, APlanWithoutDistantSleepersEqualsTheFullPlan) {
  for (const PlanWorld& world : {Room(3, 400, 3000, 60), Room(6, 500, 900, 900),
                                 Room(16, 600, 1500, 40), Room(1, 300, 400, 400)}) {
    SCOPED_TRACE(std::to_string(world.players) + " players");
    const Counts counts = Compare(world, 25);
    EXPECT_EQ(counts.differ, 0);
    EXPECT_GT(counts.left_out, 500) << "something is left out";
    EXPECT_GT(counts.given, 20) << "and something that lies is near";
  }
}

TEST(SleepingIndex, MatchesTheFullPlanInACrowdAndFindsNothingWithoutMovers) {
  const Counts crowd = Compare(Room(20, 400, 70, 70), 15);
  EXPECT_EQ(crowd.differ, 0);
  SleepingIndex lying;
  lying.Clear(500);
  for (int m = 0; m < 500; ++m) {
    MovingBox box;
    box.min = {static_cast<float>(m), 0};
    box.max = box.min + Vec2(1, 1);  // each touches the next
    lying.Put(m, box);
  }
  EXPECT_TRUE(lying.Near({}, {1, 8}).empty());
  MovingBox car;
  car.min = {-2, 0};
  car.max = {-1, 1};
  EXPECT_EQ(lying.Near({car}, {1, 0.2f}).size(), 0u) << "0.25 m and its rounding from it";
  car.velocity = {2, 0};
  EXPECT_EQ(lying.Near({car}, {1, 0.2f}).size(), 500u) << "a blow goes through all of them";
}

/// Under insertions and removals it finds the same as an exhaustive search.
TEST(SleepingIndex, FindsTheSameAfterAnyHistory) {
  Random random(7);
  SleepingIndex lying;
  constexpr int kCount = 600;
  lying.Clear(kCount);
  std::vector<MovingBox> boxes(kCount);
  const auto somewhere = [&](float half) {
    MovingBox box;
    const Vec2 at(static_cast<float>(random.Uniform()) * 400,
                  static_cast<float>(random.Uniform()) * 400);
    box.min = at - Vec2(half, half);
    box.max = at + Vec2(half, half);
    return box;
  };
  int found = 0;
  for (int round = 0; round < 60; ++round) {
    for (int k = 0; k < 25; ++k) {
      const int m = static_cast<int>(random.Uniform() * kCount);
      lying.Take(m);
      if (random.Uniform() < 0.3) continue;
      boxes[static_cast<std::size_t>(m)] = somewhere(m % 40 == 0 ? 9.0f : 0.4f);
      lying.Put(m, boxes[static_cast<std::size_t>(m)]);
    }
    const MovingBox from = somewhere(1);
    const std::vector<int> near = lying.Near({from}, {0, 30});
    for (int m = 0; m < kCount; ++m) {
      const bool is = std::binary_search(near.begin(), near.end(), m);
      const float gap = Gap(boxes[static_cast<std::size_t>(m)], from);
      if (!lying.Has(m)) {
        EXPECT_FALSE(is);
      } else if (gap <= 30) {
        EXPECT_TRUE(is) << m << " of round " << round;
        ++found;
      } else if (gap > 120) {
        EXPECT_FALSE(is) << "that is far";
      }
    }
  }
  EXPECT_GT(found, 200);
}

}  // namespace sleeping_index_test
}  // namespace seam
