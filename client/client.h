#pragma once
/// The peer of a player or spectator: joins a room, follows the server's timeline, simulates its
/// part, and publishes its view. A function of time and the received datagrams.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/client_tap.h"
#include "client/clock_filter.h"
#include "client/join_buffer.h"
#include "client/join_offers.h"
#include "client/load_meter.h"
#include "client/room_timeline.h"
#include "client/scene_cache.h"
#include "common/base/entropy.h"
#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/net/link.h"
#include "common/net/net.h"
#include "common/net/send_credit.h"
#include "common/record/recorder.h"
#include "common/sync/edits/topology_snapshot.h"
#include "common/sync/inputs/input_feed.h"
#include "common/sync/metadata.h"
#include "common/sync/publish.h"
#include "common/sync/publisher.h"
#include "common/sync/replica.h"
#include "common/sync/rest/rest_blocks.h"
#include "common/sync/settings/live_settings.h"

namespace seam {

/// Source of this client's inputs.
enum class Drive { kNone, kScript, kBot, kLive };

struct ClientConfig {
  Address server;
  std::string name = "guest";
  bool numbers_name = false;  ///< takes "guest-2", "guest-3" ... while the name is in use
  std::string room;  ///< a room of the server; "": its first
  Drive drive = Drive::kNone;
  std::string script_of;  ///< kScript: the scene's player with the script to play
  std::int64_t key = 0;   ///< from an earlier Welcome, to get the same place back; 0: none
  /// Shown at the first join; name and room must be its own. Later the key of the place is enough.
  std::optional<ConnectToken> token;
  std::optional<PublicKey> server_key;  ///< the only server to join; unset: whoever answers
  float smooth_rate = kSmoothRate;  ///< SyncConfig::smooth_rate
  std::optional<int> show_age_ticks;  ///< SyncConfig::show_age_ticks; nullopt: the scene's
  Publish publish = Publish::kAll;
  bool shows = false;  ///< replica()'s view is displayed: all of it has to be up to date
  bool watch = false;  ///< join as a spectator; else a name that is not a player's is fatal
  SceneCache* scenes = nullptr;  ///< shared by a thread, outlives the client; nullptr: an own one
  /// Outlives the client, which then shows the room a little late: the states of a tick are there.
  ClientTap* tap = nullptr;
};

class Client {
 public:
  /// Requires that `net`, `recorder` and `entropy` outlive the client.
  Client(const ClientConfig& config, Net& net, Recorder& recorder, Entropy& entropy);

  /// Receives, steps the ticks that are due on the server's timeline, sends.
  void Tick(std::int64_t now_us, std::int64_t cpu_us);
  /// Returns the latest time for the next call of Tick, on the same clock.
  std::int64_t next_tick_us(std::int64_t now_us);
  /// Says where the room is now, as of the fleet's directory: the client goes there when it joins,
  /// or when its server is silent and `epoch` is later than that server's.
  void Suggest(const Address& server, std::int32_t epoch) { suggested_ = {server, epoch}; }
  void PublishUnmoved();  ///< the last view, if it waits
  /// Says which server would go on with the room: the client knocks there while its own is silent.
  void SuggestStandby(const std::optional<Address>& standby) { standby_ = standby; }
  /// Says goodbye; call Tick no more.
  void Shutdown(std::int64_t now_us);

  /// kLive: sets the keyboard's state, held until the next call.
  void SetLiveInput(const Input& input) { live_ = input; }

  /// Returns the reason if the server refused us, or sent something we cannot use; else "". Final.
  const std::string& fatal() const { return fatal_; }
  /// True if the server closed the room (after we had joined). Final as well.
  bool closed() const { return closed_; }
  /// Returns the time spent on joining (again), us; 0 once joined.
  std::int64_t joining_us(std::int64_t now_us) const {
    return (peer_ < 0 || moving_) && number_ != 0 ? now_us - joining_since_us_ : 0;
  }
  /// Returns the share of the room that has come, 0 to 1; 1 once there is a world.
  double room_share() const {
    if (replica_ != nullptr || room_size_ == 0) return replica_ != nullptr ? 1 : 0;
    return static_cast<double>(room_bytes_.size()) / static_cast<double>(room_size_);
  }
  std::size_t room_size() const { return room_size_; }  ///< bytes; 0 until the server says it
  bool running() const { return replica_ != nullptr && started_; }
  /// Returns the time on the room's clock that it shows, us, below 0 before the room starts;
  /// nullopt: not known.
  std::optional<std::int64_t> RoomUs(std::int64_t now_us) {
    if (!clock_.settled() || !timeline_.known()) return std::nullopt;
    return RoomTime(now_us);
  }
  /// True if it has the room, which has not started.
  bool waits_for_start() const {
    return replica_ != nullptr && clock_.settled() && !timeline_.known();
  }
  double lag_us() const { return lag_us_; }  ///< by which one with a tap is late, us; -1: not known
  int peer() const { return peer_; }
  /// Returns the server that it is in, or joins.
  const Address& server() const { return config_.server; }
  bool knocking() const { return knocks_at_.has_value(); }  ///< at the standby
  /// Returns the room's epoch, the highest seen; 0: none yet.
  std::int32_t epoch() const { return epoch_; }
  /// True from a redirect until another server welcomes it: the world goes on as it was.
  bool moving() const { return moving_; }
  /// Returns the name under which it joins or has joined.
  const std::string& name() const { return config_.name; }
  /// Returns the secret key of our place, which gives it back to us in a new session. 0: none yet.
  std::int64_t key() const { return key_; }
  /// Returns our vehicle's part (a character's torso); -1: none, or not known yet.
  PartId vehicle() const;
  const Replica* replica() const { return replica_.get(); }
  /// Returns the newest line of the server for this player, once (about a seat, say); "": none.
  std::string TakeNotice() { return std::exchange(notice_, {}); }
  /// Health, scores, ... as received from the server.
  const MetaTable& metadata() const { return metadata_; }
  const Room& room() const { return room_; }
  const Stats& stats() const { return stats_; }
  /// Speed of the room's clock, per million of real time; below kFullSpeedPpm: overload.
  std::int32_t speed_ppm() const { return timeline_.speed_ppm(); }
  /// Returns why the server's last answer refuses this client; "": it does not.
  const std::string& why_refused() const { return why_refused_; }
  /// Sessions that became ready, as the server counts them; all but the first.
  std::int64_t sessions() const { return sessions_; }
  std::int64_t rejoins() const { return std::max<std::int64_t>(0, sessions_ - 1); }
  /// CPU time of our ticks in thousandths of their duration; -1: not known.
  std::int16_t load_permille() const { return load_.permille(); }
  /// Number of copies moved by received states, by more than the wire's rounding.
  std::int64_t corrections() const { return corrections_; }

  /// If the newest answered ping, or the challenge of a join, is older than this, we join anew.
  static constexpr std::int64_t kLostUs = 5000000;
  /// If a server is silent for so long and another one may have the room, we join that one, us.
  static constexpr std::int64_t kElsewhereUs = 1000000;
  /// If a server is silent for so long, beside a round trip, we knock at its standby, us.
  static constexpr std::int64_t kKnockAfterUs = 500000;
  /// Most redirects between two welcomes after which the client was ready.
  static constexpr int kRedirectsMax = 3;

 private:
  friend struct ClientTestAccess;

  // client_join.cpp
  void Join(std::int64_t now_us);
  /// Forgets the session and its world.
  void Forget(std::int64_t now_us);
  /// Begins a handshake with config_.server; keeps the session and the world.
  void BeginJoin(std::int64_t now_us);
  /// Joins another server that may have the room, if this one is silent.
  void TryElsewhere(std::int64_t now_us);
  /// Knocks at the standby while our server is silent: a handshake beside the session.
  void KnockIfSilent(std::int64_t now_us);
  void StopKnocking();
  void OnRedirect(const Redirect& redirect);
  /// Goes on at another server, and keeps the world until it welcomes us.
  void Move(std::int64_t now_us, const Address& server);
  void Follow(std::int64_t now_us, const Redirect& redirect);
  /// Handles a message of a session that has not welcomed us yet.
  void OnOffered(std::int64_t now_us, ByteView bytes);
  /// Until welcomed: sends a Hello, or a Join once there is a token.
  void SendHelloOrJoin(std::int64_t now_us);
  void SendLoose(const Bytes& message);
  /// Handles a datagram outside of a session; false if it is none of ours.
  bool OnHandshake(std::int64_t now_us, const Bytes& datagram);
  /// Joins anew if the server says, and its silence shows, that it does not have our session.
  void OnUnknownSession(std::int64_t now_us);
  /// Handles a datagram of the session, if it opens. The first one shows which of our joins the
  /// server has granted.
  bool OnSealed(std::int64_t now_us, const Bytes& datagram);
  void BeginOffers();
  void OnChallenge(std::int64_t now_us, const Challenge& challenge);
  void OnRefusal(std::int64_t now_us, const std::string& reason);
  void OnWelcome(std::int64_t now_us, const Welcome& welcome);
  /// Asks the server for the free names, as ours is no player's.
  void AskNames(std::int64_t now_us);
  /// Gives up; `free`: the server's answer, or "".
  void GiveUpName(const std::string& free);

  // client_receive.cpp
  void ReceiveAll(std::int64_t now_us);
  void OnMessage(std::int64_t now_us, ByteView bytes);
  void OnChunk(std::int64_t now_us, const Chunk& chunk);
  void OnEdit(const EditOrder& order);
  void OnGrants(std::int64_t now_us, const Grants& grants);
  /// Sends a Release of all our mechanisms when the lease has ended: the server may still receive
  /// it although nothing arrives here.
  void SendReleaseOfAll(std::int64_t now_us);
  void OnSnapshot(const Snapshot& part);
  /// Makes the replica from the scene, or from the edited one. It continues the state of an
  /// existing replica.
  void MakeReplica(const Topology* become = nullptr);
  void Build(std::int64_t now_us);

  // client.cpp
  void SendReadyAndPing(std::int64_t now_us);
  /// True if the answer to a ping is late by more than is usual.
  bool PongOverdue(std::int64_t now_us) const;
  void StartIfDue(std::int64_t now_us);
  void CatchUp(std::int64_t tick);
  void StepDue(std::int64_t now_us);
  void StepOnce(std::int64_t now_us);
  /// Returns the amount to publish in a room of so many bodies; kNone if nobody listens.
  Publish Published(int bodies) const;
  void PublishShown(std::int64_t now_us);
  void TellRest(std::int64_t now_us);
  void OnStates(const States& states);
  void OnPacked(const PackedStates& packed);
  void OnInputs(const PackedInputs& packed);
  void OnPong(std::int64_t now_us, const Pong& pong);
  /// True if everything rests, here and at the server, and the player does nothing: then a ping a
  /// second is enough.
  bool Quiet() const;

  // client_inputs.cpp
  /// Lets the settings of the next tick act.
  void FollowSettings();
  void RecordOwnInput();
  Input ReadInput(std::int64_t tick) const;
  /// Records the inputs that every peer knows of the next tick without being told.
  void RecordKnownInputs();
  /// True if the mode lets us do the next tick. Until then the own input is read at its time.
  bool MayStep();
  /// Takes a piece of the server's world: to begin with where peers send inputs alone; elsewhere as
  /// it was a moment ago, to be the same.
  void OnWorldPiece(const Chunk& chunk);
  void BeginWith(ByteView world);
  void EndUnlessGood(const Status& world);
  /// Where peers send inputs alone: adds the hash of a past tick, so that the server finds a world
  /// that has parted.
  void AddWorldHash(Ping* ping) const;

  // client_send.cpp
  /// True if the path to the server carries a datagram now.
  bool LineReady(std::int64_t now_us);
  /// Sends the states of the last step.
  void SendStates(std::int64_t now_us);
  /// Returns the states that are due to the server, in thousandths of its full path's rate;
  /// -1: it is not full.
  std::int16_t LineLoad(std::int64_t now_us);
  void SendInputs(std::int64_t now_us);
  /// True if edits wait for all players' inputs of the tick in which physics found them. Scans
  /// every part of the scene, once a revision.
  bool EditsWait();
  void PublishStats(std::int64_t now_us, std::int64_t cpu_us);
  void Flush(std::int64_t now_us);
  std::int64_t RoomTime(std::int64_t now_us);
  std::int64_t LeadTarget() const;
  double LagTarget() const;

  ClientConfig config_;
  int name_number_ = 1;  // of config_.name, if the client numbers it
  Net& net_;
  Recorder& recorder_;
  Entropy& entropy_;
  std::uint64_t number_ = 0;  // of our handshake
  JoinOffers offers_;
  bool offer_fresh_ = false;  // the newest was not sent in a Join yet
  std::int64_t key_ = 0;
  std::optional<PublicKey> key_of_;  // the server that gave us the key, if it did in our life
  std::unique_ptr<Link> link_;       // nullptr until welcomed
  Address at_;                       // the server of link_
  std::unique_ptr<Link> next_;       // of a session that has not welcomed us yet
  PublicKey next_of_{};              // its server
  bool moving_ = false;              // joins another server; the world is that of the last one
  std::optional<Redirect> redirect_;  // received in this call
  std::string refusal_;               // likewise; "": none
  int redirects_ = 0;                 // in a row
  Address home_;                      // the configured server
  Address away_;                      // the last one to which we were redirected; port 0: none
  struct Suggestion {
    Address server;
    std::int32_t epoch = 0;
  };
  std::optional<Suggestion> suggested_;
  std::optional<Address> standby_;       // of the room, by the fleet's directory
  std::optional<Address> told_standby_;  // the same, by our server
  std::optional<Address> knocks_at_;  // with the present handshake; nullopt: it is with our server
  std::int32_t epoch_ = 0;         // of the room: no lower one is joined
  std::int32_t proved_epoch_ = 0;  // of the newest Welcome, with its proof
  std::int64_t proof_ = 0;
  std::int64_t begun_us_ = 0;  // begin of this handshake
  std::unique_ptr<Publisher> publisher_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Replica> replica_;
  ClockFilter clock_;
  MetaTable metadata_;
  PlayerSettings settings_;  // of our player
  std::string notice_;
  Room room_;
  const Policy* policy_ = &UnknownPolicy();   // of room_.mode, once its scene is loaded
  std::unique_ptr<SnapshotReader> snapshot_;  // a snapshot that arrives in parts
  JoinBuffer held_;                           // received states until the start
  Bytes room_bytes_;
  std::size_t room_size_ = 0;
  std::int64_t received_us_ = 0;  // time of the room's last bytes
  bool loaded_now_ = false;       // loaded the room in this call, which may have taken seconds
  int peer_ = -1, player_ = -1;
  Bytes world_bytes_;         // of the server's world
  bool world_given_ = false;  // where peers send inputs alone: the replica continues it
  std::int64_t world_tick_ = 0;
  bool said_ready_ = false, started_ = false, released_ = false, closed_ = false;
  std::string fatal_;
  RoomTimeline timeline_;
  RestBlocks rest_;               // compares our bodies at rest with the server's
  std::int64_t rest_turn_ = 0;    // selects the block that the next ping compares
  bool rest_agrees_ = false;      // at the last answered ping, everything at rest agreed
  std::int64_t idle_since_ = 0;   // tick from which on our input has been neutral
  double lead_us_ = -1;           // mode central: our lead over the server
  double lag_us_ = -1;            // with a tap
  std::int64_t answered_us_ = 0;  // send time of the newest answered ping
  std::int64_t joining_since_us_ = 0;
  std::int64_t asked_names_us_ = -1;  // -1: did not ask
  std::int64_t refused_us_ = -1;      // time of the first refusal since we began to join
  std::string why_refused_;           // the reason of the last of them
  std::int64_t last_ping_us_ = -1000000000;
  std::int64_t last_hello_us_ = -1000000000;
  std::int64_t last_stats_us_ = -1000000000;
  std::int64_t worst_late_us_ = 0, late_us_ = 0;  // worst of all ticks, and of this call's
  LoadMeter load_;
  std::int64_t sessions_ = 0;  // that became ready
  std::int64_t corrections_ = 0;
  bool edits_wait_ = false;
  int edits_wait_revision_ = -1;  // the revision of edits_wait_; -1: not looked up
  Input live_;
  InputFeed feed_;
  SendCredit credit_;        // for the path to the server
  bool line_ready_ = false;  // in this call of Tick
  std::vector<std::pair<std::int64_t, Bytes>> unsent_;  // states that the path did not carry yet
  double offered_bytes_ = 0;
  std::int64_t offered_us_ = -1;
  std::int16_t line_permille_ = -1;
  std::int64_t discarded_ = 0;  // datagrams discarded by the net, as counted in stats_
  Stats stats_;
  // For this link's packed states, once its scene is known.
  std::optional<StatesUnpacker> unpacker_;
  std::optional<StatesPacker> packer_;
};

}  // namespace seam
