/// Link delivers reliable messages once and in order over every kind of bad network.

#include "common/net/link.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/codec/short_form.h"
#include "common/net/datagram.h"
#include "common/net/impair.h"
#include "common/net/memory.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace link_test {

constexpr std::uint64_t kSession = 0x1122334455667788ULL;
constexpr std::int64_t kTickUs = 16'667;
const Address kClient{0x7f000001, 40000}, kServer{0x7f000001, 7777};

const Link::Sink kIgnore = [](ByteView) {};

Bytes Text(const std::string& text) { return Bytes(text.begin(), text.end()); }
std::string ToText(ByteView bytes) { return std::string(bytes.begin(), bytes.end()); }

/// Returns the datagrams that Flush would send now.
std::vector<Bytes> Drain(Link& link, std::int64_t now_us) {
  std::vector<Bytes> datagrams;
  link.Flush(now_us, [&](ByteView d) { datagrams.emplace_back(d.begin(), d.end()); });
  return datagrams;
}

/// One end of a link: its endpoint, the impairment of its datagrams, and the received messages.
struct End {
  End(MemoryNetwork& network, const Address& self, const Address& peer,
      const ImpairProfile& profile, std::uint64_t seed)
      : to(peer),
        endpoint(network.Attach(self)),
        net(*endpoint, profile, FindProfile("perfect"), seed),
        link(LinkKeys(kSession, self == kServer)) {}

  void Tick(std::int64_t now_us) {
    net.Advance(now_us);
    Address from;
    Bytes data;
    while (net.Receive(&from, &data)) {
      (void)link.Receive(now_us, data, [&](ByteView m) { heard.push_back(ToText(m)); });
    }
    link.Flush(now_us, [&](ByteView d) {
      EXPECT_LE(d.size, kDatagramBytesMax);
      ++datagrams;
      bytes += d.size;
      net.Send(to, d);
    });
    net.Flush();
  }

  Address to;
  std::unique_ptr<Net> endpoint;
  ImpairedNet net;
  Link link;
  std::vector<std::string> heard;
  std::size_t datagrams = 0, bytes = 0;
};

struct Pair {
  explicit Pair(const std::string& profile, std::uint64_t seed = 1)
      : a(network, kClient, kServer, FindProfile(profile), seed),
        b(network, kServer, kClient, FindProfile(profile), seed + 1000) {}
  void Tick() {
    now_us += kTickUs;
    a.Tick(now_us);
    b.Tick(now_us);
  }
  MemoryNetwork network;
  End a, b;
  std::int64_t now_us = 0;
};

const char* const kNetworks[] = {"perfect",
                                 "demo",
                                 "oneway200",
                                 "wifi_busy",
                                 "terrible",
                                 "soak",
                                 "corrupt",
                                 "3g",
                                 "delay=30ms,loss=40%,duplicate=30%,reorder=20%:100ms,corrupt=5%",
                                 "delay=100ms,jitter=50ms,burst=5%:20%,reorder=10%:80ms"};

TEST(Link, DeliversReliableMessagesOnceAndInOrderOverEveryNetwork) {
  for (const char* network : kNetworks) {
    Pair pair(network);
    std::vector<std::string> sent;
    for (int tick = 0; tick < 6000 && (tick < 300 || pair.a.link.reliable_pending()); ++tick) {
      for (int k = 0; tick < 300 && k < tick % 4; ++k) {
        sent.push_back("event " + std::to_string(sent.size()) + std::string(sent.size() % 90, '.'));
        ASSERT_TRUE(pair.a.link.SendReliable(Text(sent.back())));
      }
      pair.Tick();
    }
    EXPECT_FALSE(pair.a.link.reliable_pending()) << network;
    EXPECT_EQ(pair.b.heard, sent) << network;
  }
}

TEST(Link, CarriesALargeRoomInChunksBothWaysAtOnceUnderLoss) {
  Pair pair("terrible");
  std::vector<std::string> sent;
  for (int i = 0; i < 60; ++i) {
    sent.push_back(std::string(1000, static_cast<char>('a' + i % 26)));
    ASSERT_TRUE(pair.a.link.SendReliable(Text(sent.back())));
    ASSERT_TRUE(pair.b.link.SendReliable(Text(sent.back())));
  }
  for (int tick = 0; tick < 600; ++tick) pair.Tick();
  EXPECT_EQ(pair.a.heard, sent);
  EXPECT_EQ(pair.b.heard, sent);
}

/// As many as a holder's hand-overs at their worst: a lost message delays its successors, and no
/// more than that.
TEST(Link, ManySmallMessagesDoNotPileUpAtAQuarterLoss) {
  Pair pair("delay=96ms,jitter=16ms,loss=27%");
  const int per_s = 120, ticks = 1200;
  std::vector<double> told_s, late_s;  // by message: when it was said, and how long it took
  std::size_t most = 0;
  for (int tick = 0; tick < ticks + 300; ++tick) {
    for (int k = 0; k < per_s / 60 && tick < ticks; ++k) {
      told_s.push_back(static_cast<double>(pair.now_us) * 1e-6);
      ASSERT_TRUE(pair.a.link.SendUrgent(Text(std::string(48, 'g'))));
    }
    pair.Tick();
    most = std::max(most, pair.a.link.waiting());
    while (late_s.size() < pair.b.heard.size()) {
      late_s.push_back(static_cast<double>(pair.now_us) * 1e-6 - told_s[late_s.size()]);
    }
  }
  ASSERT_EQ(late_s.size(), told_s.size());
  EXPECT_GT(pair.b.link.loss_ppm(), 200'000);
  std::sort(late_s.begin(), late_s.end());
  const double p99 = late_s[late_s.size() * 99 / 100];
  std::printf("[          ] p99 %.2f s, %zu waiting at most\n", p99, most);
  EXPECT_LE(p99, 1.8);
  EXPECT_LT(most, static_cast<std::size_t>(kReliableWindow));
}

TEST(Link, TheWindowIsBoundedInBytesAtBothEnds) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  constexpr std::size_t kMost = kMessageBytesMax - kShortFormExtra;
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(a.SendReliable(Bytes(kMost, 'x')));
  std::size_t sent = 0, heard = 0;
  for (int tick = 0; tick < 12; ++tick) {  // not yet late
    for (const Bytes& datagram : Drain(a, tick * kTickUs)) {
      if (++sent == 1) continue;  // lost: all others wait for it
      EXPECT_TRUE(b.Receive(0, datagram, [&](ByteView) { ++heard; }));
    }
  }
  EXPECT_EQ(sent, kReliableWindowBytes / kMessageBytesMax);
  EXPECT_EQ(heard, 0u);
  const auto more = [&](std::uint8_t id, std::size_t bytes) {
    const Bytes body = ShortForm(Bytes(bytes, 'x'));
    DatagramWriter writer;
    writer.Append({true, id, body});
    return b.Receive(0, writer.Finish({300 + id, 0, 0}, Seal(LinkKeys(kSession))),
                     [&](ByteView) { ++heard; });
  };
  EXPECT_TRUE(more(100, kMost)) << "as long as the one that is missing at most";
  EXPECT_FALSE(more(101, 1));
  EXPECT_TRUE(more(5, kMost)) << "which it has";
  EXPECT_TRUE(more(0, kMost)) << "the one that was lost";
  EXPECT_EQ(heard, sent);
  EXPECT_TRUE(more(101, 1));
}

TEST(Link, UnreliableMessagesArriveAtMostOnceAndMostlyDo) {
  for (const char* network : kNetworks) {
    Pair pair(network);
    std::set<std::string> sent;
    for (int tick = 0; tick < 1000; ++tick) {
      if (tick < 800) {
        sent.insert(std::to_string(tick));
        pair.a.link.SendUnreliable(Text(std::to_string(tick)));
      }
      pair.Tick();
    }
    std::set<std::string> heard;
    for (const std::string& message : pair.b.heard) {
      EXPECT_EQ(sent.count(message), 1u);
      EXPECT_TRUE(heard.insert(message).second) << message << " twice over " << network;
    }
    EXPECT_GT(heard.size(), 400u) << network;
  }
}

TEST(Link, SplitsIntoDatagramsAndNeverFragments) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  std::vector<std::string> sent, heard;
  for (std::size_t i = 0; i < 40; ++i) {
    sent.emplace_back(1 + i * (kMessageBytesMax - 1) / 39, 'x');
    a.SendUnreliable(Text(sent.back()));
  }
  for (const Bytes& datagram : Drain(a, 0)) {
    EXPECT_LE(datagram.size(), kDatagramBytesMax);
    EXPECT_TRUE(b.Receive(0, datagram, [&](ByteView m) { heard.push_back(ToText(m)); }));
  }
  EXPECT_EQ(heard, sent);
}

TEST(Link, SurvivesTheWrapOfSequenceNumbersAndIds) {
  Pair pair("delay=20ms,loss=5%,reorder=5%:40ms");
  std::vector<std::string> sent;
  for (int tick = 0; tick < 70'000; ++tick) {
    sent.push_back(std::to_string(tick));
    ASSERT_TRUE(pair.a.link.SendReliable(Text(sent.back())));
    pair.Tick();
  }
  for (int tick = 0; tick < 200; ++tick) pair.Tick();
  EXPECT_GT(pair.a.datagrams, 65'536u);
  EXPECT_EQ(pair.b.heard, sent);
  EXPECT_FALSE(pair.a.link.reliable_pending());
}

TEST(Link, ManyDatagramsBetweenTwoAnswersAreStillAllAcknowledged) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  for (int round = 0; round < 3; ++round) {
    const std::int64_t now_us = round * 1000;
    ASSERT_TRUE(a.SendReliable(Text("important")));
    // 100 full datagrams follow the one that has the event: far beyond one ack field.
    for (int i = 0; i < 100; ++i) a.SendUnreliable(Bytes(kMessageBytesMax, 1));
    for (const Bytes& d : Drain(a, now_us)) EXPECT_TRUE(b.Receive(now_us, d, kIgnore));
    EXPECT_TRUE(a.reliable_pending());
    for (const Bytes& d : Drain(b, now_us)) EXPECT_TRUE(a.Receive(now_us, d, kIgnore));
    EXPECT_FALSE(a.reliable_pending());
  }
}

TEST(Link, MeasuresTheRoundTripAndTheLoss) {
  Pair pair("delay=80ms");
  EXPECT_EQ(pair.a.link.rtt_us(), -1);
  for (int tick = 0; tick < 300; ++tick) {
    pair.a.link.SendUnreliable(Text("x"));
    pair.b.link.SendUnreliable(Text("y"));
    pair.Tick();
  }
  // Two ways of 80 ms, and up to a tick of waiting at either end.
  EXPECT_GE(pair.a.link.rtt_us(), 160'000);
  EXPECT_LE(pair.a.link.rtt_us(), 160'000 + 2 * kTickUs + 1000);
  EXPECT_EQ(pair.a.link.loss_ppm(), 0);
  Pair lossy("delay=80ms,loss=20%");
  for (int tick = 0; tick < 1500; ++tick) {
    lossy.a.link.SendUnreliable(Text("x"));
    lossy.Tick();
  }
  EXPECT_NEAR(static_cast<double>(lossy.b.link.loss_ppm()), 200'000, 80'000);
}

/// When a message that is never acknowledged is sent, us after it was said, over a round trip of
/// 200 ms.
std::vector<std::int64_t> SentUs(bool (Link::*send)(ByteView)) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  for (int i = 0; i < 50; ++i) {
    const std::int64_t now_us = i * 1'000'000;
    a.SendUnreliable(Text("x"));
    for (const Bytes& d : Drain(a, now_us)) EXPECT_TRUE(b.Receive(now_us + 100'000, d, kIgnore));
    b.SendUnreliable(Text("y"));
    for (const Bytes& d : Drain(b, now_us + 100'000)) {
      EXPECT_TRUE(a.Receive(now_us + 200'000, d, kIgnore));
    }
  }
  EXPECT_EQ(a.rtt_us(), 200'000);
  EXPECT_TRUE((a.*send)(Bytes(500, 1)));
  std::vector<std::int64_t> sent_us;
  for (std::int64_t at_us = 0; at_us < 1'000'000; at_us += 5000) {
    for (const Bytes& d : Drain(a, 60'000'000 + at_us)) {
      if (d.size() > 500) sent_us.push_back(at_us);
    }
  }
  return sent_us;
}

TEST(Link, RepeatsReliableMessagesNoFasterThanTheRoundTripAllowsButUrgentOnesOnce) {
  using Times = std::vector<std::int64_t>;
  EXPECT_EQ(SentUs(&Link::SendUrgent), (Times{0, 35'000, 285'000, 535'000, 785'000}));
  EXPECT_EQ(SentUs(&Link::SendReliable), (Times{0, 250'000, 500'000, 750'000}));
}

TEST(Link, IsSilentWhenIdleButForAnAckEveryHundredMilliseconds) {
  Link link(LinkKeys(kSession));
  int datagrams = 0;
  for (std::int64_t now_us = 0; now_us < 1'000'000; now_us += 10'000) {
    for (const Bytes& datagram : Drain(link, now_us)) {
      EXPECT_EQ(datagram.size(), kDatagramOverheadBytes);
      ++datagrams;
    }
  }
  EXPECT_EQ(datagrams, 10);
}

TEST(Link, AnswersReliableMessagesAtTheNextFlush) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  (void)Drain(b, 0);
  ASSERT_TRUE(a.SendReliable(Text("x")));
  for (const Bytes& datagram : Drain(a, 1000)) EXPECT_TRUE(b.Receive(1000, datagram, kIgnore));
  const auto answer = Drain(b, 2000);
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_TRUE(a.Receive(3000, answer[0], kIgnore));
  EXPECT_FALSE(a.reliable_pending());
  EXPECT_TRUE(Drain(b, 4000).empty());
}

TEST(Link, RefusesReliableMessagesWhenThePeerIsGone) {
  Link link(LinkKeys(kSession));
  for (int i = 0; i < 4096; ++i) ASSERT_TRUE(link.SendReliable(Bytes(1000, 'x')));
  EXPECT_FALSE(link.SendReliable(Text("x")));
  std::size_t most = 0;
  for (std::int64_t now_us = 0; now_us < 5'000'000; now_us += kTickUs) {
    most = std::max(most, Drain(link, now_us).size());
  }
  EXPECT_LE(most, 10u);
}

TEST(Link, MayBeUsedFromWithinADelivery) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  ASSERT_TRUE(a.SendReliable(Text("ping")));
  for (const Bytes& datagram : Drain(a, 0)) {
    EXPECT_TRUE(b.Receive(0, datagram, [&](ByteView) { (void)b.SendReliable(Text("pong")); }));
  }
  std::string heard;
  for (const Bytes& datagram : Drain(b, 0)) {
    EXPECT_TRUE(a.Receive(0, datagram, [&](ByteView m) { heard = ToText(m); }));
  }
  EXPECT_EQ(heard, "pong");
}

}  // namespace link_test
}  // namespace seam
