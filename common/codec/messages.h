#pragma once
/// Every message of the edge (UDP) and of the bus (LCM), as plain structs.
/// The .lcm files in lcmtypes/ have the same fields in the same order and document the bytes;
/// only common/codec/codec*.cpp knows both. Units are last in a name; SI without a suffix.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/load.h"
#include "common/codec/message_limits.h"

namespace seam {

/// Bumped when any message changes: peers of different versions do not talk.
constexpr std::int32_t kProtocolVersion = 12;
/// The oldest whose messages on the bus are those of today: what was recorded since can be read.
constexpr std::int32_t kOldestRecorded = 8;

/// Client -> server, until answered: is there a room, of which protocol? No version may change its
/// fields, so that peers of any two can tell each other theirs.
struct Hello {
  std::int64_t utime = 0;
  std::int32_t protocol = kProtocolVersion;
  std::string name;  ///< player or spectator name, 1..32 characters of [A-Za-z0-9_-]
};

/// Server -> client, the answer to a Hello of an unknown address. The server remembers nothing of
/// it: a peer that repeats the token does receive at this address.
struct Challenge {
  std::int64_t utime = 0;
  std::int64_t token = 0;
};

/// Client -> server, until welcomed: wants to join.
struct Join {
  std::int64_t utime = 0;
  std::int32_t protocol = kProtocolVersion;
  std::int64_t token = 0;  ///< of the Challenge
  std::int64_t key = 0;    ///< of an earlier Welcome, to play the same player again; 0: none
  std::string name;        ///< 1..32 characters of [A-Za-z0-9_-]
  std::string room;        ///< the same, or "": the server's first room
};

/// Server -> client, reliable: admitted. The Room follows in Chunks.
struct Welcome {
  std::int64_t utime = 0;
  std::int32_t peer = 0;        ///< this client's peer number, >= 1
  std::int32_t player = -1;     ///< index of the scene's player it drives, -1 for a spectator
  std::int32_t room_bytes = 0;  ///< size of the encoded Room that follows
  std::int64_t key = 0;         ///< secret of this player; see Join
};

/// Client -> server, reliable: has loaded the room, and its clock has settled.
struct Ready {
  std::int64_t utime = 0;
};

/// A piece of a message too large for a datagram; pieces come reliably and in order.
struct Chunk {
  std::int64_t utime = 0;
  std::int32_t offset_bytes = 0;
  std::vector<std::uint8_t> data;  ///< 1..1000 bytes
};

/// What the room is: enough to simulate it. First message of every recording, repeated each second.
struct Room {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t protocol = kProtocolVersion;
  std::string room;        ///< room name as in the channel
  std::string scene_name;  ///< file name of the scene without folder and ".toml"
  std::string scene_text;  ///< the whole scene file
  std::string mode;        ///< oracle | central | strict | buffer
  std::string reconcile;   ///< snap | interleave | ... ; empty unless mode is buffer
  std::string predict;     ///< own | all; empty unless mode is central
  std::string impair;      ///< name of the network profile
  std::int64_t seed = 0;
  std::int32_t tick_hz = 60;
  std::int32_t send_hz = 30;           ///< rate of States from each peer
  std::int32_t input_delay_ticks = 0;  ///< from reading an input to its tick, everywhere
};

/// Client -> server: asks for the server's time.
struct Ping {
  std::int64_t utime = 0;        ///< client's clock when sent
  std::int32_t revision = -1;    ///< edits applied so far, -1 before there is a world
  std::int64_t composition = 0;  ///< hash of the composition after them
  std::int64_t rest = 0;         ///< hash of the bodies at rest, 0 for none
  std::int16_t rest_blocks = 0;  ///< a block of them (RestBlock); 0: none
  std::int16_t rest_block = 0;
  std::int32_t rest_part = 0;  ///< its hash
  std::int16_t load = -1;      ///< 1/1000 of its time that it needs for its ticks; -1: not known
};

/// Server -> client: the answer.
struct Pong {
  std::int64_t utime = 0;        ///< server's clock when it answers
  std::int64_t client_us = 0;    ///< Ping::utime, returned
  std::int64_t tick0_us = -1;    ///< the room's clock shows utime - tick0_us; -1: waits for players
  std::int64_t rest = 0;         ///< hash of the bodies at rest, 0 for none
  std::int16_t rest_blocks = 0;  ///< Ping::rest_blocks and rest_block, returned; 0: none
  std::int16_t rest_block = 0;
  std::int32_t rest_own = 0;               ///< of the block's bodies that are the client's
  std::int32_t speed_ppm = kFullSpeedPpm;  ///< of the room's clock, per million of real time
};

/// A player's inputs for successive ticks.
struct Inputs {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t player = 0;
  std::int64_t first_tick = 0;        ///< tick that inputs[0] is applied *in* (state after it)
  std::vector<std::int8_t> drive;     ///< -127..127: throttle, backwards to forwards
  std::vector<std::int8_t> lift;      ///< -127..127: second axis
  std::vector<std::int16_t> buttons;  ///< bit field
};

/// States of bodies after `tick`, from the peer that has authority over them. Quantised:
/// position 1/512 m about the origin, angle 2*pi/65536 rad, velocity 1/256 m/s, spin 1/256 rad/s.
struct States {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t peer = 0;  ///< the authority
  std::int64_t tick = 0;
  std::int32_t revision = 0;         ///< edits that the sender had applied
  std::int64_t composition = 0;      ///< hash of the composition after them
  std::int32_t origin_x = 0;         ///< whole metres
  std::int32_t origin_y = 0;         ///< whole metres
  std::vector<std::int32_t> id;      ///< assembly ids, ascending; all vectors of one length
  std::vector<std::int32_t> epoch;   ///< of the body's mechanism
  std::vector<std::int8_t> flags;    ///< kStateAsleep | kStateImpact | kStateFalls
  std::vector<std::int16_t> x, y;    ///< 1/512 m
  std::vector<std::int16_t> angle;   ///< 2*pi/65536 rad, wraps
  std::vector<std::int16_t> vx, vy;  ///< 1/256 m/s
  std::vector<std::int16_t> spin;    ///< 1/256 rad/s
};
constexpr std::int8_t kStateAsleep = 1;
constexpr std::int8_t kStateImpact = 2;  ///< a major impact in the last second, on the authority
constexpr std::int8_t kStateFalls = 4;   ///< touches nothing: gravity alone moves it

/// Reliable: bodies that have come to rest at the peer that has authority over them, as they lie
/// after `tick`, bit for bit. They hold until a newer state of the body.
struct Rest {
  std::int64_t utime = 0;
  std::int32_t peer = 0;    ///< the authority
  std::int64_t number = 0;  ///< counts that peer's messages of this type
  std::int64_t tick = 0;
  std::int32_t revision = 0;        ///< edits that the authority had applied
  std::int64_t composition = 0;     ///< hash of the composition after them
  std::vector<std::int32_t> id;     ///< assembly ids, ascending
  std::vector<std::int32_t> epoch;  ///< changes of authority over the body's mechanism
  std::vector<float> x, y;          ///< m
  std::vector<float> angle;         ///< rad, unwrapped
};

/// Server -> everyone, reliable and ordered: who has authority over a mechanism from `tick` on.
struct Grants {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int64_t tick = 0;
  std::vector<std::int32_t> mechanism;  ///< mechanism ids
  std::vector<std::int16_t> authority;  ///< peer
  std::vector<std::int32_t> epoch;      ///< grows with every change of authority
  std::vector<std::int16_t> followers;  ///< how many of `follower` are this mechanism's
  std::vector<std::int16_t> follower;   ///< peers that are secondary, ascending for each mechanism
};

/// Client -> server, reliable: has let go of these mechanisms, as the grants of these epochs said.
struct Release {
  std::int64_t utime = 0;
  std::int64_t tick = 0;
  std::vector<std::int32_t> mechanism;
  std::vector<std::int32_t> epoch;
};

/// Holder -> server -> who follows, reliable and before the Release: where a mechanism's bodies
/// were, bit for bit, when their holder let go.
struct ExactStates {
  std::int64_t utime = 0;
  std::int64_t tick = 0;            ///< that these are the states after
  std::int32_t revision = 0;        ///< edits that the holder had applied
  std::vector<std::int32_t> id;     ///< assembly ids
  std::vector<std::int32_t> epoch;  ///< of the grant that took the authority away
  std::vector<float> x, y, angle;   ///< m, m, rad (unwrapped)
  std::vector<float> vx, vy, spin;  ///< m/s, m/s, rad/s
};

/// Client -> server, reliable: what struck bodies that the client has authority over, as far as it
/// can hurt them.
struct ImpactReport {
  std::int64_t utime = 0;
  std::int64_t tick = 0;            ///< in which it happened
  std::int32_t revision = 0;        ///< edits that the client had applied
  std::vector<std::int32_t> id;     ///< assembly that was struck, the client's
  std::vector<std::int32_t> epoch;  ///< of the client's authority over it
  std::vector<std::int32_t> by;     ///< assembly that struck it; -1: something anchored
  std::vector<float> x, y;          ///< m, point of contact
  std::vector<float> dv;            ///< m/s, change of velocity of the struck body, >= 0
};

/// A change of who is joined to whom, or of what there is; see common/topology/edit.h for the
/// fields of each kind. From a client: proposed by the authority. From the server: ordered, for
/// everyone.
struct EditOrder {
  std::int64_t utime = 0;
  /// On the bus, counts; of a proposal: how many edits its proposer had applied, so that nobody
  /// takes what it says of a joint for another joint in its place.
  std::int64_t sequence = 0;
  std::int32_t number = -1;  ///< position in the order; -1: a proposal, or (server) begin anew
  std::int64_t tick = 0;     ///< the server's when ordered; a proposer's own
  std::int8_t kind = 0;
  std::int8_t cause = 0;
  std::int32_t a = -1, b = -1;
  std::int32_t joint = -1;
  std::int16_t player = -1;
  std::string text;                         ///< at most kEditTextBytesMax
  std::vector<float> value = {0, 0, 0, 0};  ///< x, y, angle, amount; of a blast also impulse
};
/// The whole must fit kMessageBytesMax.
constexpr std::size_t kEditTextBytesMax = 900;
static_assert(kEditTextBytesMax < kMessageBytesMax);
constexpr std::int8_t kEditKindsMax = 8, kEditKindBlast = 8;

/// Server -> one client, reliable and ordered: what makes of the scene the world as it has become;
/// common/topology/topology_entry.h says what an entry is.
struct Snapshot {
  std::int64_t utime = 0;
  std::int32_t number = 0;  ///< edits that the world has had
  std::int32_t part = 0;    ///< part of parts
  std::int32_t parts = 1;
  std::string text;  ///< of the entries that insert, one after another
  std::vector<std::int8_t> kind;
  std::vector<std::int32_t> joint;
  std::vector<std::int32_t> a, b;
  std::vector<float> value;  ///< of the entries in their order
};
/// Parts of one snapshot, the most: fewer than a Link keeps waiting.
constexpr std::int32_t kSnapshotPartsMax = 3900;
/// The bytes of a Snapshot but for its arrays; of an entry; of a number.
constexpr std::size_t kSnapshotBytes = 37, kSnapshotEntryBytes = 13, kSnapshotValueBytes = 4;

/// Server -> everyone, reliable and ordered: what parts and players have and are worth, changes
/// only. The server alone decides it.
struct Meta {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int64_t tick = 0;
  std::vector<std::int8_t> kind;  ///< kMetaPart | kMetaPlayer
  std::vector<std::int32_t> id;   ///< part id, or the player's index in the scene
  std::vector<std::int8_t> key;   ///< kMetaHealth...
  std::vector<float> value;
};
constexpr std::int8_t kMetaPart = 0, kMetaPlayer = 1;
constexpr std::int8_t kMetaHealth = 0;
constexpr std::int8_t kMetaScore = 1;
constexpr std::int8_t kMetaCheckpoint = 2;  ///< the highest checkpoint reached in this lap
constexpr std::int8_t kMetaLaps = 3;        ///< times that all checkpoints were reached in order
constexpr std::int8_t kMetaTaken = 4;       ///< of a pickup's part: 1 + the player who took it
constexpr std::int8_t kMetaScripts = 16;    ///< 16..25: "value0".."value9", for scripts alone
constexpr std::int8_t kMetaKeyMax = kMetaScripts + 9;

/// Bus only: what a peer shows at a tick. This is what is measured and drawn.
struct View {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::int32_t revision = 0;  ///< edits that the peer had applied
  std::int32_t part = 0;      ///< part of parts: very large views are split
  std::int32_t parts = 1;
  std::vector<std::int32_t> id;         ///< assembly ids, ascending
  std::vector<std::int8_t> role;        ///< kRole...
  std::vector<std::int16_t> authority;  ///< peer that has authority, as this peer knows it
  std::vector<float> x, y, angle;       ///< m, m, rad (unwrapped): as displayed
  std::vector<float> vx, vy, spin;      ///< m/s, m/s, rad/s: of the physics state
};
constexpr std::int8_t kRoleRemote = 0;
constexpr std::int8_t kRoleSecondary = 1;
constexpr std::int8_t kRoleAuthority = 2;

/// Bus only: the strands that a peer shows at a tick. Nothing compares them.
struct Strands {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;             ///< of the view that they belong to
  std::vector<std::int16_t> strand;  ///< index of the [[strand]]; its points in their order
  std::vector<float> x, y;           ///< m
};

/// Bus only: major impacts a peer's world felt in a tick.
struct Impacts {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::vector<std::int32_t> id_a, id_b;  ///< assembly ids; -1 for anchored ground
  std::vector<float> x, y;               ///< m
  std::vector<float> dv;                 ///< m/s, the larger change of velocity of the two
};

/// Once a second, on the bus from every peer: counters since the peer started.
struct Stats {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::int64_t bytes_out = 0, bytes_in = 0;  ///< UDP payload
  std::int64_t datagrams_out = 0, datagrams_in = 0;
  std::int64_t dropped_malformed = 0;    ///< did not decode, or not ours
  std::int64_t dropped_stale = 0;        ///< old epoch or old tick
  std::int64_t dropped_right = 0;        ///< sender had no right to say it
  std::int64_t dropped_implausible = 0;  ///< not finite, too fast, out of the world
  std::int64_t dropped_budget = 0;       ///< datagrams beyond what their sender may send
  std::int64_t cpu_us = 0;               ///< CPU time of the process (0 in virtual time)
  std::int32_t rtt_us = 0;               ///< least round trip of the last window, -1 unknown
  std::int32_t jitter_us = -1;           ///< nine of ten exceeded it by no more, -1 unknown
  std::int32_t loss_ppm = 0;             ///< datagrams lost on the way in, per million
  std::int32_t tick_late_us = 0;         ///< worst lateness of a tick in the last second
  std::int32_t clock_offset_us = 0;      ///< slewed offset still to be corrected
};

/// Bus only: something a person wants to read (joined, left, hand-over, repaired).
struct Event {
  std::int64_t utime = 0;
  std::int64_t sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::string text;
};

/// Either way: the last message of a link, or the refusal of a Hello.
struct Bye {
  std::int64_t utime = 0;
  std::string reason;
};

}  // namespace seam
