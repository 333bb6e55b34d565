/// Token buckets: burst, refill rate, and the time spent over budget.

#include "server/sessions/traffic_budget.h"

#include <gtest/gtest.h>

namespace seam {
namespace traffic_budget_test {

TEST(TrafficBudget, AllowsFourTimesAClientsNeedAsDocumented) {
  const TrafficRate honest = HonestTraffic(60, 30), allowed = AllowedTraffic(60, 30);
  EXPECT_EQ(honest.messages, 628);
  EXPECT_NEAR(honest.bytes, 161184, 100);
  EXPECT_EQ(allowed.messages, 4 * honest.messages);
  EXPECT_EQ(allowed.bytes, 4 * honest.bytes);
}

TEST(TrafficBudget, AllowsABurstOfASecondAndTheRateAfterwards) {
  TrafficBudget budget({1000, 100});
  std::int64_t now_us = 5;
  int taken = 0;
  while (budget.Take(now_us, 10, 0)) ++taken;
  EXPECT_EQ(taken, 100);
  for (int n = 0; n < 100; ++n) taken += budget.Take(now_us += 10000, 10, 0) ? 1 : 0;
  EXPECT_EQ(taken, 200);
  now_us += 100000000;
  taken = 0;
  while (budget.Take(now_us, 0, 9)) ++taken;
  EXPECT_EQ(taken, 10) << "the datagram counts as one more; a long pause saves no more";
}

TEST(TrafficBudget, CountsTheTimeBeyondItUntilAPauseOfASecond) {
  TrafficBudget budget({100, 100});
  EXPECT_TRUE(budget.Take(0, 100, 0));
  EXPECT_EQ(budget.over_us(0), 0);
  for (std::int64_t now_us = 100000; now_us <= 5000000; now_us += 100000) {
    EXPECT_FALSE(budget.Take(now_us, 1000, 0));
  }
  EXPECT_EQ(budget.over_us(5000000), 4900000);
  EXPECT_EQ(budget.over_us(5999999), 5899999);
  EXPECT_EQ(budget.over_us(6000000), 0);
  EXPECT_FALSE(budget.Take(7000000, 1000, 0));
  EXPECT_EQ(budget.over_us(7000000), 1);
}

}  // namespace traffic_budget_test
}  // namespace seam
