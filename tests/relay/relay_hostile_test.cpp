/// Strangers and hostile watchers at a relay: what they send is dropped, and nobody is sent more
/// than it may be.

#include <gtest/gtest.h>

#include "common/base/random.h"
#include "common/net/datagram.h"
#include "common/net/loose_datagram.h"
#include "common/sync/edits/edit_order.h"
#include "server/relay/relay.h"
#include "tests/relay/relayed_room.h"
#include "tests/support/path/link_keys.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace relay_hostile_test {

ClusterConfig Crossing() {
  ClusterConfig config;
  config.impair = "perfect";
  config.drive = Drive::kBot;
  config.keep = false;
  return config;
}

/// A room with a relay and one watcher.
struct Watched {
  Watched() : room(Crossing()), spot(room.AddRelay()), seat(room.AddClient(spot.address, "wanda")) {
    room.cluster.RunToTick(120);
    EXPECT_TRUE(seat.client->running());
  }
  std::size_t BytesFor(Net* net) {
    Address from;
    Bytes datagram;
    std::size_t bytes = 0;
    while (net->Receive(&from, &datagram)) bytes += datagram.size();
    return bytes;
  }
  /// The watcher goes on watching.
  void ExpectWatched(std::int64_t ticks) {
    room.Run(ticks);
    EXPECT_EQ(seat.client->rejoins(), 0);
    EXPECT_GT(seat.client->replica()->tick(), room.cluster.server().tick() - 10);
    EXPECT_EQ(seat.client->stats().dropped_malformed, 0);
  }

  RelayedRoom room;
  RelayedRoom::Spot& spot;
  RelayedRoom::Seat& seat;
};

TEST(RelayHostile, AThousandForgedHellosAllocateNothingAndAreNotAmplified) {
  Watched watched;
  std::vector<std::unique_ptr<Net>> forged;
  std::size_t in = 0, out = 0;
  for (std::uint32_t n = 0; n < 1000; ++n) {
    forged.push_back(watched.room.cluster.Attach(Address{0x0a000000 + n, 1000}));
    Hello hello;
    hello.name = "f" + std::to_string(n);
    if (n % 2 != 0) hello.protocol = 2;
    const Bytes loose = LooseDatagram(1 + n, Encode(hello), kHandshakeBytes);
    DatagramWriter writer;  // goes on as if it had had an answer
    const ByteView sealed = writer.Finish({2, 1, 0}, Seal(LinkKeys(1 + n)));
    in += loose.size() + sealed.size;
    forged.back()->Send(watched.spot.address, loose);
    forged.back()->Send(watched.spot.address, sealed);
  }
  watched.ExpectWatched(60);
  EXPECT_EQ(watched.spot.relay->watchers().count(), 1);
  for (const auto& net : forged) out += watched.BytesFor(net.get());
  EXPECT_GT(out, 0u);
  EXPECT_LE(static_cast<double>(out), 0.33 * static_cast<double>(in));
}

TEST(RelayHostile, RandomAndChangedDatagramsAreCountedAndDropped) {
  Watched watched;
  const auto net = watched.room.cluster.Attach(Address{0x0a000001, 1000});
  Random random(7);
  std::size_t in = 0;
  for (int n = 0; n < 5000; ++n) {
    Bytes bytes(1 + random.Next() % 1200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next() % 256);
    if (n % 3 == 0) {  // a session's or a handshake's beginning
      Hello hello;
      hello.name = "noise";
      const Bytes head =
          LooseDatagram(static_cast<std::uint64_t>(n) + 1, Encode(hello), kHandshakeBytes);
      std::copy_n(
          head.begin(),
          static_cast<std::ptrdiff_t>(std::min(bytes.size(), head.size() * (random.Next() % 2))),
          bytes.begin());
    }
    in += bytes.size();
    net->Send(watched.spot.address, bytes);
    if (n % 100 == 0) watched.room.Run(1);
  }
  watched.ExpectWatched(60);
  const Stats& stats = watched.spot.relay->watchers().stats();
  EXPECT_GT(stats.dropped_malformed + stats.dropped_right, 4000);
  EXPECT_LE(watched.BytesFor(net.get()), in / 3);
  EXPECT_EQ(watched.spot.relay->watchers().count(), 1);
}

/// A guest of the relay that has been welcomed, and says what the test wants.
struct Intruder {
  explicit Intruder(Watched* at, std::uint16_t number = 4711)
      : watched(at),
        guest(at->room.cluster.Attach(Address{0x0a000002, number}), number, "mallory") {
    guest.server = at->spot.address;
    at->room.each_instant = [this] {
      guest.Read(watched->room.cluster.now_us());
      if (guest.welcomed) guest.Flush(watched->room.cluster.now_us());
    };
    guest.SayHello();
    at->room.Run(6);
    guest.SayJoin();
    at->room.Run(12);
    EXPECT_TRUE(guest.welcomed);
    EXPECT_EQ(at->spot.relay->watchers().count(), 2);
  }
  Watched* watched;
  Guest guest;
};

TEST(RelayHostile, AWatcherThatActsLikeAPlayerChangesNothing) {
  Watched watched;
  Intruder intruder(&watched);
  const std::int64_t before = watched.spot.relay->watchers().stats().dropped_right;
  Release release;
  release.mechanism = {0};
  release.epoch = {1};
  Meta meta;
  meta.kind = {kMetaPlayer};
  meta.id = {0};
  meta.key = {kMetaHealth};
  meta.value = {7};
  Welcome welcome;
  welcome.peer = 1;
  welcome.room_bytes = 10;
  for (int n = 0; n < 5; ++n) {
    for (const Bytes& message :
         {Encode(ToOrder(Edit(RemoveEdit{0}))), Encode(release), Encode(meta), Encode(welcome)}) {
      intruder.guest.link.SendUnreliable(message);
    }
    watched.room.Run(2);
  }
  watched.ExpectWatched(60);
  EXPECT_GE(watched.spot.relay->watchers().stats().dropped_right, before + 20);
  EXPECT_EQ(watched.room.cluster.server().replica().revision(), 0);
}

TEST(RelayHostile, AWatcherThatSendsTooMuchHasToLeaveAndOneThatIsSilentToo) {
  Watched watched;
  Intruder intruder(&watched);
  // Silent: it acknowledges nothing, and is not sent to for long.
  watched.room.each_instant = nullptr;
  watched.ExpectWatched(60 * 5);
  EXPECT_EQ(watched.spot.relay->watchers().count(), 1);
  Intruder loud(&watched, 4712);
  Ping ping;
  bool left = false;
  for (int tick = 0; tick < 60 * 14 && !left; ++tick) {
    for (int n = 0; n < 300; ++n) loud.guest.link.SendUnreliable(Encode(ping));
    watched.room.Run(1);
    left = watched.spot.relay->watchers().count() == 1;
  }
  EXPECT_TRUE(left);
  EXPECT_GT(watched.spot.relay->watchers().stats().dropped_budget, 0);
  watched.ExpectWatched(30);
}

TEST(RelayHostile, AnAddressThatHasAnsweredNothingGetsFourTimesItsBytesAtMost) {
  Watched watched;
  Guest guest(watched.room.cluster.Attach(Address{0x0a000002, 1000}), 4711, "mallory");
  guest.server = watched.spot.address;
  guest.SayHello();
  watched.room.Run(6);
  guest.Read(watched.room.cluster.now_us());
  guest.SayJoin();
  watched.room.Run(120);  // it never answers the welcome
  const std::size_t out = watched.BytesFor(guest.net.get());
  EXPECT_GT(out, 0u);
  EXPECT_LE(out, PathProof::kBytesForEach * kDatagramBytesMax);
}

}  // namespace relay_hostile_test
}  // namespace seam
