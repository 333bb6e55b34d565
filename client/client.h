#pragma once
/// A player's (or spectator's) peer: joins a room, follows the server's timeline, simulates its
/// part, and publishes what it shows. A function of the time and the datagrams it is given.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/clock_filter.h"
#include "client/held_world.h"
#include "client/load_meter.h"
#include "client/room_timeline.h"
#include "client/scene_shelf.h"
#include "common/base/entropy.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/net/link.h"
#include "common/net/net.h"
#include "common/record/recorder.h"
#include "common/sync/edits/topology_snapshot.h"
#include "common/sync/input_feed.h"
#include "common/sync/metadata.h"
#include "common/sync/publish.h"
#include "common/sync/publisher.h"
#include "common/sync/replica.h"
#include "common/sync/rest/rest_blocks.h"

namespace seam {

/// Where this client's inputs come from.
enum class Drive { kNone, kScript, kBot, kLive };

struct ClientConfig {
  Address server;
  std::string name = "guest";
  std::string room;  ///< of the server; "": its first
  Drive drive = Drive::kNone;
  std::string script_of;            ///< kScript: the scene's player whose script it plays
  std::int64_t key = 0;             ///< of an earlier Welcome, to have its place back; 0: none
  float smooth_rate = kSmoothRate;  ///< SyncConfig::smooth_rate
  Publish publish = Publish::kAll;
  bool shows = false;  ///< somebody looks at replica()'s view: all of it has to be true
  bool watch = false;  ///< to look on is what is wanted; else a name without a place is fatal
  SceneShelf* scenes = nullptr;  ///< of its thread, outlives the client; nullptr: it reads its own
};

class Client {
 public:
  /// `net`, `recorder` and `entropy` must outlive the client.
  Client(const ClientConfig& config, Net& net, Recorder& recorder, Entropy& entropy);

  /// Receives, steps the ticks that are due on the server's timeline, sends.
  void Tick(std::int64_t now_us, std::int64_t cpu_us);
  /// When to call Tick next at the latest, on the same clock.
  std::int64_t next_tick_us(std::int64_t now_us);
  /// Says goodbye; call Tick no more.
  void Shutdown(std::int64_t now_us);

  /// kLive: the keyboard's state, held until the next call.
  void SetLiveInput(const Input& input) { live_ = input; }

  /// Not empty: the server refused us, or sent something we cannot use. Final.
  const std::string& fatal() const { return fatal_; }
  /// The server closed the room (after we had been in). Final as well.
  bool closed() const { return closed_; }
  /// How long it has been trying to join (again), us; 0 while it is in.
  std::int64_t joining_us(std::int64_t now_us) const {
    return peer_ < 0 && link_ != nullptr ? now_us - joining_since_us_ : 0;
  }
  bool running() const { return replica_ != nullptr && started_; }
  int peer() const { return peer_; }
  /// Secret of our place in the room: with it, it is ours again in a new session. 0: none yet.
  std::int64_t key() const { return key_; }
  /// The part that is ours to drive (of a character: its torso); -1: none, or not known yet.
  PartId vehicle() const;
  const Replica* replica() const { return replica_.get(); }
  /// Health, scores, ... as the server has told them.
  const MetaTable& metadata() const { return metadata_; }
  const Room& room() const { return room_; }
  const Stats& stats() const { return stats_; }
  /// Of the room's clock, per million of real time: below kFullSpeedPpm the server is overloaded.
  std::int32_t speed_ppm() const { return timeline_.speed_ppm(); }
  std::int64_t rejoins() const { return rejoins_; }
  /// Thousandths of its time that it needs for its ticks; -1: not known.
  std::int16_t load_permille() const { return load_.permille(); }
  /// Bodies whose copy here was put elsewhere by what was heard, by more than the wire's rounding.
  std::int64_t corrections() const { return corrections_; }

  /// Age of the newest answered ping, or of a join that was challenged, after which we try to join
  /// anew.
  static constexpr std::int64_t kLostUs = 5000000;

 private:
  friend struct ClientTestAccess;

  // client_join.cpp
  void Join(std::int64_t now_us);
  /// Until welcomed: a Hello, or a Join once there is a token.
  void Knock(std::int64_t now_us);
  void SendLoose(const Bytes& message);
  /// Takes a datagram of the handshake; false when it is none.
  bool OnHandshake(std::int64_t now_us, const Bytes& datagram);
  void OnRefusal(std::int64_t now_us, const std::string& reason);
  void OnWelcome(std::int64_t now_us, const Welcome& welcome);
  /// Ours is no player's name: asks the server which are free.
  void AskNames(std::int64_t now_us);
  /// Gives up; `free`: the server's answer, "" without one.
  void GiveUpName(const std::string& free);

  // client_receive.cpp
  void ReceiveAll(std::int64_t now_us);
  void OnMessage(std::int64_t now_us, ByteView bytes);
  void OnChunk(std::int64_t now_us, const Chunk& chunk);
  void OnEdit(const EditOrder& order);
  void OnGrants(std::int64_t now_us, const Grants& grants);
  /// The lease has ended. The server may hear of it although nothing is heard of it.
  void TellReleaseOfAll(std::int64_t now_us);
  void OnSnapshot(const Snapshot& part);
  /// Of the scene as it is, or as it has become. Instead of one that runs, it goes on from there.
  void MakeReplica(const Topology* become = nullptr);
  void Build(std::int64_t now_us);

  // client.cpp
  void SendReadyAndPing(std::int64_t now_us);
  void StartIfDue(std::int64_t now_us);
  void CatchUp(std::int64_t tick);
  void StepDue(std::int64_t now_us);
  void StepOnce(std::int64_t now_us);
  /// In a room of so many bodies; kNone where nobody listens.
  Publish Published(int bodies) const;
  void PublishShown(std::int64_t now_us);
  void NoteOwnInput();
  void TellRest(std::int64_t now_us);
  void OnStates(const States& states);
  void OnPacked(const PackedStates& packed);
  void OnInputs(const PackedInputs& packed);
  void OnPong(std::int64_t now_us, const Pong& pong);
  /// Whether all lies still, here and at the server, and nobody here does anything: until it does,
  /// a ping a second is enough.
  bool Quiet() const;
  void SendInputs(std::int64_t now_us);
  /// Whether edits wait for everybody's inputs of the tick at which physics found them. It looks at
  /// every part of the scene: once a revision.
  bool EditsWait();
  void PublishStats(std::int64_t now_us, std::int64_t cpu_us);
  void Flush(std::int64_t now_us);
  std::int64_t RoomTime(std::int64_t now_us);
  std::int64_t LeadTarget() const;

  ClientConfig config_;
  Net& net_;
  Recorder& recorder_;
  Entropy& entropy_;
  std::uint64_t session_ = 0;
  std::optional<std::int64_t> token_;  // the server's newest, for this session
  bool token_fresh_ = false;           // not in a Join yet
  std::int64_t key_ = 0;
  std::unique_ptr<Link> link_;
  std::unique_ptr<Publisher> publisher_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Replica> replica_;
  ClockFilter clock_;
  MetaTable metadata_;
  Room room_;
  Mode mode_ = Mode::kBuffer;                 // room_.mode, once its scene is loaded
  std::unique_ptr<SnapshotReader> snapshot_;  // one that comes in its parts
  HeldWorld held_;                            // what was told of bodies before it starts
  Bytes room_bytes_;
  std::size_t room_size_ = 0;
  int peer_ = -1;
  int player_ = -1;
  bool said_ready_ = false;
  bool started_ = false;
  bool released_ = false;
  bool closed_ = false;
  std::string fatal_;
  RoomTimeline timeline_;
  RestBlocks rest_;               // with what the server knows of what of mine rests
  std::int64_t rest_turn_ = 0;    // of the block that the next ping looks at
  bool rest_agrees_ = false;      // all that rests, when a ping was answered last
  std::int64_t idle_since_ = 0;   // tick from which on our input has been neutral
  double lead_us_ = -1;           // mode central: how far ahead of the server we simulate
  std::int64_t answered_us_ = 0;  // when we sent the newest ping that was answered
  std::int64_t joining_since_us_ = 0;
  std::int64_t asked_names_us_ = -1;  // -1: did not ask
  std::int64_t refused_us_ = -1;      // of the first refusal since we began to join
  std::int64_t last_ping_us_ = -1000000000;
  std::int64_t last_hello_us_ = -1000000000;
  std::int64_t last_stats_us_ = -1000000000;
  std::int64_t worst_late_us_ = 0;
  std::int64_t late_us_ = 0;  // of this call's ticks, at worst
  LoadMeter load_;
  std::int64_t rejoins_ = 0;
  std::int64_t corrections_ = 0;
  bool edits_wait_ = false;
  int edits_wait_revision_ = -1;  // of which that is; -1: not looked up
  Input live_;
  InputFeed feed_;
  std::int64_t discarded_ = 0;  // by the net, as far as counted in stats_
  Stats stats_;
  std::optional<StatesUnpacker> unpacker_;  // of this link's packed states
};

}  // namespace seam
