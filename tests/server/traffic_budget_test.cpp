/// Token buckets: burst, refill rate, and the time spent over budget.

#include "server/sessions/traffic_budget.h"

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "common/sync/edits/edit_order.h"

namespace seam {
namespace traffic_budget_test {

TEST(TrafficBudget, AllowsFourTimesAClientsNeedAsDocumented) {
  const TrafficRate honest = HonestTraffic(60, 30), allowed = AllowedTraffic(60, 30);
  EXPECT_EQ(honest.messages, 628);
  EXPECT_NEAR(honest.bytes, 162672, 100);
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

/// Returns the beginning of a message, which is all that is looked at.
Bytes Named(const std::string& name) {
  Bytes bytes;
  for (const MessageType& type : MessageTypes()) {
    for (int i = 7; type.name == name && i >= 0; --i) {
      bytes.push_back(static_cast<std::uint8_t>(type.hash >> (8 * i)));
    }
  }
  return bytes;
}

/// Counts the messages that are taken when `per_s` a second come for `seconds`.
int Taken(KindBudget* budget, const Bytes& message, int per_s, int seconds) {
  int taken = 0;
  for (int n = 0; n < per_s * seconds; ++n) {
    taken += budget->Take(std::int64_t{1000000} * n / per_s, message) ? 1 : 0;
  }
  return taken;
}

TEST(KindBudget, EachTypeHasARateOfItsOwn) {
  const struct {
    Bytes message;
    double per_s, burst;
  } kinds[] = {{Named("packed_states_t"), 90, 360},
               {Named("states_t"), 90, 360},  // as on the bus, with a session
               {Named("edit_t"), 20, 256},
               {Encode(ToOrder(Edit(BreakEdit{0}))), 20, 256},
               {Named("impact_report_t"), 60, 240},
               {Named("touch_report_t"), 60, 240}};
  for (const auto& kind : kinds) {
    KindBudget budget(30, 10);
    EXPECT_NEAR(Taken(&budget, kind.message, 500, 20), kind.burst + 20 * kind.per_s, 10);
    EXPECT_EQ(Taken(&budget, Named("ping_t"), 500, 1), 500) << "another type is not limited here";
  }
}

TEST(KindBudget, AHolderOfManyBodiesSendsMoreStates) {
  KindBudget budget(30, 640);
  EXPECT_EQ(Taken(&budget, Named("packed_states_t"), 11 * 90, 4), 4 * 11 * 90);
}

}  // namespace traffic_budget_test
}  // namespace seam
