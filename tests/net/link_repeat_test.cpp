/// Speculative duplicates of urgent messages, and their bounds.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "common/net/datagram.h"
#include "common/net/link.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace link_repeat_test {

constexpr std::uint64_t kSession = 0x1122334455667788ULL;
constexpr std::int64_t kTickUs = 16'667, kOneWayUs = 50'000;

Bytes Text(const std::string& text) { return Bytes(text.begin(), text.end()); }

struct InFlight {
  std::int64_t due_us = 0;
  Bytes datagram;
};

/// Two ends, ticked at 60 Hz, with a delay of 50 ms. `lose` selects the losses among `a`'s
/// datagrams with messages, by number from 0.
struct Path {
  template <typename Lose>
  void Tick(const Lose& lose) {
    now_us += kTickUs;
    Hear(a, &to_a);
    a.Flush(now_us, [&](ByteView d) {
      const bool full = d.size > kDatagramOverheadBytes;
      sent_bytes += d.size;
      if (full && lose(full_datagrams++)) return;
      to_b.push_back({now_us + kOneWayUs, Bytes(d.begin(), d.end())});
    });
    Hear(b, &to_b);
    b.Flush(now_us, [&](ByteView d) {
      ++answers;
      to_a.push_back({now_us + kOneWayUs, Bytes(d.begin(), d.end())});
    });
  }

  void Hear(Link& link, std::vector<InFlight>* queue) {
    std::vector<InFlight> left;
    for (const InFlight& each : *queue) {
      if (each.due_us > now_us) {
        left.push_back(each);
        continue;
      }
      (void)link.Receive(now_us, each.datagram, [&](ByteView m) {
        if (heard_us < 0 && m.size == 5) heard_us = now_us;
      });
    }
    *queue = left;
  }

  /// The round trip is known.
  void Settle() {
    for (int n = 0; n < 120; ++n) {
      a.SendUnreliable(Text("state"));
      Tick([](int) { return false; });
    }
    for (int n = 0; n < 30; ++n) Tick([](int) { return false; });
    heard_us = -1;
    full_datagrams = answers = 0;
    sent_bytes = 0;
  }

  Link a{LinkKeys(kSession)}, b{LinkKeys(kSession, true)};
  std::vector<InFlight> to_a, to_b;
  std::int64_t now_us = 0, heard_us = -1;
  int full_datagrams = 0, answers = 0;
  std::size_t sent_bytes = 0;
};

TEST(LinkRepeat, AMessageThatIsLostOnceArrivesThreeTicksLater) {
  for (const int losses : {0, 1}) {
    Path path;
    path.Settle();
    ASSERT_GE(path.a.rtt_us(), 2 * kOneWayUs);
    const std::int64_t begin_us = path.now_us + kTickUs;
    ASSERT_TRUE(path.a.SendUrgent(Text("grant")));
    for (int n = 0; n < 60; ++n) path.Tick([&](int datagram) { return datagram < losses; });
    ASSERT_GE(path.heard_us, 0);
    const std::int64_t extra_us = path.heard_us - begin_us - kOneWayUs;
    EXPECT_LE(extra_us, kTickUs * (losses == 0 ? 1 : 4)) << losses;
    EXPECT_FALSE(path.a.reliable_pending());
  }
}

TEST(LinkRepeat, CopiesAreFewAndAreNotAcknowledgedSeparately) {
  Path path;
  path.Settle();
  ASSERT_TRUE(path.a.SendUrgent(Text("grant")));
  for (int n = 0; n < 9; ++n) path.Tick([](int) { return false; });  // to its answer
  EXPECT_EQ(path.full_datagrams, 2);
  EXPECT_LE(path.answers, 3) << "one for the message, and those that come every 100 ms";
}

TEST(LinkRepeat, CopiesTakeABoundedShareOfThePath) {
  Path path;
  path.Settle();
  std::size_t bytes = 0;
  for (int n = 0; n < 64; ++n) {
    const std::string text(200, static_cast<char>('a' + n % 26));
    ASSERT_TRUE(path.a.SendUrgent(Text(text)));
    bytes += FramedBytes(text.size(), true);
  }
  // Nothing is acknowledged yet: all further datagrams are copies.
  const int ticks = 8;  // 13 kB take two
  for (int n = 0; n < ticks; ++n) path.Tick([](int) { return true; });
  ASSERT_GE(path.full_datagrams, 11);
  const double copies = static_cast<double>(path.sent_bytes) -
                        static_cast<double>(path.full_datagrams * kDatagramOverheadBytes) -
                        static_cast<double>(bytes);
  EXPECT_GT(copies, 0);
  EXPECT_LE(copies, 32'000 * ticks / 60.0 + kMessageBytesMax + 204 + 36 * ticks);
}

}  // namespace link_repeat_test
}  // namespace seam
