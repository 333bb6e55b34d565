#pragma once
/// The room's loop: receives, steps the ticks that are due, sends. What follows from a tick, a
/// message or a join is decided by its members, one question each. A function of the time
/// and the datagrams it is given: the same Server runs over UDP and in virtual time.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/base/entropy.h"
#include "common/net/net.h"
#include "common/record/recorder.h"
#include "common/sync/publish.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/broadcast.h"
#include "server/edits/edit_log.h"
#include "server/room_clock.h"
#include "server/rules/bounds_watch.h"
#include "server/rules/seats.h"
#include "server/server_stats.h"
#include "server/sessions/session_table.h"
#include "server/state_filter.h"

namespace seam {

class AuthoritySource;
class Rules;
class ServerCommands;

struct ServerConfig {
  SyncConfig sync;
  std::string room = "main";
  std::string impair = "perfect";  ///< for the record only
  std::int64_t seed = 1;
  int wait_players = 0;  ///< tick 0 comes when this many players are ready
  /// Of UDP payload to each client, at most; 0: no limit.
  double client_bytes_per_s = kClientBytesPerS;
  Publish publish = Publish::kAll;
};

class Server {
 public:
  /// `net`, `recorder` and `entropy` must outlive the server. Who can guess what `entropy` gives
  /// can take any player's place.
  Server(const Scene& scene, const ServerConfig& config, Net& net, Recorder& recorder,
         Entropy& entropy);
  ~Server();

  /// Receives, steps the ticks that are due, sends. `now_us`: any clock that never runs backwards;
  /// `cpu_us`: CPU time used so far, for the record (0 when unknown); read where stats_due.
  void Tick(std::int64_t now_us, std::int64_t cpu_us);
  bool stats_due(std::int64_t now_us) const { return stats_.Due(now_us); }
  /// When the next tick is due on the clock of Tick; INT64_MAX before the room starts.
  std::int64_t next_tick_us() const;
  /// Says goodbye to everyone; call Tick no more.
  void Shutdown(std::int64_t now_us, const std::string& reason);

  bool started() const { return clock_.started(); }
  std::int64_t tick() const { return replica_.tick(); }
  int client_count() const { return sessions_.count(); }
  /// Players of the scene who are in the room.
  int player_count() const { return sessions_.player_count(); }
  const Stats& stats() const { return stats_.counters; }
  /// Parts that were removed because they had left the scene's bounds, since the start.
  std::int64_t left_bounds() const { return bounds_.left(); }
  /// Messages of sessions that were decoded, since the start.
  std::int64_t decoded() const { return stats_.decoded; }
  /// Hand-overs at which our copy was visibly off, since the start.
  std::int64_t jumps() const { return stats_.jumps; }
  /// Of the room's clock, per million of real time: below kFullSpeedPpm we are overloaded.
  std::int32_t speed_ppm() const { return clock_.speed_ppm(); }
  const Replica& replica() const { return replica_; }
  /// An edit from outside; see EditLog::Add.
  bool Order(const Edit& edit) { return edits_.Add(edit); }
  /// What the operator should read since the last call: a script was stopped. One line each.
  std::vector<std::string> TakeWarnings();
  /// Who came and went since the last call, for people, one line each; the first 256.
  std::vector<std::string> TakeReports() { return std::exchange(news_, {}); }
  /// The scene's players who are not in the room.
  std::vector<std::string> missing() const;
  const Scene& scene() const { return scene_; }
  /// What each client's sessions have come to so far.
  std::vector<ClientAccount> accounts() const { return sessions_.accounts().List(); }
  /// What it decides of health, scores and scripts; nullptr when the scene has nothing of it.
  const Rules* rules() const { return rules_.get(); }

  /// From the last player's readiness to tick 0, us: time for the answer to reach everyone.
  static constexpr std::int64_t kLeadInUs = 1000000;
  /// A peer whose composition differs is repaired at most this often, us.
  static constexpr std::int64_t kRepairAgainUs = 3000000;

 private:
  friend struct ServerTestAccess;

  // server_receive.cpp
  void ReceiveAll(std::int64_t now_us);
  /// OnMessage; what it drops goes to the session's account.
  void Deliver(std::int64_t now_us, Session& session, ByteView bytes);
  void OnMessage(std::int64_t now_us, Session& session, ByteView bytes);
  /// A client whose name is no player's asks which are free.
  void OnHello(std::int64_t now_us, Session& session);
  void OnPing(std::int64_t now_us, Session& session, const Ping& ping);
  void OnInputs(std::int64_t now_us, Session& session, const Inputs& inputs);
  void RelayInputs(std::int64_t now_us);
  void RelayInputs(std::int64_t now_us, const std::vector<int>& players, Session& session);
  void FindHeardPlayers();
  Inputs TakeFresh(std::int64_t now_us, const Inputs& inputs);
  void OnStates(std::int64_t now_us, Session& session, const States& states);
  void OnRest(std::int64_t now_us, Session& session, const Rest& rest);
  void OnExactStates(std::int64_t now_us, const Session& session, const ExactStates& exact);
  void OnRelease(std::int64_t now_us, Session& session, const Release& release);
  void OnImpactReport(const Session& session, const ImpactReport& report);
  void OnProposal(Session& session, const EditOrder& proposal);

  // server.cpp
  /// Acts on who joined, became ready and left.
  void FollowSessions(std::int64_t now_us);
  /// Edits, grants, states and values: all that a peer needs to have our world. One that cannot be
  /// sent all of it is leaving.
  void SendWorld(std::int64_t now_us, Session& session);
  /// Where all bodies are, once more: since it was sent the world, while its clock settled, a
  /// client has heard of none of them.
  void SendBodies(std::int64_t now_us, Session& session);
  /// What rests of the block that a ping looks at: said again where the client has lost it; and
  /// what of its own the server knows of, for its answer.
  void LookAtRest(std::int64_t now_us, Session& session, const Ping& ping, Pong* pong);
  /// What came to rest in the last step, and whether the room is quiet.
  void TellRest(std::int64_t now_us);
  void StartIfReady(std::int64_t now_us);
  void WatchClock(std::int64_t now_us);
  void StepOnce(std::int64_t now_us);
  void ApplyEdits(std::int64_t now_us);
  void AppointEdits(std::int64_t now_us);
  void LetFall(const Edit& applied, bool hung);
  void ApplyQueued(std::int64_t now_us);
  void UpdateAuthority(std::int64_t now_us);
  /// Looks anew at what concerns whom, when that is due or has changed.
  void UpdateInterest(std::int64_t now_us, bool changed);
  void PublishShown(std::int64_t now_us);
  void RunRules(std::int64_t now_us);
  void RunSeats();
  void EndLeases(std::int64_t now_us);
  void LetGo(std::int64_t now_us, int player, std::int16_t buttons);
  void LetSilentGo(std::int64_t now_us);
  void RemoveOutside(std::int64_t now_us);
  void Tell(const std::string& line);
  void NoteCorrected(int body);

  const Scene scene_;
  const ServerConfig config_;
  const Room room_;
  Net& net_;
  ServerStats stats_;
  Replica replica_;
  SessionTable sessions_;
  AuthorityManager authority_;
  EditLog edits_;
  SeatBonds seat_bonds_;
  BoundsWatch bounds_;
  StateFilter filter_;
  Broadcast broadcast_;
  std::unique_ptr<ServerCommands> commands_;
  std::unique_ptr<AuthoritySource> rule_source_;
  std::unique_ptr<Rules> rules_;   // null: the scene has nothing to decide
  std::vector<std::string> news_;  // not taken yet
  RoomClock clock_;
  std::int64_t last_room_us_ = -1000000000;
  bool look_soon_ = false;             // somebody has come: what concerns whom is not known
  std::int64_t drivers_heard_us_ = 0;  // until then no driver has been silent for too long
  std::vector<int> inputs_due_;        // players of whom some have come
  std::int64_t inputs_due_tick_ = -1;  // when they were relayed last
  std::vector<Inputs> newest_inputs_;  // by player, to be relayed; without ticks: not looked up
  // Of what is relayed of inputs to one session at a time.
  InputsPacker inputs_packer_;
  std::vector<Receipt> input_receipts_;
  std::vector<int> input_candidates_;
};

}  // namespace seam
