#pragma once
/// Every message of the edge (UDP) and of the bus (LCM), as plain structs with the fields of
/// lcmtypes/*.lcm, which document the bytes. `session`: drawn by the room's server at its start; 0
/// on the edge but in Room. Units are last in a name; SI without a suffix.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/audit.h"
#include "common/codec/divergence.h"
#include "common/codec/event.h"
#include "common/codec/load.h"
#include "common/codec/message_limits.h"
#include "common/codec/redirect.h"
#include "common/codec/summary.h"

namespace seam {

/// Raised when any message changes: peers of different versions do not talk.
constexpr std::int32_t kProtocolVersion = 19;
/// Oldest version with today's messages on the bus: recordings since that version can be read.
constexpr std::int32_t kOldestReadableProtocol = 8;

/// Client -> server, repeated until answered: asks for a room. No version may change these fields.
struct Hello {
  std::int64_t utime = 0;
  std::int32_t protocol = kProtocolVersion;
  std::string name;  ///< player or spectator name, 1..32 characters of [A-Za-z0-9_-]
};

/// Server -> client: answers a Hello. A client that returns the token proves its address.
struct Challenge {
  std::int64_t utime = 0;
  std::int64_t token = 0;
  std::vector<std::uint8_t> keys;  ///< two public keys: of the time slot, and the lasting one
};

/// Client -> server, repeated until welcomed.
struct Join {
  std::int64_t utime = 0;
  std::int32_t protocol = kProtocolVersion;
  std::int64_t token = 0;  ///< from the Challenge
  std::string name;        ///< 1..32 characters of [A-Za-z0-9_-]
  std::string room;        ///< name of the room, or "": the server's first
  std::int32_t epoch = 0;  ///< highest of the room that the client has seen; 0: none
  std::int64_t proof = 0;  ///< Welcome::proof of that epoch; 0: none
  std::vector<std::uint8_t> exchange, grant;  ///< a public and a sealed key; a connect token
};

/// Server -> client, reliable. The Room follows in Chunks.
struct Welcome {
  std::int64_t utime = 0;
  std::int32_t peer = 0;        ///< this client's peer number, >= 1
  std::int32_t player = -1;     ///< index of its player in the scene, -1 for a spectator
  std::int32_t room_bytes = 0;  ///< size of the compressed encoded Room that follows
  std::int64_t key = 0;         ///< secret of this player; for its next Join
  std::int32_t epoch = 1;       ///< of the room: grows when another server goes on with it
  std::int64_t proof = 0;       ///< EpochProof of that epoch, for the next Join
};

/// Client -> server, reliable: the client has loaded the room and its clock has settled.
struct Ready {
  std::int64_t utime = 0;
};

/// A piece of a message too large for a datagram; pieces are sent reliably and in order.
struct Chunk {
  std::int64_t utime = 0;
  std::int32_t offset_bytes = 0;
  std::vector<std::uint8_t> data;  ///< 1..1000 bytes
};

/// Description of the room, enough to simulate it. First message of every recording, repeated each
/// second.
struct Room {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t protocol = kProtocolVersion;
  std::string room;        ///< room name as in the channel
  std::string scene_name;  ///< file name of the scene without folder and ".toml"
  std::string scene_text;  ///< the whole scene file; on the bus "" if above kBusSceneBytesMax
  std::string mode;        ///< oracle | central | strict | buffer | lockstep ...
  std::string reconcile;   ///< snap | interleave | ... ; empty unless mode is buffer
  std::string predict;     ///< own | all; empty unless mode is central
  std::string impair;      ///< name of the network profile
  std::int64_t seed = 0;
  std::int32_t tick_hz = 60;
  std::int32_t send_hz = 30;           ///< rate of States from each peer
  std::int32_t input_delay_ticks = 0;  ///< from reading an input to its tick, on every peer
};

/// Client -> server: asks for the server's time.
struct Ping {
  std::int64_t utime = 0;        ///< client's clock when sent
  std::int32_t revision = -1;    ///< edits applied so far, -1 before there is a world
  std::int64_t composition = 0;  ///< hash of the composition after them
  std::int64_t rest = 0;         ///< hash of the bodies at rest, 0 for none
  std::int16_t rest_blocks = 0;  ///< number of blocks of bodies (RestBlock); 0: none
  std::int16_t rest_block = 0;   ///< index of one block
  std::int32_t rest_part = 0;    ///< hash of that block's bodies at rest
  std::int16_t load = -1;        ///< share of time spent on ticks, 1/1000; -1: unknown
};

/// Server -> client: the answer to a Ping.
struct Pong {
  std::int64_t utime = 0;        ///< server's clock when it answers
  std::int64_t client_us = 0;    ///< Ping::utime, returned
  std::int64_t tick0_us = -1;    ///< the room's clock shows utime - tick0_us; -1: not started
  std::int64_t rest = 0;         ///< hash of the bodies at rest, 0 for none
  std::int16_t rest_blocks = 0;  ///< Ping::rest_blocks and rest_block, returned; 0: none
  std::int16_t rest_block = 0;
  std::int32_t rest_own = 0;               ///< like rest_part, over the client's own bodies
  std::int32_t speed_ppm = kFullSpeedPpm;  ///< speed of the room's clock, per million of real time
};

/// A player's inputs for successive ticks.
struct Inputs {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t player = 0;
  std::int64_t first_tick = 0;        ///< tick *in* which element 0 acts: the state after shows it
  std::vector<std::int8_t> drive;     ///< -127..127: throttle, backwards to forwards
  std::vector<std::int8_t> lift;      ///< -127..127: second axis
  std::vector<std::int16_t> buttons;  ///< bit field
};

/// States of bodies after `tick`, from their authority. Quantised:
/// position 1/512 m about the origin, angle 2*pi/65536 rad, velocity 1/256 m/s, spin 1/256 rad/s.
struct States {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;  ///< the authority
  std::int64_t tick = 0;
  std::int32_t revision = 0;         ///< edits that the sender had applied
  std::int64_t composition = 0;      ///< hash of the composition at that revision
  std::int32_t origin_x = 0;         ///< whole metres
  std::int32_t origin_y = 0;         ///< whole metres
  std::vector<std::int32_t> id;      ///< assembly ids, ascending; all vectors of one length
  std::vector<std::int32_t> epoch;   ///< epoch of the body's mechanism
  std::vector<std::int8_t> flags;    ///< kStateAsleep | kStateImpact | kStateFalls
  std::vector<std::int16_t> x, y;    ///< 1/512 m
  std::vector<std::int16_t> angle;   ///< 2*pi/65536 rad, wraps
  std::vector<std::int16_t> vx, vy;  ///< 1/256 m/s
  std::vector<std::int16_t> spin;    ///< 1/256 rad/s
};
constexpr std::int8_t kStateAsleep = 1;
constexpr std::int8_t kStateImpact = 2;  ///< a major impact in the last second, on the authority
constexpr std::int8_t kStateFalls = 4;   ///< free fall: touches nothing, only gravity acts

/// Reliable: exact poses, after `tick`, of bodies that have come to rest, from their authority. A
/// pose is valid until a newer state of the body.
struct Rest {
  std::int64_t utime = 0;
  std::int32_t peer = 0;    ///< the authority
  std::int64_t number = 0;  ///< counts the peer's messages of this type
  std::int64_t tick = 0;
  std::int32_t revision = 0;        ///< edits that the authority had applied
  std::int64_t composition = 0;     ///< hash of the composition at that revision
  std::vector<std::int32_t> id;     ///< assembly ids, ascending
  std::vector<std::int32_t> epoch;  ///< epoch of the body's mechanism
  std::vector<float> x, y;          ///< m
  std::vector<float> angle;         ///< rad, unwrapped
};

/// Server -> everyone, reliable and ordered: the authority of mechanisms from `tick` on.
struct Grants {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int64_t tick = 0;
  std::vector<std::int32_t> mechanism;  ///< mechanism ids
  std::vector<std::int16_t> authority;  ///< peer
  std::vector<std::int32_t> epoch;      ///< grows with every change of authority
  std::vector<std::int16_t> followers;  ///< number of entries of `follower` for this mechanism
  std::vector<std::int16_t> follower;   ///< secondary peers, ascending for each mechanism
};

/// Client -> server, reliable: the client has released these mechanisms as grants of these epochs
/// demanded.
struct Release {
  std::int64_t utime = 0;
  std::int64_t tick = 0;
  std::vector<std::int32_t> mechanism;
  std::vector<std::int32_t> epoch;
};

/// Old authority -> server -> followers, reliable and before the Release: exact states of a
/// mechanism's bodies at the moment of release.
struct ExactStates {
  std::int64_t utime = 0;
  std::int64_t tick = 0;            ///< the states are those after it
  std::int32_t revision = 0;        ///< edits that the sender had applied
  std::vector<std::int32_t> id;     ///< assembly ids
  std::vector<std::int32_t> epoch;  ///< epoch of the grant that took the authority away
  std::vector<float> x, y, angle;   ///< m, m, rad (unwrapped)
  std::vector<float> vx, vy, spin;  ///< m/s, m/s, rad/s
};

/// Client -> server, reliable: impacts on bodies under the client's authority that are strong
/// enough to cause damage.
struct ImpactReport {
  std::int64_t utime = 0;
  std::int64_t tick = 0;            ///< tick of the impacts
  std::int32_t revision = 0;        ///< edits that the client had applied
  std::vector<std::int32_t> id;     ///< struck assembly, the client's
  std::vector<std::int32_t> epoch;  ///< epoch of the client's authority
  std::vector<std::int32_t> by;     ///< striking assembly; -1: something anchored
  std::vector<float> x, y;          ///< m, point of contact
  std::vector<float> dv;            ///< m/s, change of velocity of the struck body, >= 0
};

/// Client -> server, reliable: parts that began to touch, for a script that asks for touches.
struct TouchReport {
  std::int64_t utime = 0, tick = 0;  ///< tick: in which they began to touch
  std::int32_t revision = 0;         ///< edits that the client had applied
  std::vector<std::int32_t> a, b;    ///< parts, a < b
  std::vector<std::int32_t> epoch;   ///< of the client's authority over the first that moves
};

/// An edit: a change of bonds, joints or parts; see common/topology/edit.h for the fields of each
/// kind. From a client, a proposal of the authority; from the server, an order for everyone.
struct EditOrder {
  std::int64_t utime = 0;
  std::int64_t session = 0;
  /// On the bus, a message counter. In a proposal, the edits that the sender had applied, so that
  /// its joint index is never taken for another joint that has that index now.
  std::int64_t sequence = 0;
  std::int32_t number = -1;  ///< position in the order; -1: a proposal, or (server) start again
  std::int64_t tick = 0;     ///< server's tick of an order, sender's tick of a proposal
  std::int8_t kind = 0;
  std::int8_t cause = 0;
  std::int32_t a = -1, b = -1;
  std::int32_t joint = -1;
  std::int16_t player = -1;
  std::string text;                         ///< at most kEditTextBytesMax
  std::vector<float> value = {0, 0, 0, 0};  ///< x, y, angle, amount; a blast also has an impulse
};
/// Longest text of an edit; the whole message must fit kMessageBytesMax.
constexpr std::size_t kEditTextBytesMax = 900;
static_assert(kEditTextBytesMax < kMessageBytesMax);
constexpr std::int8_t kEditKindsMax = 8, kEditKindBlast = 8;

/// Server -> one client, reliable and ordered: entries that turn the scene into the current,
/// edited topology; see common/topology/topology_entry.h.
struct Snapshot {
  std::int64_t utime = 0;
  std::int32_t number = 0;  ///< edits of the world so far
  std::int32_t part = 0;    ///< index of this message among `parts`
  std::int32_t parts = 1;
  std::string text;  ///< TOML of the entries that insert, concatenated
  std::vector<std::int8_t> kind;
  std::vector<std::int32_t> joint;
  std::vector<std::int32_t> a, b;
  std::vector<float> value;  ///< numbers of the entries, in their order
};
/// Most parts of one snapshot: fewer than the send queue of a Link holds.
constexpr std::int32_t kSnapshotPartsMax = 3900;
/// Encoded bytes: a Snapshot without arrays and text, one entry, one number.
constexpr std::size_t kSnapshotBytes = 37, kSnapshotEntryBytes = 13, kSnapshotValueBytes = 4;

/// Server -> everyone, reliable and ordered: changed metadata of parts and players (health, score
/// and so on). Only the server decides it.
struct Meta {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
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
constexpr std::int8_t kMetaTaken = 4;       ///< on a pickup's part: 1 + index of the taking player
constexpr std::int8_t kMetaScripts = 16;    ///< 16..25: "value0".."value9", for scripts only
constexpr std::int8_t kMetaKeyMax = kMetaScripts + 9;

/// Bus only: the poses that a peer displays at a tick. Measures and drawings use them.
struct View {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::int32_t revision = 0;  ///< edits that the peer had applied
  std::int32_t part = 0;      ///< index among `parts`: very large views are split
  std::int32_t parts = 1;
  std::vector<std::int32_t> id;         ///< assembly ids, ascending
  std::vector<std::int8_t> role;        ///< kRole...
  std::vector<std::int16_t> authority;  ///< the authority as this peer knows it
  std::vector<float> x, y, angle;       ///< m, m, rad (unwrapped): as displayed
  std::vector<float> vx, vy, spin;      ///< m/s, m/s, rad/s: simulated
  std::vector<float> age;               ///< ticks, the pose is that of so long before `tick`
  std::int16_t unmoved = 0;  ///< ticks just before `tick` that showed what the view before shows
};
constexpr std::int8_t kRoleRemote = 0, kRoleSecondary = 1, kRoleAuthority = 2;

/// Bus only: the strands that a peer displays at a tick. Never compared between peers.
struct Strands {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;             ///< tick of the View
  std::vector<std::int16_t> strand;  ///< index of the point's [[strand]]; points are in order
  std::vector<float> x, y;           ///< m
};

/// Bus only: major impacts in a peer's world in a tick.
struct Impacts {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::vector<std::int32_t> id_a, id_b;  ///< assembly ids; -1 for anchored ground
  std::vector<float> x, y;               ///< m
  std::vector<float> dv;                 ///< m/s, the larger velocity change of the two bodies
};

/// On the bus once a second from every peer: counters since the peer started.
struct Stats {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::int64_t bytes_out = 0, bytes_in = 0;  ///< UDP payload
  std::int64_t datagrams_out = 0, datagrams_in = 0;
  std::int64_t dropped_malformed = 0;    ///< did not decode, or not ours
  std::int64_t dropped_stale = 0;        ///< old epoch or old tick
  std::int64_t dropped_right = 0;        ///< the sender has no right to send it
  std::int64_t dropped_implausible = 0;  ///< not finite, too fast, out of the world
  std::int64_t dropped_budget = 0;       ///< datagrams beyond their sender's rate limit
  std::int64_t cpu_us = 0;               ///< CPU time of the process (0 in virtual time)
  std::int32_t rtt_us = 0;               ///< least round trip of the last window, -1 unknown
  std::int32_t jitter_us = -1;           ///< 90th percentile of round trips less rtt_us, -1 unknown
  std::int32_t loss_ppm = 0;             ///< datagrams lost on the way in, per million
  std::int32_t tick_late_us = 0;         ///< worst lateness of a tick in the last second
  std::int32_t clock_offset_us = 0;      ///< clock offset still to be slewed away
};

/// Both directions: the last message of a link, or the refusal of a Hello.
struct Bye {
  std::int64_t utime = 0;
  std::string reason;
};

}  // namespace seam
