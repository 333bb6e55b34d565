/// When a standby takes a room from its holder, in virtual time.

#include "server/fleet/take_over_rule.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "common/base/random.h"
#include "tests/support/soak.h"

namespace seam {
namespace take_over_rule_test {

constexpr std::int64_t kRoundUs = 50000;

/// A standby that looks each 50 ms, and players that knock each 100 ms.
struct Standby {
  /// Lets `us` pass; returns the time after which the room is due, -1: it is not.
  std::int64_t Run(std::int64_t us, const std::function<bool(std::int64_t)>& lives,
                   const std::set<int>& knocking) {
    for (const std::int64_t begin_us = now_us; now_us < begin_us + us; now_us += kRoundUs) {
      rule.NoteLook(now_us, lives(now_us), 0);
      for (const int player : knocking) {
        if (now_us % 100000 == 0) rule.NoteKnock(now_us, player);
      }
      if (rule.Due(now_us, present)) return now_us - begin_us;
    }
    return -1;
  }

  TakeOverRule rule;
  std::vector<int> present = {0, 1, 2, 3};
  std::int64_t now_us = 100000000;
};

bool Lives(std::int64_t) { return true; }
bool IsDead(std::int64_t) { return false; }

TEST(TakeOverRule, ASilentHolderAndHalfOfItsPlayersAreEnough) {
  Standby standby;
  EXPECT_EQ(standby.Run(3000000, Lives, {}), -1);
  const std::int64_t after_us = standby.Run(3000000, IsDead, {1, 3});
  EXPECT_GE(after_us, TakeOverRule::kHolderSilentUs - kRoundUs);
  EXPECT_LE(after_us, TakeOverRule::kHolderSilentUs + 2 * kRoundUs);
}

TEST(TakeOverRule, AHolderThatWasNeverSeenLiveKeepsItsRoom) {
  Standby standby;  // its folder is a copy: it looks at another log
  EXPECT_EQ(standby.Run(60000000, IsDead, {0, 1, 2, 3}), -1);
}

TEST(TakeOverRule, SilenceAloneIsNotEnough) {
  Standby standby;
  standby.Run(1000000, Lives, {});
  EXPECT_EQ(standby.Run(60000000, IsDead, {}), -1);
  EXPECT_EQ(standby.Run(60000000, IsDead, {2}), -1) << "one of four";
  standby.present.clear();
  EXPECT_EQ(standby.Run(60000000, IsDead, {2}), -1) << "of no players";
}

TEST(TakeOverRule, KnocksAloneAreNotEnoughHoweverManyAndOften) {
  Standby standby;
  EXPECT_EQ(standby.Run(60000000, Lives, {0, 1, 2, 3}), -1);
  // Its log stands still for 0.4 s again and again.
  const auto seldom = [](std::int64_t now_us) { return now_us % 400000 == 0; };
  EXPECT_EQ(standby.Run(60000000, seldom, {0, 1, 2, 3}), -1);
}

TEST(TakeOverRule, KnocksFromBeforeTheSilenceCountNoMore) {
  Standby standby;
  standby.Run(1000000, Lives, {0, 1, 2, 3});  // half of them were cut off for a while
  EXPECT_EQ(standby.Run(10000000, IsDead, {}), -1);
}

TEST(TakeOverRule, KnocksAreForgottenWhenTheyEnd) {
  Standby standby;
  standby.Run(1000000, Lives, {});
  EXPECT_EQ(standby.Run(400000, IsDead, {0}), -1);
  EXPECT_EQ(standby.Run(1500000, IsDead, {}), -1);
  EXPECT_EQ(standby.Run(10000000, IsDead, {1}), -1) << "never two of four within a second";
}

TEST(TakeOverRule, AStandbyThatStoodStillItselfBeginsToWatchAnew) {
  Standby standby;
  standby.Run(1000000, Lives, {});
  standby.now_us += 10000000;  // SIGSTOP, then CONT; the holder lives, but was not seen yet
  EXPECT_EQ(standby.Run(TakeOverRule::kHolderSilentUs, IsDead, {0, 1, 2, 3}), -1);
  standby.Run(100000, Lives, {});
  // It opens a room for 0.4 s meanwhile: that is no pause.
  standby.now_us += 400000;
  standby.rule.NoteLook(standby.now_us, false, 390000);
  EXPECT_LE(standby.Run(1000000, IsDead, {0, 1, 2, 3}), 2 * kRoundUs + 50000);
}

TEST(TakeOverRule, AHolderThatLivesIsNeverDueWhateverTheTimes) {
  const int seeds = Soak(10000);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    TakeOverRule rule;
    std::int64_t now_us = 1000000, wrote_us = now_us, next_us = now_us, seen_us = 0;
    const std::vector<int> present = {0, 1};
    for (int look = 0; look < 60; ++look) {
      // The standby looks when the machine lets it; the holder writes at least each 0.45 s.
      now_us += static_cast<std::int64_t>(random.Next() % 600000);
      while (next_us <= now_us) {
        wrote_us = next_us;
        next_us += 1 + static_cast<std::int64_t>(random.Next() % 450000);
      }
      rule.NoteLook(now_us, wrote_us > seen_us, 0);
      seen_us = now_us;
      for (const int player : present) rule.NoteKnock(now_us, player);
      ASSERT_FALSE(rule.Due(now_us, present)) << "seed " << seed;
    }
  }
}

}  // namespace take_over_rule_test
}  // namespace seam
