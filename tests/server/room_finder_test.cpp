/// Finds a datagram's room; strangers cannot make it allocate memory.

#include "server/hub/room_finder.h"

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "common/codec/short_form.h"
#include "common/net/link.h"
#include "common/net/loose_datagram.h"
#include "common/net/memory.h"
#include "server/hub/room_net.h"
#include "server/sessions/traffic_count.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace room_finder_test {

const Address kAnn{0x7f000001, 20001};

Bytes HelloOf(std::uint64_t session) {
  Hello hello;
  hello.name = "ann";
  return LooseDatagram(session, Encode(hello));
}

Bytes JoinOf(std::uint64_t session, const std::string& room) {
  Join join;
  join.name = "ann";
  join.exchange.assign(kJoinExchangeBytes, 1);
  join.room = room;
  return LooseDatagram(session, Encode(join));
}

/// A datagram within a session; `plain`: as it is without its seal.
Bytes Within(std::uint64_t session, Bytes* plain = nullptr) {
  Link link(LinkKeys(session));
  link.SetWatch([&](ByteView bytes, bool) {
    if (plain != nullptr) plain->assign(bytes.begin(), bytes.end());
  });
  link.SendUnreliable(Encode(Ping{}));
  Bytes sent;
  link.Flush(0, [&](ByteView datagram) { sent.assign(datagram.begin(), datagram.end()); });
  return sent;
}

TEST(RoomFinder, AJoinGoesToTheRoomThatItNamesAndAHelloToNone) {
  RoomFinder finder({"red", "blue"});
  EXPECT_EQ(finder.Find(0, HelloOf(5)), RoomFinder::kHello);
  EXPECT_EQ(finder.Find(0, JoinOf(5, "")), 0);
  EXPECT_EQ(finder.Find(0, JoinOf(5, "red")), 0);
  EXPECT_EQ(finder.Find(0, JoinOf(5, "blue")), 1);
  EXPECT_EQ(finder.Find(0, JoinOf(5, "green")), RoomFinder::kUnknown);
  EXPECT_EQ(finder.Refusal(), "there is no such room here: the rooms are red, blue");
  EXPECT_EQ(finder.count(), 0u) << "who only asks is not remembered";
}

TEST(RoomFinder, ASessionIsFoundByItsNumberAlone) {
  RoomFinder finder({"red", "blue"});
  EXPECT_EQ(finder.Find(0, Within(5)), RoomFinder::kNone);
  finder.Learn(0, 1, 5);
  EXPECT_EQ(finder.Find(0, Within(5)), 1);
  EXPECT_EQ(finder.Find(0, Within(6)), RoomFinder::kNone) << "another conversation";
}

TEST(RoomFinder, ForgetsSilentSessions) {
  RoomFinder finder({"red", "blue"});
  finder.Learn(0, 1, 5);
  finder.Learn(0, 1, 6);
  const std::int64_t later_us = RoomFinder::kKeepUs + 1;
  EXPECT_EQ(finder.Find(later_us - 2, Within(6)), 1);
  finder.Learn(later_us, 0, 7);
  EXPECT_EQ(finder.count(), 2u);
  EXPECT_EQ(finder.Find(later_us, Within(5)), RoomFinder::kNone);
  EXPECT_EQ(finder.Find(later_us, Within(6)), 1);
}

TEST(RoomFinder, TheOnlyRoomGetsEverythingButAJoinToAnother) {
  RoomFinder finder({"red"});
  EXPECT_EQ(finder.Find(0, Within(5)), 0);
  EXPECT_EQ(finder.Find(0, HelloOf(5)), 0);
  EXPECT_EQ(finder.Find(0, Bytes{1, 2, 3}), 0) << "it counts what is malformed";
  EXPECT_EQ(finder.Find(0, JoinOf(5, "blue")), RoomFinder::kUnknown);
  EXPECT_EQ(finder.Refusal(), "there is no such room here: the room is red");
}

TEST(RoomFinder, NonsenseBelongsToNoRoom) {
  RoomFinder finder({"red", "blue"});
  Bytes damaged = JoinOf(5, "blue");
  damaged.back() ^= 1;
  for (const Bytes& datagram : {Bytes{}, Bytes{1}, Bytes(24, 0), Bytes(1200, 0xff), damaged}) {
    EXPECT_EQ(finder.Find(0, datagram), RoomFinder::kNone);
  }
}

TEST(RoomNet, LearnsASessionFromItsFirstOutgoingDatagram) {
  MemoryNetwork network;
  const std::unique_ptr<Net> out = network.Attach({0x7f000001, 7777});
  RoomFinder finder({"red", "blue"});
  RoomNet net(finder, 1, *out);
  net.Advance(1000);
  net.Send(kAnn, HelloOf(5));  // as a Challenge: outside of a session
  EXPECT_EQ(finder.Find(1000, Within(5)), RoomFinder::kNone);
  net.Send(kAnn, Within(5));
  EXPECT_EQ(finder.Find(1000, Within(5)), 1);
}

TEST(RoomNet, AStalledRoomDropsTheExcessAndKeepsTheRest) {
  MemoryNetwork network;
  const std::unique_ptr<Net> out = network.Attach({0x7f000001, 7777});
  RoomFinder finder({"red"});
  RoomNet net(finder, 0, *out);
  for (std::size_t i = 0; i < RoomNet::kInboxMax + 10; ++i) net.Deliver(kAnn, Bytes{1});
  EXPECT_TRUE(net.HasMail());
  EXPECT_EQ(net.discarded(), 10);
  net.Advance(0);
  std::size_t received = 0;
  Address from;
  for (Bytes datagram; net.Receive(&from, &datagram);) ++received;
  EXPECT_EQ(received, RoomNet::kInboxMax);
  EXPECT_FALSE(net.HasMail());
}

TEST(TrafficCount, CountsEveryByteByItsKindOfMessage) {
  TrafficCount traffic;
  Bytes plain;
  const Bytes ping = Within(5, &plain), join = JoinOf(5, "red");
  traffic.AddPlain(plain, true);
  traffic.AddLoose(join, false);
  traffic.AddLoose(Bytes(30, 0xff), false);
  Load load;
  traffic.Write(&load);
  std::int64_t out = 0, in = 0;
  for (std::size_t i = 0; i < load.kind.size(); ++i) {
    out += load.bytes_out[i];
    in += load.bytes_in[i];
    if (load.kind[i] == kTrafficClock) {
      EXPECT_EQ(load.bytes_out[i], static_cast<std::int64_t>(ShortForm(Encode(Ping{})).size()));
    }
    if (load.kind[i] == kTrafficOther) {
      EXPECT_EQ(load.bytes_in[i], 30);
    }
  }
  EXPECT_EQ(out, static_cast<std::int64_t>(ping.size()));
  EXPECT_EQ(in, static_cast<std::int64_t>(join.size() + 30));
  ASSERT_EQ(load.kind.size(), 4u);
  EXPECT_EQ(load.kind[1], kTrafficJoining);
}

}  // namespace room_finder_test
}  // namespace seam
