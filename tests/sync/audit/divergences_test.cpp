/// What a peer keeps of the differences between told states and its own.

#include "common/sync/audit/divergences.h"

#include <gtest/gtest.h>

namespace seam {
namespace divergences_test {

BodyState Off(float metres, float mps) {
  BodyState off;
  off.position = Vec2(metres, 0);
  off.velocity = Vec2(0, mps);
  return off;
}

TEST(Divergences, KeepTheGreatestOfEachBodyUntilTheyAreTaken) {
  Divergences divergences;
  divergences.Note(7, 100, 1, Off(0.1f, 0), 0);
  divergences.Note(7, 102, 2, Off(0.3f, 0.2f), 1);
  divergences.Note(7, 104, 1, Off(0.2f, 0), 0);
  divergences.Note(3, 103, 2, Off(0, 2), 0);
  const std::optional<Divergence> told = divergences.Take(5'000'000, 4, 110);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->utime, 5'000'000);
  EXPECT_EQ(told->peer, 4);
  EXPECT_EQ(told->tick, 110);
  EXPECT_EQ(told->more, 0);
  EXPECT_EQ(told->body, (std::vector<std::int32_t>{3, 7}));
  EXPECT_EQ(told->at, (std::vector<std::int64_t>{103, 102}));
  EXPECT_EQ(told->holder, (std::vector<std::int16_t>{2, 2}));
  EXPECT_EQ(told->missing, (std::vector<std::int16_t>{0, 1}));
  EXPECT_EQ(told->apart, (std::vector<float>{0, 0.3f}));
  EXPECT_EQ(told->kick, (std::vector<float>{2, 0.2f}));
  EXPECT_FALSE(divergences.Take(6'000'000, 4, 170));
}

TEST(Divergences, AMessageHasTheGreatestAndCountsTheRest) {
  Divergences divergences;
  for (int id = 0; id < 100; ++id) {
    divergences.Note(id, 10, 1, Off(0.1f + 0.01f * static_cast<float>(id), 0), 0);
  }
  const std::optional<Divergence> told = divergences.Take(0, 0, 10);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->more, 100 - static_cast<int>(kDivergenceMax));
  ASSERT_EQ(told->body.size(), kDivergenceMax);
  EXPECT_EQ(told->body.front(), told->more);
  EXPECT_EQ(told->body.back(), 99);
}

}  // namespace divergences_test
}  // namespace seam
