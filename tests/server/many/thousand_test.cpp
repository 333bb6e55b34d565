/// A room of a thousand players: real sessions in virtual time, whose clients are as light as can
/// be. Each drives a sled beside its neighbours and tells its states.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "common/base/process.h"
#include "common/codec/packed/packed_inputs.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/sync/method.h"
#include "common/sync/quantize.h"
#include "server/server.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace thousand_test {

constexpr int kPlains = 4;
constexpr int kTickHz = 60;

/// Four plains one above another, with so many sleds each, 20 m apart, and a crate beside each
/// fourth.
std::string Plains(int each) {
  const std::string end = std::to_string(20 * each + 50);
  const std::string copies = "repeat = {count = " + std::to_string(each) + ", step = [20, 0]}\n";
  const std::string few = "repeat = {count = " + std::to_string(each / 4) + ", step = [80, 0]}\n";
  std::string text = "bounds = [[-100, -50], [" + end + ", 1200]]\nbuffer = 8\n";
  for (int plain = 0; plain < kPlains; ++plain) {
    const std::string name(1, static_cast<char>('a' + plain)), y = std::to_string(300 * plain);
    text +=
        "[[player]]\nname = \"" + name + "\"\nvehicle = \"sled-" + name + ".0\"\n" + copies +
        "[[part]]\nname = \"ground-" + name + "\"\nsegment = [[-90, " + y + "], [" + end + ", " +
        y + "]]\n[[part]]\nname = \"sled-" + name + "\"\nbox = [2.6, 0.6]\nposition = [0, " + y +
        ".3]\nfriction = 0.6\nconveyor = {player = \"" + name + "-0\", speed = 3}\nowners = [\"" +
        name + "-*\"]\n" + copies + "[[part]]\nname = \"crate-" + name +
        "\"\nbox = [0.7, 0.7]\nposition = [6, " + y + ".36]\n" + few;
  }
  return text;
}

/// A client that drives its sled to and fro by itself.
struct Driver {
  Driver(MemoryNetwork* network, const Scene& scene, int of)
      : guest(network, static_cast<std::uint16_t>(1000 + of),
              scene.players[static_cast<std::size_t>(of)].name),
        unpacker(PackedMotion(scene.gravity.x(), scene.gravity.y(), kTickHz)),
        player(of),
        vehicle(scene.players[static_cast<std::size_t>(of)].vehicle),
        parts(static_cast<std::int32_t>(scene.parts.size())),
        home(scene.parts[static_cast<std::size_t>(vehicle)].position) {}

  void Read(std::int64_t now_us) {
    guest.Read(now_us, [this](const AnyMessage& any) {
      if (const auto* grants = std::get_if<Grants>(&any)) Take(*grants);
      if (const auto* packed = std::get_if<PackedInputs>(&any)) {
        const std::vector<Inputs> inputs = UnpackInputs(*packed).value_or(std::vector<Inputs>{});
        for (const Inputs& one : inputs) heard.insert(one.player);
      }
      const auto* states = std::get_if<PackedStates>(&any);
      const std::vector<States>* const all = states ? unpacker.Take(*states, parts) : nullptr;
      for (std::size_t i = 0; all != nullptr && i < all->size(); ++i) {
        seen.insert((*all)[i].id.begin(), (*all)[i].id.end());
      }
    });
  }
  /// The first means that the room has been sent. Lets go at once of all that it is asked for.
  void Take(const Grants& grants) {
    if (!ready) guest.link.SendReliable(Encode(Ready()));
    ready = true;
    Release release;
    for (std::size_t i = 0; i < grants.mechanism.size(); ++i) {
      const PartId id = grants.mechanism[i];
      const bool had = held.erase(id) != 0;
      if (grants.authority[i] == player + 1) {
        held[id] = grants.epoch[i];
      } else if (had && grants.authority[i] == 0) {
        release.mechanism.push_back(id);
        release.epoch.push_back(grants.epoch[i]);
      }
    }
    release.tick = std::max<std::int64_t>(0, told);
    if (!release.mechanism.empty()) guest.link.SendReliable(Encode(release));
  }
  bool Drives() const { return held.count(vehicle) != 0; }
  void Send(std::int64_t now_us, std::int64_t tick, std::int64_t composition) {
    if (!guest.welcomed) {
      guest.challenge ? guest.SayJoin() : guest.SayHello();
      return;
    }
    if (ready && tick > 0 && tick > told + 1) Tell(tick, composition);
    guest.Flush(now_us);
  }
  void Tell(std::int64_t tick, std::int64_t composition) {
    told = tick;
    Inputs inputs;
    inputs.player = player;
    inputs.first_tick = tick;
    for (int i = 0; i < 2; ++i) {
      inputs.drive.push_back(static_cast<std::int8_t>((tick + player) % 100));
      inputs.lift.push_back(0);
      inputs.buttons.push_back(0);
    }
    guest.link.SendUnreliable(Encode(inputs));
    if (!Drives()) return;
    States header;
    header.peer = player + 1;
    header.tick = tick;
    header.composition = composition;
    const float time_s = static_cast<float>(tick + player) / kTickHz;
    BodyState state;
    state.position = home + Vec2(std::sin(time_s), 0);
    state.velocity = Vec2(std::cos(time_s), 0);
    WireBody body = Quantise(state);
    body.id = vehicle;
    body.epoch = held[vehicle];
    body.tick = tick;
    for (const States& states : Pack(header, {body})) guest.link.SendUnreliable(Encode(states));
  }

  Guest guest;
  StatesUnpacker unpacker;
  const int player;
  const PartId vehicle;
  const std::int32_t parts;
  const Vec2 home;
  bool ready = false;
  std::map<PartId, std::int32_t> held;  // mechanisms that it has, and their epochs
  std::int64_t told = 0;
  std::set<int> heard;  // players
  std::set<int> seen;   // bodies of others
};

class Silence : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView) override {}
  bool listening() const override { return false; }
};

ServerConfig Config() {
  ServerConfig config;
  config.sync = MakeSyncConfig(MethodNames{"buffer", "", ""});
  config.sync.tick_hz = kTickHz;
  config.publish = Publish::kNone;
  config.trust = TrustMode::kWatch;  // the drivers' sleds move by no physics
  return config;
}

class Room {
 public:
  explicit Room(int columns)
      : scene(ParseScene(Plains(columns), "plains.toml")),
        entropy_(7),
        net_(network_.Attach(Guest::kServer)),
        server(scene, Config(), *net_, silence_, entropy_) {
    for (int p = 0; p < static_cast<int>(scene.players.size()); ++p) {
      drivers.push_back(std::make_unique<Driver>(&network_, scene, p));
    }
  }
  /// Runs for so many ticks, four instants each.
  void Run(int ticks) {
    const auto composition = static_cast<std::int64_t>(server.replica().world().composition().hash);
    for (int instant = 0; instant < 4 * ticks; ++instant) {
      now_us_ += 1000000 / kTickHz / 4;
      for (std::size_t p = static_cast<std::size_t>(instant) % 4; p < drivers.size(); p += 4) {
        drivers[p]->Read(now_us_);
        drivers[p]->Send(now_us_, server.tick(), composition);
      }
      const std::int64_t before_us = ThreadCpuUs();
      server.Tick(now_us_, 0);
      if (instant % 4 == 0) ticks_us_.push_back(0);
      ticks_us_.back() += static_cast<double>(ThreadCpuUs() - before_us);
    }
  }
  bool AllDrive() const {
    return std::all_of(drivers.begin(), drivers.end(),
                       [](const auto& each) { return each->Drives(); });
  }
  /// Measures a second in which all play in each of the rooms: in turns, so that a machine that
  /// slows down slows all.
  static void Measure(const std::vector<Room*>& rooms) {
    constexpr int kJoiningMost = 600, kSettle = 60, kMeasured = 60, kTurn = 10;
    std::vector<double> before;
    for (Room* room : rooms) {
      for (int ticks = 0; ticks < kJoiningMost && !room->AllDrive(); ++ticks) room->Run(1);
      room->Run(kSettle);
      room->ticks_us_.clear();
      before.push_back(room->Bytes());
    }
    for (int ticks = 0; ticks < kMeasured; ticks += kTurn) {
      for (Room* room : rooms) room->Run(kTurn);
    }
    const double seconds = kMeasured / static_cast<double>(kTickHz);
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      Room& room = *rooms[i];
      room.kbps_to_each =
          (room.Bytes() - before[i]) * 1e-3 / seconds / static_cast<double>(room.drivers.size());
      room.tick_us = std::accumulate(room.ticks_us_.begin(), room.ticks_us_.end(), 0.0) / kMeasured;
      room.longest_us = *std::max_element(room.ticks_us_.begin(), room.ticks_us_.end());
    }
  }

 private:
  MemoryNetwork network_;
  Silence silence_;

 public:
  const Scene scene;

 private:
  SeededEntropy entropy_;
  std::unique_ptr<Net> net_;
  std::int64_t now_us_ = 1000000;

 public:
  Server server;
  std::vector<std::unique_ptr<Driver>> drivers;
  double tick_us = 0, longest_us = 0;  // CPU time of the server
  double kbps_to_each = 0;             // kB/s

 private:
  double Bytes() const {
    double sum = 0;
    for (const auto& driver : drivers) sum += static_cast<double>(driver->guest.bytes_in);
    return sum;
  }
  std::vector<double> ticks_us_;  // of the server
};

TEST(Thousand, PlayersOfOneRoomDriveAndHearTheirNeighboursAtACostThatGrowsWithThem) {
  Room some(32), room(250);
  Room::Measure({&some, &room});
  ASSERT_EQ(room.server.player_count(), kPlayersMax);
  EXPECT_TRUE(room.AllDrive());
  int hearers = 0;  // of the inputs of those whose sleds they may touch
  for (const auto& driver : room.drivers) {
    EXPECT_FALSE(driver->seen.empty()) << driver->player;
    hearers += driver->heard.empty() ? 0 : 1;
    for (const int player : driver->heard) {
      const Vec2 way = room.drivers[static_cast<std::size_t>(player)]->home - driver->home;
      EXPECT_LT(way.norm(), 2 * 120) << driver->player << " heard " << player;
    }
  }
  EXPECT_GT(hearers, 0);
  EXPECT_EQ(room.server.stats().dropped_malformed, 0);
  EXPECT_EQ(room.server.stats().dropped_right, 0);
  const double power = std::log(room.tick_us / some.tick_us) / std::log(1000.0 / 128);
  std::printf(
      "[          ] 128 players: %.0f us a tick (longest %.0f), %.1f kB/s to each; 1000: %.0f "
      "(%.0f), "
      "%.1f; N^%.2f; %d hear inputs\n",
      some.tick_us, some.longest_us, some.kbps_to_each, room.tick_us, room.longest_us,
      room.kbps_to_each, power, hearers);
  // Of the bodies out of interest each is told so many a second, however large the room.
  constexpr double kDistantKbps = 0.02 * Broadcast::kDistantPerSecond;
  EXPECT_LT(room.kbps_to_each, some.kbps_to_each + kDistantKbps);
  EXPECT_LT(power, 1.6) << "the cost of a player must not grow with the room";
}

}  // namespace thousand_test
}  // namespace seam
