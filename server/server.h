#pragma once
/// The room's loop: receives, steps the ticks that are due, sends. Each member decides one question
/// about the effects of a tick, a message or a join. A function of the time and the datagrams that
/// it is given: the same Server runs over UDP and in virtual time.

#include <cstdint>
#include <map>
#include <memory>
#include <set>
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
#include "server/edits/oracle_edit_log.h"
#include "server/room_clock.h"
#include "server/room_feed.h"
#include "server/room_settings.h"
#include "server/rules/bounds_watch.h"
#include "server/rules/seats.h"
#include "server/server_stats.h"
#include "server/sessions/session_table.h"
#include "server/state_filter.h"
#include "server/trust/trust_ladder.h"
#include "server/trust/waiting.h"

namespace seam {

class Auditor;
class AuthoritySource;
class Chronicle;
class InputRoom;
class RoomState;
class Rules;
class SavedRoom;
class StateDraft;
class ServerCommands;
struct LogTail;
struct TickMessages;

/// Most datagrams taken in one call: a flood must not keep rooms from stepping.
constexpr int kDatagramsMax = 4096;

struct ServerConfig {
  SyncConfig sync;
  std::string room = "main";
  std::int32_t epoch = 1;          ///< of the room; a resumed one has at least its saved one
  std::string impair = "perfect";  ///< for the record only
  std::int64_t seed = 1;
  int wait_players = 0;  ///< tick 0 comes when this many players are ready
  /// Limit for UDP payload to each client; 0: none.
  double client_bytes_per_s = kClientBytesPerS;
  Publish publish = Publish::kAll;
  TrustMode trust = TrustMode::kAct;  ///< doubts about clients (docs/trust.md)
  /// The server's lasting keys, the same in all its rooms; nullptr: drawn from its entropy.
  std::shared_ptr<const KeyPair> identity;
  /// Key of the operator whose connect tokens are demanded; nullptr: anybody may join. With it the
  /// clock of Tick has to be the time since 1970.
  std::shared_ptr<const Secret> token_key;
};

class Server {
 public:
  /// `net`, `recorder` and `entropy` must outlive the server. `entropy` must not be predictable:
  /// otherwise an attacker can take any player's place.
  Server(const Scene& scene, const ServerConfig& config, Net& net, Recorder& recorder,
         Entropy& entropy);
  /// Makes a server for a saved room: Resume must follow. `config` must name the settings of
  /// saved.room().
  Server(const SavedRoom& saved, const ServerConfig& config, Net& net, Recorder& recorder,
         Entropy& entropy);
  ~Server();

  /// Continues the saved room at `now_us`, after the ticks of the log's `tail` if there is one, as
  /// if all its clients had left then. Players' places are reserved as before. Returns one line if
  /// the bytes are damaged; the server must then not be used any more.
  Status Resume(const SavedRoom& saved, std::int64_t now_us, const LogTail* tail = nullptr);
  /// Loads the saved room, to Replay its log's ticks while another server still writes them.
  Status Follow(const SavedRoom& saved, std::int64_t now_us);
  const std::vector<int>& replayed_present() const { return replayed_present_; }  ///< players
  PlaceTable& places() { return sessions_.places(); }
  /// Does the next tick of the room's log again, as it was. Requires the ticks in their order, from
  /// the first one or the saved one on, and no clients. Returns false if the rules come to other
  /// values than the log's, which then count.
  bool Replay(std::int64_t now_us, const TickMessages& log);
  /// Returns the first tick of Resume's `tail` after which the world had another hash than in the
  /// log; -1: none.
  std::int64_t unlike_log() const { return unlike_log_; }
  /// Publishes a tick of the log with the bytes of its own session, as it was; to be called after
  /// its Replay.
  void Republish(const TickMessages& log);
  /// Goes on by itself after Replay, at `now_us`: has everything, and clients may join.
  void GoOn(std::int64_t now_us);
  void TakeInputs(std::int64_t now_us, const Inputs& inputs);  ///< as if from the player's client
  /// Returns the room's state as bytes; see RoomState::Save. Not in mode oracle, where no peer can
  /// join a room that runs.
  Bytes Save(std::int64_t now_us);
  /// Returns a copy that RoomState::Finish finishes; see RoomState::Copy.
  StateDraft CopyState(std::int64_t now_us, std::size_t expected_bytes);

  /// Receives, steps the ticks that are due, sends. `now_us`: any clock that never runs backwards;
  /// `cpu_us`: CPU time used so far, for the record (0: unknown); used only if stats_due.
  void Tick(std::int64_t now_us, std::int64_t cpu_us);
  bool stats_due(std::int64_t now_us) const { return stats_.Due(now_us); }
  /// Time at which the next tick is due, on the clock of Tick; INT64_MAX before the room starts.
  std::int64_t next_tick_us() const;
  std::int64_t wake_us() const;  ///< the same; INT64_MAX also while it waits for inputs
  void PublishLoad(const Load& load) { broadcast_.Publish(load); }  ///< of the room
  void PublishUnmoved() { broadcast_.PublishUnmoved(); }  ///< the last view, if it waits
  void Shutdown(std::int64_t now_us, const std::string& reason);  ///< says goodbye; Tick no more
  /// Gives the room away: what is saved from now on is of this epoch. Redirect or Forsake follows.
  void GiveAway(std::int32_t epoch) { epoch_ = epoch; }
  /// Ends the room here; its clients, and those that join, are told to go on at another server.
  /// Tick then only tells them so.
  void RedirectAll(std::int64_t now_us, const Redirect& redirect);
  /// Ends the room here without a word to its clients: it goes on elsewhere, who knows where.
  void Forsake(std::int64_t now_us);
  /// Tells the clients, and those that come, which server would go on with the room.
  void NameStandby(std::int64_t now_us, const std::string& address);
  /// True after RedirectAll, once every client has acknowledged it or is silent.
  bool all_redirected() const { return over_ && sessions_.AllTold(); }
  std::int32_t epoch() const { return epoch_; }  ///< of the room
  /// A higher epoch of the room that a client has proved: another server has it, and this one must
  /// stop. 0: none.
  std::int32_t shown_epoch() const { return sessions_.shown_epoch(); }

  /// Returns the room's description, with the number of this session.
  const Room& room() const { return room_; }
  bool started() const { return clock_.started(); }
  std::int64_t tick() const { return replica_.tick(); }
  int client_count() const { return sessions_.count(); }
  int player_count() const { return sessions_.player_count(); }  ///< with a ready client
  const Stats& stats() const { return stats_.counters; }
  /// Round trips, losses, corrections and repairs, since the start.
  const Connections& connections() const { return stats_.connections; }
  /// Parts that were removed because they had left the scene's bounds, since the start.
  std::int64_t left_bounds() const { return bounds_.left(); }
  std::int64_t decoded() const { return stats_.decoded; }  ///< messages, since the start
  /// Hand-overs at which the server's copy was visibly off, since the start.
  std::int64_t jumps() const { return stats_.jumps; }
  /// Speed of the room's clock, ppm of real time: below kFullSpeedPpm the server is overloaded.
  std::int32_t speed_ppm() const { return clock_.speed_ppm(); }
  const Replica& replica() const { return replica_; }
  RoomSettings& settings() { return settings_; }
  const InputRoom* input_room() const { return input_room_.get(); }  ///< nullptr: it sends states
  /// Adds an edit from outside; see EditLog::Add.
  bool Order(const Edit& edit) { return edits_->Add(edit); }
  /// Returns the operator's warnings since the last call, such as a stopped script. One line each.
  std::vector<std::string> TakeWarnings();
  bool script_stopped() const;  ///< a script of the room was
  /// Returns lines for people about clients that came and went, since the last call; the first 256.
  std::vector<std::string> TakeReports() { return std::exchange(news_, {}); }
  /// Names of the scene's players without a ready client.
  std::vector<std::string> missing() const;
  const Scene& scene() const { return scene_; }
  /// Statistics of each client's sessions so far.
  std::vector<ClientAccount> accounts() const { return sessions_.accounts().List(); }
  /// All bytes of clients and strangers, by kind.
  const TrafficCount& traffic() const { return sessions_.traffic(); }
  const PublicKey& identity() const { return sessions_.identity(); }  ///< lasting public key
  /// The server's lasting keys, for another server that is to be this one.
  std::shared_ptr<const KeyPair> keys() const { return sessions_.keys(); }
  /// The room's rules (health, scores, scripts); nullptr if the scene has none.
  Rules* rules() const { return rules_.get(); }
  const TrustLadder& ladder() const { return ladder_; }       ///< trust in each player's client
  const Chronicle& chronicle() const { return *chronicle_; }  ///< events, and the session's sum
  Chronicle& chronicle() { return *chronicle_; }
  /// Sums up the session so far.
  Summary Sum(std::int64_t now_us, Ended ended = Ended::kNot) const;

  /// Time from the last player's readiness to tick 0, us: the start has to reach everyone in it.
  static constexpr std::int64_t kLeadInUs = 1000000;
  /// Shortest time between two repairs of a peer with another composition, us.
  static constexpr std::int64_t kRepairAgainUs = 3000000;

 private:
  friend struct ServerTestAccess;

  Server(const Scene& scene, const Topology& topology, const ServerConfig& config, Net& net,
         Recorder& recorder, Entropy& entropy);
  // server_state.cpp
  RoomState State();
  /// Takes everything back that clients had, or were to get.
  void TakeAllBack(std::int64_t now_us);

  // server_replay.cpp
  /// Does the ticks of the log again, and takes what it has of the next. `present`: the players in
  /// the room before, then after them.
  void ReplayTail(std::int64_t now_us, const LogTail& tail, std::vector<int>* present);
  /// Takes a message of the log that precedes or follows the step of its tick.
  void TakeLogged(std::int64_t now_us, const AnyMessage& message);
  void TakeLogged(std::int64_t now_us, const Accepted& accepted);
  bool RunRulesAgain(const std::vector<Meta>& values);

  // server_receive.cpp, server_inputs.cpp
  void ReceiveAll(std::int64_t now_us);
  /// Calls OnMessage; adds the messages that it drops to the session's account.
  void Deliver(std::int64_t now_us, Session& session, ByteView bytes);
  void OnMessage(std::int64_t now_us, Session& session, ByteView bytes);
  /// Sends the free names to a client; a client asks for them when its name is no player's.
  void OnHello(std::int64_t now_us, Session& session);
  void OnPing(std::int64_t now_us, Session& session, const Ping& ping);
  void OnPacked(std::int64_t now_us, Session& session, const PackedInputs& packed);
  void OnInputs(std::int64_t now_us, Session& session, const Inputs& inputs);
  void RelayInputs(std::int64_t now_us);
  void RelayInputs(std::int64_t now_us, const std::vector<int>& players, Session& session);
  void FindRelevantPlayers();
  void RunInputRoom(std::int64_t now_us);
  void FindParted(std::int64_t now_us, Session& session, const Ping& ping);
  Inputs TakeFresh(std::int64_t now_us, const Inputs& inputs);
  void OnRelease(std::int64_t now_us, Session& session, const Release& release);
  template <class Report>
  void OnReport(std::int64_t now_us, const Session& session, const Report& report);
  void OnProposal(Session& session, const EditOrder& proposal);

  // server_states.cpp
  void OnDiffering(const Session& session, const Differing& differing);
  /// A peer's copies (0: the server's) are not what was told: sends all states and settled worlds.
  void TellDiffering(int peer, const std::vector<int>& mechanisms);
  void OnPacked(std::int64_t now_us, Session& session, const PackedStates& packed);
  void OnStates(std::int64_t now_us, Session& session, const States& states);
  void TakeStates(std::int64_t now_us, Session& session, const States& states);
  void OnRest(std::int64_t now_us, Session& session, const Rest& rest);
  void OnExactStates(std::int64_t now_us, Session& session, const ExactStates& exact);
  // server_trust.cpp
  /// Takes the states that waited for the server's copies of their tick.
  void TakeWaitingStates(std::int64_t now_us);
  /// True if the joint of a proposed break bore a load that breaks it, or stands no longer.
  bool BoreLoad(const EditOrder& proposal);
  /// Takes the proposals of breaks of which the server has felt the load; drops those that it has
  /// not felt in time.
  void TakeWaitingBreaks(std::int64_t now_us);
  /// True if the player's vehicle is on probation.
  bool Doubted(int player) const;
  /// True if a proposal is a break of loaded glue in a room of which the server steps all.
  bool NeedsLoad(const EditOrder& proposal) const;
  void Propose(Session& session, const EditOrder& proposal);
  /// Adds the new doubts to the client's score, and publishes the gravest.
  void FollowDoubts(std::int64_t now_us, const Session& session);
  std::unique_ptr<Auditor> MakeAuditor() const;
  /// Audits for a moment, after all of a tick is sent, unless the next one is due.
  void RunAudit(std::int64_t now_us);
  bool Excused(std::int64_t now_us, int player, DoubtKind kind);
  void NoteDoubt(std::int64_t now_us, int peer, int player, const Doubt& doubt);
  /// Says the ladder's new steps; a client that has fallen off has to leave.
  void FollowLadder(std::int64_t now_us);
  /// True if the player's client may have authority.
  bool MayHold(int player) const;
  /// True if only the inputs of the session's client count.
  bool InputsOnly(const Session& session) const;

  // server_events.cpp
  /// Puts the end of the session into the record.
  void End(std::int64_t now_us, const std::string& reason);
  /// Tick of a room that is over.
  void AnswerOnly(std::int64_t now_us);
  // server.cpp
  /// Puts places that were taken or given up into the log. Returns false if there are none.
  bool NotePlaces(std::int64_t now_us);
  /// Acts on the events of sessions: joined, ready, left.
  void FollowSessions(std::int64_t now_us);
  /// Sends edits, grants, states and values: all that a peer needs to rebuild the server's world. A
  /// peer that cannot be sent all of it has to leave.
  void SendWorld(std::int64_t now_us, Session& session);
  /// Sends all bodies' states once more: the client was sent none since SendWorld, while its clock
  /// settled.
  void SendBodies(std::int64_t now_us, Session& session);
  /// Compares the block of resting bodies in a ping. Sends it again if the client has lost it; puts
  /// into `pong` the server's hash of the client's own bodies in the block.
  void LookAtRest(std::int64_t now_us, Session& session, const Ping& ping, Pong* pong);
  /// Sends the bodies that came to rest in the last step; tells the links if the room is quiet.
  void TellRest(std::int64_t now_us);
  void StartIfReady(std::int64_t now_us);
  /// Tells those who are ready for whom the room waits.
  void TellWaiting(std::int64_t now_us, int needed);
  void WatchClock(std::int64_t now_us);
  void StepOnce(std::int64_t now_us);
  void ApplyEdits(std::int64_t now_us);
  std::int64_t InputsKnownUntil() const;
  void LetFall(const Edit& applied, bool hung);
  void ApplyQueued(std::int64_t now_us);
  void UpdateAuthority(std::int64_t now_us);
  void NoteAuthority(std::int64_t now_us);
  /// Recomputes relevance when that is due; `changed`: authority has changed.
  void UpdateInterest(std::int64_t now_us, bool changed);
  void PublishShown(std::int64_t now_us);
  void RunRules(std::int64_t now_us);
  // server_seats.cpp
  void RunSeats(std::int64_t now_us);
  void RefuseSeat(std::int64_t now_us, int player, int pressed, const std::set<int>& taken);
  void FreeSeats(std::int64_t now_us);
  void EndLeases(std::int64_t now_us);
  void LetGo(std::int64_t now_us, int player, std::int16_t buttons);
  void ReleaseSilentDrivers(std::int64_t now_us);
  void RemoveOutside(std::int64_t now_us);
  void Tell(const std::string& line);
  void NoteCorrected(int body, const BodyState& by);

  const Scene scene_;
  const ServerConfig config_;
  const Room room_;
  std::int32_t epoch_;  // of what is saved
  bool over_ = false;   // the room goes on elsewhere: Tick only answers
  Redirect standby_;    // names the server that would go on; no address: none is known
  Net& net_;
  ServerStats stats_;
  Replica replica_;
  SessionTable sessions_;
  AuthorityManager authority_;
  std::unique_ptr<EditLog> edits_;
  SeatBonds seat_bonds_;
  std::set<int> seats_freed_;                 // edits that free them are on their way
  std::int64_t waiting_told_us_ = -1;         // or when the first was ready; -1: nobody is
  std::map<int, std::int64_t> seat_told_us_;  // by player: the last refusal that it was told
  RoomSettings settings_;
  BoundsWatch bounds_;
  StateFilter filter_;
  TrustLadder ladder_;
  std::unique_ptr<Auditor> auditor_;           // null: no client simulates, or none is doubted
  std::vector<WaitingStates> waiting_states_;  // in the order of their arrival
  std::vector<WaitingBreak> waiting_breaks_;
  Broadcast broadcast_;
  std::unique_ptr<Chronicle> chronicle_;
  std::unique_ptr<InputRoom> input_room_;
  RoomFeed room_feed_;
  std::unique_ptr<ServerCommands> commands_;
  std::unique_ptr<AuthoritySource> rule_source_;
  std::unique_ptr<Rules> rules_;   // null: the scene has none
  std::vector<std::string> news_;  // not taken yet
  RoomClock clock_;
  bool look_soon_ = false;             // a client became ready: its relevances are not known
  std::int64_t drivers_heard_us_ = 0;  // time of the next check for silent drivers
  std::vector<int> inputs_due_;        // players with new inputs
  std::int64_t inputs_due_tick_ = -1;  // tick of the last RelayInputs
  std::vector<int> replayed_present_;  // players in the room, in a replay
  std::int64_t unlike_log_ = -1;
  std::vector<Inputs> newest_inputs_;  // by player, to be relayed; without ticks: not looked up
  // Used while inputs are relayed to one session.
  InputsPacker inputs_packer_;
  std::vector<Receipt> input_receipts_;
  std::vector<std::vector<int>> hearers_;  // by player: peers to which it is relevant
};

}  // namespace seam
