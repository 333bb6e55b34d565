/// Link accepts only whole datagrams; and tests of its parts.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/base/random.h"
#include "common/net/crc32c.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/loose_datagram.h"
#include "common/net/sequence_window.h"
#include "common/net/wire_number.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace link_distrust_test {

constexpr std::uint64_t kSession = 0x1122334455667788ULL;
const Link::Sink kIgnore = [](ByteView) {};

Bytes Text(const std::string& text) { return Bytes(text.begin(), text.end()); }

/// Returns the datagrams that Flush would send now.
std::vector<Bytes> Drain(Link& link, std::int64_t now_us) {
  std::vector<Bytes> datagrams;
  link.Flush(now_us, [&](ByteView d) { datagrams.emplace_back(d.begin(), d.end()); });
  return datagrams;
}

/// Header and messages as a datagram that the other end has sealed.
Bytes Forge(const DatagramHeader& header, const Bytes& body) {
  static const Seal seal(LinkKeys(kSession));
  Bytes datagram(kDatagramHeaderBytes);
  PutNumber(datagram.data(), kDatagramMagic, 4);
  PutNumber(datagram.data() + 4, kSession, 8);
  PutNumber(datagram.data() + 12, static_cast<std::uint64_t>(header.sequence), 2);
  PutNumber(datagram.data() + 14, header.ack, 2);
  PutNumber(datagram.data() + 16, header.ack_bits, 4);
  datagram.insert(datagram.end(), body.begin(), body.end());
  seal.Close(header.sequence, 14, &datagram);
  return datagram;
}

TEST(Link, RejectsDuplicatesAndForeignSessionsAndCountsThem) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true)), stranger(LinkKeys(kSession + 1, true));
  a.SendUnreliable(Text("x"));
  const Bytes datagram = Drain(a, 0).at(0);
  EXPECT_EQ(SessionOfDatagram(datagram), kSession);
  EXPECT_FALSE(stranger.Receive(0, datagram, kIgnore));
  EXPECT_TRUE(b.Receive(0, datagram, kIgnore));
  EXPECT_FALSE(b.Receive(0, datagram, kIgnore));
  EXPECT_EQ(b.rejected(), 1);
  EXPECT_EQ(stranger.rejected(), 1);
  EXPECT_EQ(stranger.last_receive_us(), -1);
}

TEST(Link, RejectsADatagramOlderThanItsMemory) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  std::vector<Bytes> datagrams;
  for (int i = 0; i < 300; ++i) {
    a.SendUnreliable(Text(std::to_string(i)));
    datagrams.push_back(Drain(a, i).at(0));
  }
  EXPECT_TRUE(b.Receive(0, datagrams[299], kIgnore));
  EXPECT_TRUE(b.Receive(0, datagrams[44], kIgnore));  // 255 behind: the last one remembered
  EXPECT_FALSE(b.Receive(0, datagrams[43], kIgnore));
}

TEST(Link, RejectsEveryTruncationAndEverySingleBitFlipWhole) {
  Link a(LinkKeys(kSession));
  ASSERT_TRUE(a.SendReliable(Text("reliable")));
  a.SendUnreliable(Text("unreliable"));
  const Bytes datagram = Drain(a, 0).at(0);
  int delivered = 0;
  const Link::Sink count = [&](ByteView) { ++delivered; };
  Link b(LinkKeys(kSession, true));
  for (std::size_t size = 0; size < datagram.size(); ++size) {
    EXPECT_FALSE(b.Receive(0, {datagram.data(), size}, count));
  }
  for (std::size_t bit = 0; bit < datagram.size() * 8; ++bit) {
    Bytes wrong = datagram;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_FALSE(b.Receive(0, wrong, count));
  }
  EXPECT_EQ(delivered, 0);
  EXPECT_TRUE(b.Receive(0, datagram, count));
  EXPECT_EQ(delivered, 2);
}

TEST(Link, RejectsMalformedFramingBeforeDeliveringAnything) {
  const DatagramHeader header{1, 0, 0};
  const Bytes good = {0, 1, 'g'};
  const Bytes bad_tails[] = {
      {0},                   // half a header
      {0, 0},                // length 0
      {0, 2, 'x'},           // beyond the end
      {0x80, 1, 0},          // reliable without its id
      {0x80, 1, 0, 0},       // reliable without its byte
      {0x80, 1, 1, 0, 'x'},  // an id beyond the window
      {0x7f, 0xff, 'x'},     // a length no datagram can hold
  };
  int delivered = 0;
  for (const Bytes& tail : bad_tails) {
    Bytes body = good;
    body.insert(body.end(), tail.begin(), tail.end());
    Link link(LinkKeys(kSession, true));
    EXPECT_FALSE(link.Receive(0, Forge(header, body), [&](ByteView) { ++delivered; }));
  }
  EXPECT_EQ(delivered, 0);
  Link link(LinkKeys(kSession, true));
  EXPECT_FALSE(link.Receive(0, Forge({1, 5, 0}, good), kIgnore));  // acks the unsent
  EXPECT_TRUE(link.Receive(0, Forge(header, good), [&](ByteView) { ++delivered; }));
  EXPECT_EQ(delivered, 1);
  EXPECT_FALSE(link.Receive(0, Forge({9, 0, 0}, Bytes(1165, 1)), kIgnore));  // too long
}

TEST(Link, NeverDeliversMutatedDatagrams) {
  Random random(20240817);
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  std::vector<Bytes> samples;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(a.SendReliable(Bytes(1 + random.Next() % 40, 'r')));
    a.SendUnreliable(Bytes(1 + random.Next() % 200, 'u'));
    for (const Bytes& datagram : Drain(a, i * 1'000'000)) samples.push_back(datagram);
  }
  std::int64_t delivered = 0;
  const Link::Sink count = [&](ByteView) { ++delivered; };
  constexpr int kRounds = 3'000'000;
  for (int round = 0; round < kRounds; ++round) {
    Bytes data;
    if (round % 4 == 0) {
      data.resize(random.Next() % 64);
      for (auto& byte : data) byte = static_cast<std::uint8_t>(random.Next());
    } else {
      data = samples[random.Next() % samples.size()];
      if (round % 4 == 1) data.resize(random.Next() % data.size());
      for (std::uint64_t k = 0; !data.empty() && k <= random.Next() % 4; ++k) {
        const std::size_t at = random.Next() % data.size();
        data[at] = static_cast<std::uint8_t>(data[at] ^ (1 + random.Next() % 255));
      }
    }
    if (!b.Receive(0, data, count)) continue;
    // A mutation may have undone itself; nothing else may pass.
    EXPECT_TRUE(std::find(samples.begin(), samples.end(), data) != samples.end());
  }
  EXPECT_LE(delivered, 200);
  EXPECT_GT(b.rejected(), kRounds - 100);
}

TEST(Link, SurvivesAnyContentThatTheOtherEndSealed) {
  Random random(77);
  Link link(LinkKeys(kSession, true));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(link.SendReliable(Text("waiting")));
  std::int64_t accepted = 0;
  for (int round = 0; round < 500'000; ++round) {
    DatagramHeader header{round + 1 + static_cast<std::int64_t>(random.Next() % 8),
                          static_cast<std::uint16_t>(random.Next() % 64),
                          static_cast<std::uint32_t>(random.Next())};
    if (round % 100 == 0) header.sequence += static_cast<std::int64_t>(random.Next() % 100'000);
    Bytes body(random.Next() % 48);
    for (auto& byte : body) byte = static_cast<std::uint8_t>(random.Next() % 3 ? 0 : random.Next());
    const Bytes datagram = Forge(header, body);
    accepted +=
        link.Receive(round, datagram, [&](ByteView m) { EXPECT_LE(m.size, kMessageBytesMax); });
    if (round % 50 == 0) {
      for (const Bytes& d : Drain(link, round * 1000LL)) EXPECT_LE(d.size(), kDatagramBytesMax);
    }
  }
  EXPECT_GT(accepted, 1000);
}

TEST(Crc32c, MatchesThePublishedCheckValues) {
  EXPECT_EQ(Crc32c(Text("123456789")), 0xe3069283u);
  EXPECT_EQ(Crc32c(Bytes(32, 0x00)), 0x8a9136aau);  // RFC 3720 B.4
  EXPECT_EQ(Crc32c(Bytes(32, 0xff)), 0x62a8ab43u);
  EXPECT_EQ(Crc32c(Text("56789"), Crc32c(Text("1234"))), 0xe3069283u);
}

/// seal_test.cpp has the sealed bytes.
TEST(Datagram, HasTheHeaderThatTheProtocolPageShows) {
  DatagramWriter writer;
  const Bytes hi = Text("hi"), event = Text("!");
  writer.Append({true, 0x0102, event});
  writer.Append({false, 0, hi});
  const ByteView plain = writer.plain();
  const Bytes messages = {0x80, 1, 1, 2, '!', 0, 2, 'h', 'i'};
  EXPECT_EQ(Bytes(plain.begin() + kDatagramHeaderBytes, plain.end()), messages);
  const Seal seal(LinkKeys(kSession)), other(LinkKeys(kSession, true));
  const Bytes data = writer.Finish({0x1000a, 0x0009, 0x80000001}, seal);
  const Bytes expected = {'S',  'E',  'A',  '2',  0x11, 0x22, 0x33,
                          0x44, 0x55, 0x66, 0x77, 0x88, 0x00, 0x0a};
  EXPECT_EQ(Bytes(data.begin(), data.begin() + 14), expected);
  EXPECT_EQ(data.size(), 45u);
  Bytes opened;
  DatagramHeader header;
  EXPECT_FALSE(OpenDatagram(data, other, 0x000a, &opened, &header)) << "a wrap before";
  ASSERT_TRUE(OpenDatagram(data, other, 0x1000a, &opened, &header));
  EXPECT_EQ(header.ack, 0x0009);
  EXPECT_EQ(header.ack_bits, 0x80000001);
}

/// A client of any version reads and writes these.
TEST(LooseDatagram, HasTheBytesThatTheProtocolPageShows) {
  const Bytes datagram = LooseDatagram(0x1122334455667788ULL, Text("hi"), 32);
  ASSERT_EQ(datagram.size(), 32u);
  EXPECT_EQ(LooseNumber(datagram), 0x1122334455667788ULL);
  const ByteView message = LooseMessage(datagram);
  EXPECT_EQ(Bytes(message.begin(), message.end()), Text("hi"));
  for (std::size_t bit = 0; bit < datagram.size() * 8; ++bit) {
    Bytes wrong = datagram;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_EQ(LooseNumber(wrong), 0u);
  }
  EXPECT_EQ(SessionOfDatagram(datagram), 0u);
}

/// A forger who reads the path and computes checksums: all that he could do once.
TEST(Link, NothingForgedMovesItsWindowOrIsDelivered) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  std::vector<Bytes> old;
  for (int i = 0; i < 100; ++i) {
    a.SendUnreliable(Text("state"));
    old.push_back(Drain(a, i).at(0));
    if (i < 50) {
      EXPECT_TRUE(b.Receive(i, old.back(), kIgnore));
    }
  }
  int heard = 0;
  const Link::Sink count = [&](ByteView) { ++heard; };
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    Bytes forged = old[random.Next() % old.size()];
    if (i % 2 == 0) forged.resize(kDatagramOverheadBytes);            // empty
    PutNumber(forged.data() + 12, static_cast<std::uint64_t>(i), 2);  // with any number
    if (forged == old[static_cast<std::size_t>(i) % old.size()]) continue;
    if (i >= 1 && i <= 100 && forged == old[static_cast<std::size_t>(i) - 1]) continue;
    EXPECT_FALSE(b.Receive(100, forged, count));
  }
  EXPECT_EQ(heard, 0);
  for (int i = 50; i < 100; ++i) {
    EXPECT_TRUE(b.Receive(100, old[static_cast<std::size_t>(i)], count));
  }
  EXPECT_EQ(heard, 50);
}

TEST(Link, RecordedDatagramsAreNothingWorthAfterTheirNumbersHaveWrapped) {
  Link a(LinkKeys(kSession)), b(LinkKeys(kSession, true));
  std::vector<Bytes> old;
  int heard = 0;
  const Link::Sink count = [&](ByteView) { ++heard; };
  for (int i = 0; i < 65'536 + 300; ++i) {
    a.SendUnreliable(Text("state"));
    const Bytes datagram = Drain(a, i).at(0);
    if (old.size() < 600) old.push_back(datagram);
    EXPECT_TRUE(b.Receive(i, datagram, count));
  }
  heard = 0;
  for (const Bytes& datagram : old) EXPECT_FALSE(b.Receive(100'000, datagram, count));
  EXPECT_EQ(heard, 0);
}

TEST(SequenceWindow, UnwrapsToTheNearestNumber) {
  EXPECT_EQ(Unwrap(5, 0), 5);
  EXPECT_EQ(Unwrap(65535, 0), -1);
  EXPECT_EQ(Unwrap(0, 65535), 65536);
  EXPECT_EQ(Unwrap(65530, 65540), 65530);
  EXPECT_EQ(Unwrap(3, 10 * 65536 - 2), 10 * 65536 + 3);
}

TEST(SequenceWindow, RemembersArrivalsAndTheShareOfLosses) {
  SequenceWindow window;
  EXPECT_EQ(window.loss_ppm(), 0);
  for (const std::int64_t number : {10, 11, 13, 12, 19}) {
    EXPECT_TRUE(window.IsNew(number));
    window.Insert(number);
    EXPECT_FALSE(window.IsNew(number));
  }
  EXPECT_EQ(window.newest(), 19);
  EXPECT_EQ(window.BitsBefore(19), 0b111100000u);
  EXPECT_EQ(window.loss_ppm(), 500'000);
  window.Insert(8);  // late, and before the first that came
  EXPECT_EQ(window.loss_ppm(), 500'000);
  window.Insert(9);
  EXPECT_EQ(window.loss_ppm(), 5 * 1'000'000 / 12);
  window.Insert(19 + 1000);
  EXPECT_EQ(window.BitsBefore(1019), 0u);
  EXPECT_FALSE(window.IsNew(19));  // too old to know
  EXPECT_TRUE(window.IsNew(1019 - 255));
}

}  // namespace link_distrust_test
}  // namespace seam
