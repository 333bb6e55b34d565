#pragma once
/// A server without clients, with players driven by the scene's scripts or by bots, and the server
/// that continues it from its saved state.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "common/base/bytes.h"
#include "common/net/memory.h"
#include "common/sync/inputs/input_source.h"
#include "common/sync/method.h"
#include "server/room_state.h"
#include "server/server.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {

/// Makes the hash of a changed saved room right again, as somebody would who means harm.
inline void SignSavedRoom(Bytes* bytes) {
  const std::uint64_t hash = Fnv1a(bytes->data() + 24, bytes->size() - 24);
  std::memcpy(bytes->data() + 16, &hash, sizeof hash);
}

class LoneRoom {
 public:
  static constexpr Address kServer{1, 7777};

  explicit LoneRoom(const Scene& scene, const std::string& method = "buffer")
      : config_(ConfigOf(scene, method)), entropy_(7), net_(network.Attach(kServer)) {
    server = std::make_unique<Server>(scene, config_, *net_, silence_, entropy_);
    Start();
  }
  /// Continues a saved room; `server` is null if that is refused.
  LoneRoom(const Bytes& bytes, const std::string& method)
      : entropy_(8), net_(network.Attach(kServer)) {
    const std::unique_ptr<const SavedRoom> saved = SavedRoom::Read(bytes, &status);
    if (saved == nullptr) return;
    config_ = ConfigOf(saved->scene(), method);
    server = std::make_unique<Server>(*saved, config_, *net_, silence_, entropy_);
    status = server->Resume(*saved, now_us);
    if (!status.ok()) {
      server.reset();
    } else if (server->started()) {
      Start();
    }
  }

  /// Does one tick, with the players' inputs of it.
  void Step() {
    Replica& replica = ServerTestAccess::ReplicaOf(*server);
    const std::int64_t tick = server->tick() + 1;
    for (int p = 0; p < static_cast<int>(server->scene().players.size()); ++p) {
      replica.RecordInput(p, tick, InputOf(p, tick));
    }
    if (!server->started()) Start();  // a saved room may not have started
    now_us = std::max(now_us, server->next_tick_us());
    server->Tick(now_us, 0);
    ASSERT_EQ(server->tick(), tick);
  }
  void StepTo(std::int64_t tick) {
    while (server->tick() < tick) Step();
  }
  std::uint64_t Hash() const { return server->replica().world().Hash(); }
  Bytes Save() { return server->Save(now_us); }

  MemoryNetwork network;
  Status status;  ///< why the saved room was refused
  std::int64_t now_us = 1000000;
  std::unique_ptr<Server> server;
  /// Ticks at which every player presses the buttons of all seats.
  std::vector<std::int64_t> seat_ticks{20, 400};

 private:
  class Silence : public Recorder {
   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };

  static ServerConfig ConfigOf(const Scene& scene, const std::string& method) {
    ServerConfig config;
    const std::string::size_type slash = method.find('/');
    MethodNames names;
    names.mode = method.substr(0, slash);
    if (slash != std::string::npos) names.reconcile = method.substr(slash + 1);
    config.sync = MakeSyncConfig(names);
    config.sync.tick_hz = scene.solver.tick_hz;
    config.publish = Publish::kNone;
    return config;
  }

  void Start() { server->Tick(now_us, 0); }

  /// The script's input; a bot's for a player without one.
  Input InputOf(int player, std::int64_t tick) const {
    const Scene& scene = server->replica().world().scene();
    Input input = scene.players[static_cast<std::size_t>(player)].script.empty()
                      ? BotInput(1, player, tick, scene.solver.tick_hz)
                      : ScriptedInput(scene, player, tick);
    if (std::count(seat_ticks.begin(), seat_ticks.end(), tick) == 0) return input;
    for (const Seat& seat : scene.seats) {
      input.buttons = static_cast<std::int16_t>(input.buttons | 1 << seat.button);
    }
    return input;
  }

  ServerConfig config_;
  Silence silence_;
  SeededEntropy entropy_;
  std::unique_ptr<Net> net_;
};

}  // namespace seam
