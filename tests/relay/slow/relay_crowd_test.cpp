/// Many watchers behind four relays: they cost the server four clients. `make soak` has 5000.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/codec/packed/states_unpacker.h"
#include "server/relay/relay.h"
#include "tests/relay/relayed_room.h"
#include "tests/support/session_guest.h"
#include "tests/support/soak.h"

namespace seam {
namespace relay_crowd_test {

/// A watcher without a world: joins, says Ready, pings, acknowledges, and unpacks all states.
class LightWatcher {
 public:
  LightWatcher(Cluster* cluster, const Address& relay, std::uint32_t number,
               const PackedMotion& motion)
      : guest_(cluster->Attach(Address{0x0d000000 + number, 9000}), 100000 + number,
               "w" + std::to_string(number)),
        unpacker_(motion) {
    guest_.server = relay;
  }
  void Tick(std::int64_t now_us) {
    guest_.Read(now_us, [&](const AnyMessage& any) { Take(any); });
    if (!guest_.welcomed) return Join(now_us);
    if (room_bytes_ > 0 && received_ == room_bytes_ && !ready_) {
      ready_ = true;
      guest_.link.SendReliable(Encode(Ready()));
    }
    if (now_us - pinged_us_ >= 100000) {
      pinged_us_ = now_us;
      Ping ping;
      ping.utime = now_us;
      guest_.link.SendUnreliable(Encode(ping));
    }
    guest_.Flush(now_us);
  }
  bool ready() const { return ready_; }
  std::int64_t newest() const { return newest_; }  ///< tick of the newest state
  std::int64_t states() const { return states_; }
  std::int64_t tick0_us() const { return tick0_us_; }
  std::size_t bytes_in() const { return guest_.bytes_in; }

 private:
  void Join(std::int64_t now_us) {
    if (now_us - said_us_ < 100000) return;
    said_us_ = now_us;
    if (guest_.challenge) {
      guest_.SayJoin();
    } else {
      guest_.SayHello();
    }
  }
  void Take(const AnyMessage& any) {
    if (const auto* welcome = std::get_if<Welcome>(&any)) room_bytes_ = welcome->room_bytes;
    if (const auto* pong = std::get_if<Pong>(&any)) tick0_us_ = pong->tick0_us;
    if (const auto* chunk = std::get_if<Chunk>(&any)) {
      received_ += static_cast<std::int32_t>(chunk->data.size());
    }
    const auto* packed = std::get_if<PackedStates>(&any);
    if (packed == nullptr) return;
    const std::vector<States>* const all = unpacker_.Take(*packed);
    ASSERT_NE(all, nullptr);
    for (const States& states : *all) {
      newest_ = std::max(newest_, states.tick);
      states_ += static_cast<std::int64_t>(states.id.size());
    }
  }

  Guest guest_;
  StatesUnpacker unpacker_;
  bool ready_ = false;
  std::int32_t room_bytes_ = 0, received_ = 0;
  std::int64_t said_us_ = -1000000, pinged_us_ = -1000000;
  std::int64_t newest_ = -1, states_ = 0, tick0_us_ = -1;
};

/// A room with four relays and their watchers.
struct Crowd {
  Crowd(const ClusterConfig& config, int count) : room(config) {
    const Scene& scene = room.cluster.scene();
    const PackedMotion motion(scene.gravity.x(), scene.gravity.y(), scene.solver.tick_hz);
    for (int r = 0; r < 4; ++r) room.AddRelay();
    for (int w = 0; w < count; ++w) {
      watchers.push_back(std::make_unique<LightWatcher>(
          &room.cluster, room.spots[static_cast<std::size_t>(w % 4)]->address,
          static_cast<std::uint32_t>(w), motion));
    }
    // Each watcher's process wakes every 16 ms; they take turns.
    room.each_instant = [this] {
      const auto all = static_cast<std::int64_t>(watchers.size());
      const std::int64_t passed_us = room.cluster.now_us() - last_us;
      last_us = room.cluster.now_us();
      const std::int64_t due = std::min(all, all * passed_us / 16000 + 1);
      for (std::int64_t i = 0; i < due; ++i, ++next) {
        watchers[static_cast<std::size_t>(next % all)]->Tick(room.cluster.now_us());
      }
    };
  }
  int Ready() const {
    return static_cast<int>(
        std::count_if(watchers.begin(), watchers.end(), [](const auto& w) { return w->ready(); }));
  }

  RelayedRoom room;
  std::vector<std::unique_ptr<LightWatcher>> watchers;
  std::int64_t last_us = 0, next = 0;
};

TEST(RelayCrowdCluster, ACrowdBehindFourRelaysCostsItsServerFourClients) {
  const bool soak = Soak(1) > 1;
  const int count = soak ? 5000 : 200;
  ClusterConfig config;
  config.scene = "arena";
  config.impair = "perfect";
  config.drive = Drive::kBot;
  config.publish = Publish::kNone;
  config.keep = false;
  Crowd crowd(config, count);
  config.spectators = 4;
  Cluster beside(config);  // the same room with four watching clients
  // In one process the watchers take the processor's caches from the server. On another machine
  // they do not: so something else takes them from the other server, too.
  std::vector<std::uint64_t> other(soak ? 4 << 20 : 0);
  beside.each_instant = [&other] {
    for (std::size_t i = 0; i < other.size(); i += 8) ++other[i];
  };
  constexpr std::int64_t kFrom = 240, kTo = 720;
  double crowd_us = 0, beside_us = 0, relays_us = 0;
  std::int64_t crowd_bytes = 0, beside_bytes = 0, relayed_bytes = 0, watcher_bytes = 0;
  const auto note = [&](int sign) {
    crowd_us += sign * crowd.room.cluster.server_cpu_us();
    beside_us += sign * beside.server_cpu_us();
    crowd_bytes += sign * crowd.room.cluster.server().stats().bytes_out;
    beside_bytes += sign * beside.server().stats().bytes_out;
    for (const ClientAccount& client : beside.server().accounts()) {
      if (client.player < 0) watcher_bytes += sign * client.bytes_out;
    }
    for (const auto& spot : crowd.room.spots) {
      relays_us += sign * spot->cpu_us;
      relayed_bytes += sign * spot->relay->watchers().stats().bytes_out;
    }
  };
  // In turns, so that a busy machine slows both.
  for (std::int64_t tick = 1; tick <= kTo; ++tick) {
    crowd.room.cluster.RunToTick(tick);
    beside.RunToTick(tick);
    if (tick == kFrom) note(-1);
  }
  note(1);
  EXPECT_EQ(crowd.Ready(), count);
  EXPECT_EQ(crowd.room.cluster.server().client_count(), beside.server().client_count());
  EXPECT_LT(crowd_us, 1.2 * beside_us);
  EXPECT_LT(static_cast<double>(crowd_bytes), 1.1 * static_cast<double>(beside_bytes));
  std::int64_t latest = INT64_MAX, fewest = INT64_MAX;
  for (const auto& watcher : crowd.watchers) {
    latest = std::min(latest, watcher->newest());
    fewest = std::min(fewest, watcher->states());
  }
  EXPECT_GT(latest, kTo - 30) << "everybody has what moves";
  EXPECT_GT(fewest, 1000);
  const double seconds = static_cast<double>(kTo - kFrom) / 60;
  const double each = 1.0 / (count * seconds);
  std::printf(
      "[          ] %d watchers: the server %.2f times the CPU and %.2f times the bytes of "
      "four clients; a relay %.1f us and %.0f B for each watcher and second\n",
      count, crowd_us / beside_us,
      static_cast<double>(crowd_bytes) / static_cast<double>(beside_bytes), relays_us * each,
      static_cast<double>(relayed_bytes) * each);
  std::printf("[          ] a watcher at the server gets %.0f B a second\n",
              static_cast<double>(watcher_bytes) / (4 * seconds));
}

}  // namespace relay_crowd_test
}  // namespace seam
