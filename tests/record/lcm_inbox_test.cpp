/// Messages of other programs: what is refused is counted, and told once for each reason.

#include "common/record/lcm_inbox.h"

#include <gtest/gtest.h>

namespace seam {
namespace lcm_inbox_test {

TEST(LcmInbox, AFloodIsRefusedAndNothingElse) {
  int taken = 0;
  LcmInbox inbox(100, 10, [&](const std::string&, ByteView) {
    ++taken;
    return Status::Ok();
  });
  inbox.SetTime(5000000);
  for (int i = 0; i < 1000; ++i) inbox.Receive("A", {});
  EXPECT_EQ(taken, 10);
  EXPECT_EQ(inbox.refused(), 990);
  for (int i = 0; i < 10; ++i) inbox.Receive("B", {});
  EXPECT_EQ(taken, 20) << "each channel has its own count";
  EXPECT_EQ(inbox.TakeReports(),
            (std::vector<std::string>{"LCM channel A: 1 refused: a message comes too often",
                                      "LCM channel A: 10 refused: a message comes too often",
                                      "LCM channel A: 100 refused: a message comes too often"}));
  // A hundred a second for ten seconds are all taken.
  for (int i = 1; i <= 1000; ++i) {
    inbox.SetTime(5000000 + 10000 * i);
    inbox.Receive("A", {});
  }
  EXPECT_EQ(taken, 1020);
  EXPECT_EQ(inbox.refused(), 990);
}

TEST(LcmInbox, EachReasonIsToldForEachChannel) {
  int n = 0;
  LcmInbox inbox(1e6, 1e6, [&](const std::string&, ByteView) {
    return Status::Error(n++ % 2 == 0 ? "is odd" : "is even");
  });
  for (int i = 0; i < 20; ++i) inbox.Receive(i < 10 ? "A" : "B", {});
  EXPECT_EQ(inbox.refused(), 20);
  EXPECT_EQ(inbox.TakeReports().size(), 4u);
  inbox.Receive("A", {});
  EXPECT_TRUE(inbox.TakeReports().empty());
}

}  // namespace lcm_inbox_test
}  // namespace seam
