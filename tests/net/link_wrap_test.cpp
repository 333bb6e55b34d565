/// Sixteen bits on the wire, many more in the session: numbers and ids wrap, and nothing is lost or
/// delivered twice.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "common/base/random.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/sequence_window.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace link_wrap_test {

constexpr std::uint64_t kSession = 77;

Bytes Number(std::uint32_t number) {
  Bytes bytes(sizeof number);
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::uint32_t NumberOf(ByteView bytes) {
  std::uint32_t number = 0;
  if (bytes.size == sizeof number) std::memcpy(&number, bytes.data, sizeof number);
  return number;
}

/// A path that loses, doubles and reorders datagrams of any content.
class Path {
 public:
  explicit Path(std::uint64_t seed) : random_(seed) {}

  void Send(ByteView datagram) {
    ++sent;
    if (random_.Chance(0.1)) return;
    const int copies = random_.Chance(0.05) ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy) {
      waiting_.emplace_back(datagram.begin(), datagram.end());
      // Some wait for up to 20 that come later.
      if (random_.Chance(0.2)) {
        const std::size_t back = std::min<std::size_t>(waiting_.size() - 1, random_.Next() % 20);
        std::swap(waiting_.back(), waiting_[waiting_.size() - 1 - back]);
      }
    }
  }
  /// All but the newest 20, which may still be overtaken.
  void Deliver(Link* to, std::int64_t now_us, const Link::Sink& deliver) {
    const std::size_t due = waiting_.size() > 20 ? waiting_.size() - 20 : 0;
    for (std::size_t i = 0; i < due; ++i) to->Receive(now_us, waiting_[i], deliver);
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(due));
  }

  std::int64_t sent = 0;

 private:
  Random random_;
  std::vector<Bytes> waiting_;
};

/// Reliable numbers count up; the unreliable ones have the highest bit set.
struct Side {
  explicit Side(std::uint64_t seed) : link(LinkKeys(kSession, seed == 2)), path(seed) {}

  void Take(ByteView message) {
    const std::uint32_t number = NumberOf(message);
    if ((number & kUnreliable) == 0) {
      in_order = in_order && number == next;
      ++next;
    } else {
      const std::uint32_t index = number & ~kUnreliable;
      if (index >= seen.size()) seen.resize(index + 1);
      twice += seen[index] ? 1 : 0;
      seen[index] = true;
    }
  }

  static constexpr std::uint32_t kUnreliable = 0x80000000u;
  Link link;
  Path path;
  std::uint32_t asked = 0, said = 0;  // sent: reliable, unreliable
  std::uint32_t next = 0;             // reliable ones that came
  bool in_order = true;
  std::vector<bool> seen;
  int twice = 0;
};

TEST(LinkWrap, AMillionDatagramsWithLossReorderAndDuplicatesComeOnceAndInOrder) {
  Side a(1), b(2);
  const auto turn = [](Side* from, Side* to, std::int64_t now_us, bool more) {
    if (more && from->asked - to->next < 100) from->link.SendReliable(Number(from->asked++));
    if (more) from->link.SendUnreliable(Number(Side::kUnreliable | from->said++));
    from->link.Flush(now_us, [&](ByteView datagram) { from->path.Send(datagram); });
    from->path.Deliver(&to->link, now_us, [&](ByteView message) { to->Take(message); });
  };
  std::int64_t now_us = 0;
  for (; a.path.sent + b.path.sent < 1'000'000; now_us += 10'000) {
    turn(&a, &b, now_us, true);
    turn(&b, &a, now_us, true);
  }
  for (const std::int64_t end_us = now_us + 20'000'000; now_us < end_us; now_us += 100'000) {
    turn(&a, &b, now_us, false);
    turn(&b, &a, now_us, false);
  }
  for (Side* side : {&a, &b}) {
    const Side& other = side == &a ? b : a;
    EXPECT_TRUE(side->in_order);
    EXPECT_EQ(side->next, other.asked);
    EXPECT_GT(side->next, 3u * 65'536u) << "ids have wrapped several times";
    EXPECT_EQ(side->twice, 0);
    const auto came = std::count(side->seen.begin(), side->seen.end(), true);
    EXPECT_GT(static_cast<double>(came), 0.85 * other.said);
    EXPECT_FALSE(side->link.reliable_pending());
  }
}

TEST(LinkWrap, NumbersUnwrapToTheNearestOnBothSidesOfEveryEdge) {
  for (const std::int64_t reference :
       {std::int64_t{0}, std::int64_t{32767}, std::int64_t{32768}, std::int64_t{65535},
        std::int64_t{65536}, std::int64_t{1} << 32, (std::int64_t{1} << 40) - 1}) {
    for (const int offset : {-32768, -32767, -256, -1, 0, 1, 255, 32766, 32767}) {
      const std::int64_t number = reference + offset;
      EXPECT_EQ(Unwrap(static_cast<std::uint16_t>(number), reference), number)
          << reference << " " << offset;
    }
    EXPECT_EQ(Unwrap(static_cast<std::uint16_t>(reference + 32768), reference), reference - 32768)
        << "half way round is taken for old";
  }
}

TEST(LinkWrap, TheWindowKnowsItsEdgesAcrossAWrap) {
  SequenceWindow window;
  window.Insert(window.Full(65'500));
  EXPECT_EQ(window.Full(10), 65'546);
  window.Insert(65'546);
  EXPECT_TRUE(window.Has(65'500));
  EXPECT_FALSE(window.IsNew(window.Full(65'500)));
  const std::int64_t last = 65'546 - (SequenceWindow::kSize - 1);
  EXPECT_TRUE(window.IsNew(last)) << "the oldest that is remembered";
  EXPECT_FALSE(window.IsNew(last - 1)) << "older than that";
  window.Insert(last);
  EXPECT_FALSE(window.IsNew(last));
  // The farthest jump forward that is understood empties it.
  const std::int64_t far = window.Full(static_cast<std::uint16_t>(65'546 + 32'767));
  EXPECT_EQ(far, 65'546 + 32'767);
  window.Insert(far);
  EXPECT_FALSE(window.Has(65'546));
  EXPECT_EQ(window.BitsBefore(far), 0u);
  // One farther is taken for old, and not inserted.
  EXPECT_FALSE(window.IsNew(window.Full(static_cast<std::uint16_t>(far + 32'768))));
}

TEST(LinkWrap, ARecordedDatagramIsWorthNothingWhenItsSixteenBitsComeAgain) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  std::vector<Bytes> recorded;
  int came = 0;
  const Link::Sink count = [&](ByteView) { ++came; };
  const Bytes one(1, 7);
  for (int n = 0; n < 3 * 65'536; ++n) {
    const std::int64_t now_us = n * 1000LL;
    Bytes datagram;
    a.SendUnreliable(one);
    a.Flush(now_us, [&](ByteView d) { datagram.assign(d.begin(), d.end()); });
    if (recorded.size() < 500) {
      recorded.push_back(datagram);
    } else if (n % 65'536 < 500) {
      // The number that comes next; in the open it says the same.
      const Bytes& old = recorded[static_cast<std::size_t>(n % 65'536)];
      ASSERT_EQ(SequenceOfDatagram(old), SequenceOfDatagram(datagram));
      ASSERT_FALSE(b.Receive(now_us, old, count));
    }
    ASSERT_TRUE(b.Receive(now_us, datagram, count));
  }
  EXPECT_EQ(came, 3 * 65'536);
}

TEST(LinkWrap, AFirstNumberNearTheEdgeWorks) {
  for (const int first : {0, 1, 255, 32767, 32768, 65535}) {
    SequenceWindow window;
    window.Insert(window.Full(static_cast<std::uint16_t>(first)));
    for (int n = 1; n < 600; ++n) {
      const std::int64_t number = window.Full(static_cast<std::uint16_t>(first + n));
      EXPECT_EQ(number, first + n);
      ASSERT_TRUE(window.IsNew(number));
      window.Insert(number);
    }
    EXPECT_EQ(window.loss_ppm(), 0);
  }
}

TEST(Link, ADatagramThatTheGateRefusesCountsAsLost) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  ASSERT_TRUE(a.SendReliable(Number(5)));
  std::vector<Bytes> sent;
  const auto keep = [&](ByteView d) { sent.emplace_back(d.begin(), d.end()); };
  a.Flush(0, keep);
  int came = 0;
  const Link::Sink count = [&](ByteView) { ++came; };
  std::size_t asked = 0;
  EXPECT_FALSE(b.Receive(
      0, sent.at(0), [&](std::size_t n) { return (asked = n) > 1; }, count));
  EXPECT_EQ(asked, 1u);
  EXPECT_EQ(came, 0);
  EXPECT_EQ(b.last_receive_us(), -1);
  EXPECT_TRUE(b.Receive(0, sent.at(0), count));
  EXPECT_EQ(came, 1);
  // A datagram that is no good does not ask.
  EXPECT_FALSE(b.Receive(
      0, sent.at(0), [&](std::size_t) { return ++asked > 0; }, count));
  EXPECT_EQ(asked, 1u);
}

}  // namespace link_wrap_test
}  // namespace seam
