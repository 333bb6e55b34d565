#pragma once
/// The room's authority: admits clients, keeps the timeline, plans who simulates what, validates
/// and relays, and publishes everything accepted. A function of the time and the datagrams it is
/// given: the same Server runs over UDP and in virtual time.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/net/net.h"
#include "common/record/recorder.h"
#include "common/sync/publisher.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/session.h"

namespace seam {

class RoomCommands;
class Rules;

struct ServerConfig {
  SyncConfig sync;
  std::string room = "main";
  std::string impair = "perfect";  ///< for the record only
  std::int64_t seed = 1;
  int wait_players = 0;  ///< tick 0 comes when this many players are ready
};

class Server {
 public:
  /// `net` and `recorder` must outlive the server.
  Server(const Scene& scene, const ServerConfig& config, Net& net, Recorder& recorder);
  ~Server();

  /// Receives, steps the ticks that are due, sends. `now_us`: any clock that never runs backwards;
  /// `cpu_us`: CPU time used so far, for the record (0 when unknown).
  void Tick(std::int64_t now_us, std::int64_t cpu_us);
  /// When the next tick is due on the clock of Tick; INT64_MAX before the room starts.
  std::int64_t next_tick_us() const;
  /// Says goodbye to everyone; call Tick no more.
  void Shutdown(std::int64_t now_us, const std::string& reason);

  bool started() const { return tick0_us_ >= 0; }
  std::int64_t tick() const { return replica_.tick(); }
  int client_count() const { return static_cast<int>(sessions_.size()); }
  const Stats& stats() const { return stats_; }
  const Replica& replica() const { return replica_; }
  World& world() { return replica_.world(); }
  /// Orders an edit at the next tick, or as soon as its parts are in one hand. One that cannot be
  /// is dropped; Topology::Complaint tells beforehand.
  void Order(const Edit& edit);
  /// What it decides of health, scores and scripts; nullptr when the scene has nothing of it.
  const Rules* rules() const { return rules_.get(); }

  /// A client not heard for this long is gone. Its own patience (Client::kSilentUs) is shorter, so
  /// that it has let go of its mechanisms before the server takes them back.
  static constexpr std::int64_t kSilentUs = 3000000;
  /// From the last player's readiness to tick 0, us: time for the answer to reach everyone.
  static constexpr std::int64_t kLeadInUs = 1000000;
  /// A peer whose composition differs is repaired at most this often, us.
  static constexpr std::int64_t kRepairAgainUs = 3000000;

 private:
  using Sessions = std::map<Address, std::unique_ptr<Session>>;

  // server_edits.cpp
  void OnProposal(Session& session, const EditOrder& order);
  std::vector<int> MechanismsOf(const Edit& edit) const;
  void OrderPending(std::int64_t now_us);
  void FollowTopology(const std::optional<BodyRemap>& change);
  void CheckComposition(std::int64_t now_us, Session& session, const Ping& ping);
  /// Edits, grants and states: all that a peer needs to have our world.
  void SendWorld(std::int64_t now_us, Session& session);

  // server_seats.cpp
  void UpdateSeats();
  bool PlayerSits(int player) const;
  bool GetIn(int player, int seat);
  void GetOut(int seat);

  // server_receive.cpp
  void ReceiveAll(std::int64_t now_us);
  void OnDatagram(std::int64_t now_us, const Address& from, const Bytes& datagram);
  void OnMessage(std::int64_t now_us, Session& session, ByteView bytes);
  void OnHello(std::int64_t now_us, Session& session, const Hello& hello);
  void OnInputs(std::int64_t now_us, Session& session, const Inputs& inputs);
  void OnStates(std::int64_t now_us, Session& session, const States& states);
  bool Plausible(int body, std::int64_t tick, const BodyState& state);

  // server_sessions.cpp
  void Admit(std::int64_t now_us, Session& session, const std::string& name);
  void Refuse(std::int64_t now_us, const Address& to, std::uint64_t number,
              const std::string& reason);
  void Advance(std::int64_t now_us, Session& session);
  /// Makes room by dropping the oldest session that has not proved its address; false if none.
  bool EvictUnproven(std::int64_t now_us);
  void DropSilent(std::int64_t now_us);
  void Drop(std::int64_t now_us, const Address& address, const std::string& why);
  void FlushAll(std::int64_t now_us);
  std::vector<int> PeerOfPlayer() const;

  // server_rules.cpp
  class Commands;
  void MakeRules();
  void RunRules(std::int64_t now_us);
  void SendRules(std::int64_t now_us, Session& session);

  // server.cpp
  void StartIfReady(std::int64_t now_us);
  void StepOnce(std::int64_t now_us);
  void UpdateAuthority(std::int64_t now_us);
  void Announce(const std::vector<Grants>& messages);
  /// Reliably, to everyone who has proved its address; who never acknowledges has to leave.
  void SendToAll(const Bytes& message);
  void Relay(const States& states, int from_peer);
  void Say(std::int64_t now_us, const std::string& text);
  void PublishStats(std::int64_t now_us, std::int64_t cpu_us);
  Room MakeRoom(std::int64_t utime) const;

  const Scene scene_;
  ServerConfig config_;
  Net& net_;
  Publisher publisher_;
  Replica replica_;
  AuthorityManager authority_;
  Sessions sessions_;
  std::unique_ptr<RoomCommands> commands_;
  std::unique_ptr<Rules> rules_;  // null: the scene has nothing to decide
  std::int64_t rules_us_ = 0;     // the time of the tick they look at
  struct Pending {
    Edit edit;
    int peer = 0;            // who proposed it
    std::int64_t since = 0;  // tick
  };
  std::vector<Pending> pending_;             // in the order of coming
  std::vector<EditOrder> edits_;             // all that were ordered, by number
  std::map<int, std::uint64_t> hash_after_;  // of the composition, by number of edits applied
  bool full_ = false;                        // no more edits
  struct LastAccepted {
    std::int64_t tick = -1;
    Vec2 position{0, 0};
  };
  std::vector<LastAccepted> accepted_;  // by body
  std::int64_t tick0_us_ = -1;
  std::int64_t last_room_us_ = -1000000000;
  std::int64_t last_stats_us_ = -1000000000;
  std::int64_t worst_late_us_ = 0;
  std::int64_t discarded_ = 0;  // by the net, as far as counted in stats_
  Stats stats_;
};

}  // namespace seam
