#include "common/sync/proposal_queue.h"

#include <gtest/gtest.h>

namespace seam {
namespace proposal_queue_test {

Edit BreakOf(std::int32_t joint) { return Edit(BreakEdit{joint}); }

Edit BondOf(PartId a, PartId b, float x) { return Edit(BondEdit{a, b, {x, 0}}); }

TEST(ProposalQueue, ProposesAgainAfterHalfASecondAndNotBefore) {
  for (const int hz : {60, 120}) {
    ProposalQueue queue(hz);
    EXPECT_TRUE(queue.Add(BreakOf(3), 100));
    for (int later = 1; later < hz / 2; ++later) {
      EXPECT_FALSE(queue.Add(BreakOf(3), 100 + later)) << later << " ticks at " << hz << " Hz";
    }
    EXPECT_TRUE(queue.Add(BreakOf(3), 100 + hz / 2));
    EXPECT_FALSE(queue.Add(BreakOf(3), 101 + hz / 2)) << "the time begins anew";
    EXPECT_EQ(queue.Take().size(), 2u);
  }
}

TEST(ProposalQueue, EditsOfOtherJointsOrPartsDoNotWait) {
  ProposalQueue queue(60);
  EXPECT_TRUE(queue.Add(BreakOf(3), 100));
  EXPECT_TRUE(queue.Add(BreakOf(4), 100));
  EXPECT_TRUE(queue.Add(BondOf(1, 2, 0), 101));
  EXPECT_TRUE(queue.Add(BondOf(1, 5, 0), 101));
  EXPECT_FALSE(queue.Add(BondOf(1, 5, 0.5f), 102)) << "the same parts, elsewhere";
}

TEST(ProposalQueue, ReturnsEachProposalOnceInOrder) {
  ProposalQueue queue(60);
  queue.Add(BreakOf(7), 100);
  queue.Add(BreakOf(2), 100);
  const std::vector<FoundEdit> first = queue.Take();
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].edit.As<BreakEdit>()->joint, 7);
  EXPECT_EQ(first[1].edit.As<BreakEdit>()->joint, 2);
  EXPECT_EQ(first[1].tick, 100);
  EXPECT_TRUE(queue.Take().empty());
  EXPECT_FALSE(queue.Add(BreakOf(7), 110)) << "it is remembered after it was taken";
}

}  // namespace proposal_queue_test
}  // namespace seam
