/// Somebody on the path between a player and the server, or elsewhere with what he read there:
/// nothing that he sends has an effect.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <functional>
#include <memory>

#include "client/embed/cluster.h"
#include "common/net/datagram.h"
#include "common/net/loose_datagram.h"
#include "common/net/wire_number.h"
#include "tests/support/live_session.h"
#include "tests/support/path/link_keys.h"

namespace seam {
namespace path_attack_test {

/// A client's network that somebody reads, and on which he sends under the addresses of both ends.
/// It can also give the client another address, as a router does that has forgotten it.
class TappedNet : public Net {
 public:
  explicit TappedNet(std::unique_ptr<Net> net) : net_(std::move(net)) {}

  void Advance(std::int64_t now_us) override { net_->Advance(now_us); }
  void Flush() override { net_->Flush(); }
  void Send(const Address& to, ByteView datagram) override {
    server = to;
    Keep(&up, datagram);
    if (each_up) {
      const Bytes changed = each_up(Bytes(datagram.begin(), datagram.end()));
      if (!changed.empty()) net_->Send(to, changed);
    } else {
      net_->Send(to, datagram);
    }
  }
  bool Receive(Address* from, Bytes* datagram) override {
    if (!forged_down.empty()) {
      *from = server;
      *datagram = std::move(forged_down.front());
      forged_down.pop_front();
      return true;
    }
    if (!net_->Receive(from, datagram)) return false;
    Keep(&down, *datagram);
    if (each_down) *datagram = each_down(*datagram);
    return true;
  }
  std::int64_t discarded() const override { return net_->discarded(); }
  void ForgeUp(ByteView datagram) { net_->Send(server, datagram); }
  void Replace(std::unique_ptr<Net> net) { net_ = std::move(net); }

  Address server;
  std::deque<Bytes> up, down, forged_down;
  std::function<Bytes(Bytes)> each_up, each_down;

 private:
  static void Keep(std::deque<Bytes>* kept, ByteView datagram) {
    kept->emplace_back(datagram.begin(), datagram.end());
    if (kept->size() > 2000) kept->pop_front();
  }
  std::unique_ptr<Net> net_;
};

/// Two players, of whom ann's path is tapped.
struct Tapped {
  explicit Tapped(const std::string& impair = "perfect") {
    ClusterConfig config;
    config.impair = impair;
    config.drive = Drive::kBot;
    config.client_net = [this](std::size_t i, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
      if (i != 0) return net;
      auto tapped = std::make_unique<TappedNet>(std::move(net));
      tap = tapped.get();
      return tapped;
    };
    cluster = std::make_unique<Cluster>(config);
    cluster->RunToTick(60);
  }
  /// Expects that ann has stayed in her session.
  void ExpectUnharmed() const {
    EXPECT_EQ(cluster->client(0)->rejoins(), 0);
    EXPECT_TRUE(cluster->client(0)->running());
    EXPECT_EQ(cluster->client(0)->peer(), 1);
    EXPECT_EQ(cluster->server().client_count(), 2);
    EXPECT_LT(FindEvent(cluster->recording(), "is gone"), 0);
  }
  TappedNet* tap = nullptr;
  std::unique_ptr<Cluster> cluster;
};

Bytes ByeOf(std::uint64_t session) {
  Bye bye;
  bye.reason = "left";
  return LooseDatagram(session, Encode(bye));
}

TEST(PathAttack, ForgedGoodbyesAndEmptyDatagramsEndNobodysSession) {
  Tapped t;
  for (int n = 0; n < 240; ++n) {
    const Bytes& last = t.tap->up.back();
    const std::uint64_t session = SessionOfDatagram(last);
    t.tap->ForgeUp(ByeOf(session));
    t.tap->forged_down.push_back(ByeOf(session));
    // An empty datagram, 20000 numbers ahead, sealed with keys that are not the session's.
    DatagramWriter writer;
    SealKeys keys = LinkKeys(5);
    keys.session = session;
    t.tap->ForgeUp(writer.Finish({SequenceOfDatagram(last) + 20'000, 0, 0}, Seal(keys)));
    t.cluster->RunToTick(t.cluster->server().tick() + 1);
  }
  t.cluster->RunToTick(60 * 8);
  t.ExpectUnharmed();
}

TEST(PathAttack, DatagramsThatAreChangedOnTheWayCountAsLost) {
  Tapped t;
  const std::int64_t malformed = t.cluster->server().stats().dropped_malformed;
  int n = 0, changed = 0;
  t.tap->each_up = [&](Bytes datagram) {
    if (++n % 2 == 0) return datagram;
    ++changed;
    std::uint8_t& byte = datagram[static_cast<std::size_t>(n * 7) % datagram.size()];
    byte = static_cast<std::uint8_t>(byte ^ (1u << (n % 8)));
    return datagram;
  };
  t.cluster->RunToTick(60 * 6);
  t.ExpectUnharmed();
  const Stats& stats = t.cluster->server().stats();
  EXPECT_GT(changed, 40);
  EXPECT_GE(stats.dropped_malformed + stats.dropped_right - malformed, changed - 2);
}

TEST(PathAttack, RecordedDatagramsAreWorthNothingFromAnywhere) {
  Tapped t;
  t.cluster->RunToTick(180);
  const std::deque<Bytes> up = t.tap->up, down = t.tap->down;
  const std::unique_ptr<Net> thief = t.cluster->Attach(Address{0x0a000001, 1000});
  const Address server = t.cluster->server_address();
  std::size_t came = 0;
  for (std::size_t n = 0; n < up.size() || n < down.size(); n += 4) {
    for (std::size_t i = n; i < n + 4; ++i) {
      if (i < up.size()) t.tap->ForgeUp(up[i]), thief->Send(server, up[i]);
      if (i < down.size()) t.tap->forged_down.push_back(down[i]);
    }
    t.cluster->RunToTick(t.cluster->server().tick() + 1);
    Address from;
    Bytes datagram;
    while (thief->Receive(&from, &datagram)) came += SessionOfDatagram(datagram) != 0 ? 1 : 0;
  }
  EXPECT_EQ(came, 0u) << "the session did not move to the thief";
  t.ExpectUnharmed();
}

TEST(PathAttack, APlaceIsNotTakenByReadingThePath) {
  Tapped t;
  t.cluster->RunToTick(120);
  // All that can be read: nowhere is the key of her place in the open.
  const auto key = static_cast<std::uint64_t>(t.cluster->client(0)->key());
  std::uint8_t bytes[8];
  PutNumber(bytes, key, 8);
  for (const std::deque<Bytes>* way : {&t.tap->up, &t.tap->down}) {
    for (const Bytes& datagram : *way) {
      EXPECT_TRUE(std::search(datagram.begin(), datagram.end(), bytes, bytes + 8) ==
                  datagram.end());
    }
  }
}

TEST(PathAttack, AClientGoesOnFromAnotherAddressWithinARoundTrip) {
  for (const char* impair : {"perfect", "demo", "4g"}) {
    Tapped t(impair);
    std::int64_t worst_us = 0;
    for (std::uint16_t change = 0; change < 5; ++change) {
      t.tap->Replace(
          t.cluster->Attach(Address{0x0a000002, static_cast<std::uint16_t>(500 + change)}));
      t.tap->down.clear();
      const std::int64_t at_us = t.cluster->now_us();
      while (t.tap->down.empty() && t.cluster->now_us() < at_us + 2'000'000) {
        t.cluster->RunToTick(t.cluster->server().tick() + 1);
      }
      worst_us = std::max(worst_us, t.cluster->now_us() - at_us);
      t.cluster->RunToTick(t.cluster->server().tick() + 60);
    }
    std::printf("[          ] %s: %.0f ms at worst\n", impair,
                static_cast<double>(worst_us) / 1000.0);
    EXPECT_LT(worst_us, 500'000) << impair;
    t.ExpectUnharmed();
  }
}

}  // namespace path_attack_test
}  // namespace seam
