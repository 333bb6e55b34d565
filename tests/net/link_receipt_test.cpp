/// Receipts of a Link: which unreliable messages have arrived.

#include <gtest/gtest.h>

#include <vector>

#include "common/net/link.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace link_receipt_test {

constexpr std::uint64_t kSession = 7;

std::vector<Bytes> Drain(Link& link, std::int64_t now_us) {
  std::vector<Bytes> datagrams;
  link.Flush(now_us, [&](ByteView d) { datagrams.emplace_back(d.begin(), d.end()); });
  return datagrams;
}

TEST(LinkReceipts, ReportTheLargestNumberThatArrivedInEachSlot) {
  Link here(LinkKeys(kSession)), there(LinkKeys(kSession, true));
  const Bytes message = {1, 2, 3};
  const auto ignore = [](ByteView) {};
  EXPECT_EQ(here.acked(0), -1);
  std::int64_t now_us = 0;
  std::vector<Bytes> sent;
  for (const std::int64_t number : {5, 6, 7}) {
    here.SendUnreliable(message, {{0, number}});
    here.SendUnreliable(message, {{1, number * 10}});
    here.SendUnreliable(message);
    sent.push_back(Drain(here, now_us += 1000).at(0));
  }
  const auto answer = [&](std::size_t datagram) {
    now_us += 1000;
    there.Receive(now_us, sent[datagram], ignore);
    there.SendUnreliable(message);
    here.Receive(now_us, Drain(there, now_us).at(0), ignore);
  };
  EXPECT_EQ(here.acked(0), -1) << "sent is not arrived";
  answer(1);
  EXPECT_EQ(here.acked(0), 6);
  EXPECT_EQ(here.acked(1), 60);
  EXPECT_EQ(here.acked(2), -1);
  answer(0);
  EXPECT_EQ(here.acked(0), 6) << "an older one does not take it back";
  answer(2);
  EXPECT_EQ(here.acked(1), 70);
}

TEST(LinkReceipts, OneMessageMayHaveSeveralReceipts) {
  Link here(LinkKeys(kSession)), there(LinkKeys(kSession, true));
  const Bytes message = {1, 2, 3};
  here.SendUnreliable(message, {{3, 30}, {0, 7}, {255, 9}});
  there.Receive(1000, Drain(here, 1000).at(0), [](ByteView) {});
  EXPECT_EQ(here.acked(0), -1) << "sent is not arrived";
  there.SendUnreliable(message);
  here.Receive(2000, Drain(there, 2000).at(0), [](ByteView) {});
  EXPECT_EQ(here.acked(3), 30);
  EXPECT_EQ(here.acked(0), 7);
  EXPECT_EQ(here.acked(255), 9);
  EXPECT_EQ(here.acked(1), -1);
}

TEST(LinkReceipts, SendsIsTrueIfAFlushWouldSend) {
  Link link(LinkKeys(kSession));
  const Bytes message = {1};
  EXPECT_TRUE(link.Sends(0)) << "the first datagram";
  for (std::int64_t now_us = 0; now_us < 3000000; now_us += 7000) {
    if (now_us == 70000) link.SendUnreliable(message);
    if (now_us == 700000) link.SendReliable(message);  // nobody answers: it is repeated
    const bool sends = link.Sends(now_us);
    EXPECT_EQ(sends, !Drain(link, now_us).empty()) << now_us;
    EXPECT_FALSE(link.Sends(now_us)) << "all is sent";
  }
}

TEST(LinkReceipts, KnowsUntilWhenItsMessagesHaveBeenSent) {
  Link link(LinkKeys(kSession, false));
  EXPECT_EQ(link.SentUntilUs(1000), 1000) << "there was nothing to send";
  for (const std::int64_t us : {2000, 3000}) {
    ASSERT_TRUE(link.SendReliable(Bytes{1, 2, 3}));
    EXPECT_EQ(link.SentUntilUs(us), 1000);
  }
  link.Flush(
      100'000, [](ByteView) {}, 1);  // one message
  EXPECT_EQ(link.SentUntilUs(4000), 2000);
  link.Flush(
      100'000, [](ByteView) {}, 1);
  EXPECT_EQ(link.SentUntilUs(5000), 5000) << "all are on their way";
}

}  // namespace link_receipt_test
}  // namespace seam
