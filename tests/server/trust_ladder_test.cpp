/// Steps of the trust ladder: many doubts in a short time count, few do not; steps end.

#include "server/trust/trust_ladder.h"

#include <gtest/gtest.h>

#include "common/base/state_archive.h"

namespace seam {
namespace trust_ladder_test {

constexpr int kHz = 60;

/// Notes a doubt of this weight `per_s` times a second from `tick` on, for `seconds`. Returns the
/// first tick in which the player may hold nothing; -1: none.
std::int64_t Doubt(TrustLadder* ladder, std::int64_t* tick, int per_s, float weight, int seconds) {
  std::int64_t fell = -1;
  for (const std::int64_t end = *tick + seconds * kHz; *tick < end; ++*tick) {
    if (*tick % (kHz / per_s) == 0) ladder->Note(0, weight);
    ladder->Update(*tick);
    if (fell < 0 && !ladder->MayHold(0, *tick)) fell = *tick;
  }
  return fell;
}

TEST(TrustLadder, FewDoubtsAreForgotten) {
  TrustLadder ladder(2, kHz);
  std::int64_t tick = 0;
  EXPECT_EQ(Doubt(&ladder, &tick, 1, 1, 600), -1);
  EXPECT_LE(ladder.step(0), TrustStep::kNoted);
}

TEST(TrustLadder, ALastingDifferenceIsActedOnWithinThreeSeconds) {
  TrustLadder ladder(2, kHz);
  std::int64_t tick = 0;
  const std::int64_t fell = Doubt(&ladder, &tick, 4, 1, 5);
  EXPECT_GT(fell, kHz) << "one doubt proves nothing";
  EXPECT_LT(fell, 3 * kHz);
  EXPECT_EQ(ladder.step(0), TrustStep::kServerHolds);
  EXPECT_EQ(ladder.step(1), TrustStep::kTrusted);
}

TEST(TrustLadder, AStepEndsByItself) {
  TrustLadder ladder(1, kHz);
  std::int64_t tick = 0;
  const std::int64_t fell = Doubt(&ladder, &tick, 4, 1, 3);
  while (tick < fell + TrustLadder::kHeldS * kHz + 2) ladder.Update(tick++);
  EXPECT_TRUE(ladder.MayHold(0, tick));
  EXPECT_EQ(ladder.step(0), TrustStep::kTrusted);
}

TEST(TrustLadder, TheThirdTimeItHasToLeave) {
  TrustLadder ladder(1, kHz);
  std::int64_t tick = 0;
  for (const TrustStep step : {TrustStep::kServerHolds, TrustStep::kInputsOnly, TrustStep::kOut}) {
    while (!ladder.MayHold(0, tick)) ladder.Update(tick++);
    Doubt(&ladder, &tick, 4, 1, 3);
    EXPECT_EQ(ladder.step(0), step);
    EXPECT_EQ(ladder.InputsOnly(0), step != TrustStep::kServerHolds);
  }
}

TEST(TrustLadder, APlayerThatDidNotLetGoHoldsNothingForHalfAMinute) {
  TrustLadder ladder(1, kHz);
  ladder.NoteWithheld(0, 100);
  EXPECT_FALSE(ladder.MayHold(0, 100));
  EXPECT_FALSE(ladder.MayHold(0, 100 + TrustLadder::kWithheldS * kHz - 1));
  EXPECT_TRUE(ladder.MayHold(0, 100 + TrustLadder::kWithheldS * kHz));
}

TEST(TrustLadder, ASavedLadderGoesOn) {
  TrustLadder ladder(1, kHz), again(1, kHz);
  std::int64_t tick = 0;
  Doubt(&ladder, &tick, 4, 1, 4);
  StateArchive out;
  ladder.Persist(out);
  const Bytes bytes = out.Take();
  StateArchive in(bytes);
  again.Persist(in);
  ASSERT_TRUE(in.ok());
  EXPECT_EQ(again.step(0), ladder.step(0));
  EXPECT_EQ(again.score(0), ladder.score(0));
  for (; tick < 60 * kHz; ++tick) {
    ladder.Update(tick), again.Update(tick);
    ASSERT_EQ(again.MayHold(0, tick), ladder.MayHold(0, tick)) << tick;
  }
}

}  // namespace trust_ladder_test
}  // namespace seam
