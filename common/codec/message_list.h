#pragma once
/// The one list of messages. It generates Encode, Decode, the numbering on the bus and the
/// recording's table. A new message needs a .lcm file, a struct in messages.h, a Valid in
/// validate.cpp, and a line here.

#include <tuple>

#include "common/codec/accepted.h"
#include "common/codec/chain.h"
#include "common/codec/log_seal.h"
#include "common/codec/messages.h"
#include "common/codec/packed/packed_inputs.h"
#include "common/codec/packed/packed_states.h"
#include "common/codec/scene_part.h"

/// X(struct, LCM type, route, kind in the channel, fields of `m` in the .lcm's order)
///
///   kEdge       between server and client only; foreign on the bus
///   kBusRoom    on the bus too, channel SEAM.<room>.<kind>
///   kBusPeer    on the bus too, channel SEAM.<room>.<kind>.<peer>
///   kBusPlayer  on the bus too, channel SEAM.<room>.<kind>.<player>
#define SEAM_MESSAGES(X)                                                                           \
  X(Hello, hello_t, kEdge, "", m.utime, m.protocol, m.name)                                        \
  X(Challenge, challenge_t, kEdge, "", m.utime, m.token, m.keys)                                   \
  X(Join, join_t, kEdge, "", m.utime, m.protocol, m.token, m.name, m.room, m.exchange, m.epoch,    \
    m.proof, m.grant)                                                                              \
  X(Welcome, welcome_t, kEdge, "", m.utime, m.peer, m.player, m.room_bytes, m.key, m.epoch,        \
    m.proof)                                                                                       \
  X(Redirect, redirect_t, kEdge, "", m.utime, m.address, m.room, m.epoch)                          \
  X(Chunk, chunk_t, kEdge, "", m.utime, m.offset_bytes, m.data)                                    \
  X(Ready, ready_t, kEdge, "", m.utime)                                                            \
  X(Room, room_t, kBusRoom, "scene", m.utime, m.session, m.sequence, m.protocol, m.room,           \
    m.scene_name, m.scene_text, m.mode, m.reconcile, m.predict, m.impair, m.seed, m.tick_hz,       \
    m.send_hz, m.input_delay_ticks)                                                                \
  X(ScenePart, scene_part_t, kBusRoom, "scene_part", m.utime, m.session, m.sequence, m.part,       \
    m.parts, m.data)                                                                               \
  X(Ping, ping_t, kEdge, "", m.utime, m.revision, m.composition, m.rest, m.rest_blocks,            \
    m.rest_block, m.rest_part, m.load)                                                             \
  X(Pong, pong_t, kEdge, "", m.utime, m.client_us, m.tick0_us, m.rest, m.rest_blocks,              \
    m.rest_block, m.rest_own, m.speed_ppm)                                                         \
  X(Inputs, inputs_t, kBusPlayer, "inputs", m.utime, m.session, m.sequence, m.player,              \
    m.first_tick, m.drive, m.lift, m.buttons)                                                      \
  X(States, states_t, kBusPeer, "states", m.utime, m.session, m.sequence, m.peer, m.tick,          \
    m.revision, m.composition, m.origin_x, m.origin_y, m.id, m.epoch, m.flags, m.x, m.y, m.angle,  \
    m.vx, m.vy, m.spin)                                                                            \
  X(Rest, rest_t, kEdge, "", m.utime, m.peer, m.number, m.tick, m.revision, m.composition, m.id,   \
    m.epoch, m.x, m.y, m.angle)                                                                    \
  X(Grants, grants_t, kBusRoom, "grants", m.utime, m.session, m.sequence, m.tick, m.mechanism,     \
    m.authority, m.epoch, m.followers, m.follower)                                                 \
  X(Release, release_t, kEdge, "", m.utime, m.tick, m.mechanism, m.epoch)                          \
  X(ExactStates, exact_states_t, kEdge, "", m.utime, m.tick, m.revision, m.id, m.epoch, m.x, m.y,  \
    m.angle, m.vx, m.vy, m.spin)                                                                   \
  X(ImpactReport, impact_report_t, kEdge, "", m.utime, m.tick, m.revision, m.id, m.epoch, m.by,    \
    m.x, m.y, m.dv)                                                                                \
  X(TouchReport, touch_report_t, kEdge, "", m.utime, m.tick, m.revision, m.a, m.b, m.epoch)        \
  X(EditOrder, edit_t, kBusRoom, "edit", m.utime, m.session, m.sequence, m.number, m.tick, m.kind, \
    m.cause, m.a, m.b, m.joint, m.player, m.text, m.value)                                         \
  X(Snapshot, snapshot_t, kEdge, "", m.utime, m.number, m.part, m.parts, m.text, m.kind, m.joint,  \
    m.a, m.b, m.value)                                                                             \
  X(Meta, meta_t, kBusRoom, "meta", m.utime, m.session, m.sequence, m.tick, m.kind, m.id, m.key,   \
    m.value)                                                                                       \
  X(View, view_t, kBusPeer, "view", m.utime, m.session, m.sequence, m.peer, m.tick, m.revision,    \
    m.part, m.parts, m.id, m.role, m.authority, m.x, m.y, m.angle, m.vx, m.vy, m.spin, m.age,      \
    m.unmoved)                                                                                     \
  X(Impacts, impacts_t, kBusPeer, "impacts", m.utime, m.session, m.sequence, m.peer, m.tick,       \
    m.id_a, m.id_b, m.x, m.y, m.dv)                                                                \
  X(Strands, strands_t, kBusPeer, "strands", m.utime, m.session, m.sequence, m.peer, m.tick,       \
    m.strand, m.x, m.y)                                                                            \
  X(Stats, stats_t, kBusPeer, "stats", m.utime, m.session, m.sequence, m.peer, m.tick,             \
    m.bytes_out, m.bytes_in, m.datagrams_out, m.datagrams_in, m.dropped_malformed,                 \
    m.dropped_stale, m.dropped_right, m.dropped_implausible, m.dropped_budget, m.cpu_us, m.rtt_us, \
    m.jitter_us, m.loss_ppm, m.tick_late_us, m.clock_offset_us)                                    \
  X(Load, load_t, kBusRoom, "load", m.utime, m.session, m.sequence, m.tick, m.speed_ppm, m.ticks,  \
    m.tick_p50_us, m.tick_p99_us, m.tick_max_us, m.late_p50_us, m.late_p99_us, m.late_max_us,      \
    m.cpu_us, m.clients, m.players, m.bodies, m.moving, m.moving_held, m.islands, m.hand_overs,    \
    m.jumps, m.dropped_malformed, m.dropped_stale, m.dropped_right, m.dropped_implausible,         \
    m.dropped_budget, m.kind, m.bytes_out, m.bytes_in)                                             \
  X(Event, event_t, kBusPeer, "event", m.utime, m.session, m.sequence, m.peer, m.tick, m.text,     \
    m.kind, m.client, m.player, m.body, m.other, m.index, m.value_milli)                           \
  X(Summary, summary_t, kBusRoom, "summary", m.utime, m.session, m.sequence, m.tick, m.of,         \
    m.ended, m.ticks, m.late_ticks, m.edits, m.hand_overs, m.events, m.events_dropped, m.clients,  \
    m.names, m.peer, m.player, m.joins, m.rejoins, m.present_ticks, m.score, m.bytes_in,           \
    m.bytes_out, m.rtt_us, m.rtt_worst_us, m.loss_ppm, m.corrections, m.malformed, m.stale,        \
    m.right, m.implausible, m.budget, m.hand_overs_to, m.trust)                                    \
  X(TickChain, chain_t, kBusPeer, "chain", m.utime, m.session, m.sequence, m.peer, m.tick,         \
    m.messages, m.messages_crc, m.log_events, m.log_crc)                                           \
  X(LogSeal, seal_t, kBusPeer, "chain", m.utime, m.session, m.sequence, m.peer, m.tick,            \
    m.messages, m.messages_crc, m.ticks, m.log_events, m.log_keyed, m.log_crc)                     \
  X(Accepted, accepted_t, kBusPeer, "accepted", m.utime, m.session, m.sequence, m.peer, m.player,  \
    m.data)                                                                                        \
  X(Audit, audit_t, kBusRoom, "audit", m.utime, m.session, m.sequence, m.tick, m.peer, m.player,   \
    m.body, m.refused, m.score_milli, m.step, m.told, m.expected)                                  \
  X(Divergence, divergence_t, kBusPeer, "divergence", m.utime, m.session, m.sequence, m.peer,      \
    m.tick, m.more, m.body, m.at, m.holder, m.missing, m.apart, m.kick)                            \
  X(Bye, bye_t, kEdge, "", m.utime, m.reason)                                                      \
  X(PackedStates, packed_states_t, kEdge, "", m.data)                                              \
  X(PackedInputs, packed_inputs_t, kEdge, "", m.bits)                                              \
  X(Reset, reset_t, kEdge, "", m.number)                                                           \
  X(Differing, differing_t, kEdge, "", m.mechanism)

namespace seam {

/// The route of a message.
enum class Travels { kEdge, kBusRoom, kBusPeer, kBusPlayer };

template <class Message>
struct MessageTraits;

// Traits of each message from the list: kTravels, kKind, and Fields(m), its fields as a tuple.
#define SEAM_MESSAGE_TRAITS(Struct, lcm_type, travels, kind, ...) \
  template <>                                                     \
  struct MessageTraits<Struct> {                                  \
    static constexpr Travels kTravels = Travels::travels;         \
    static constexpr const char* kKind = kind;                    \
    template <class M>                                            \
    static auto Fields(M& m) {                                    \
      return std::tie(__VA_ARGS__);                               \
    }                                                             \
  };
SEAM_MESSAGES(SEAM_MESSAGE_TRAITS)
#undef SEAM_MESSAGE_TRAITS

}  // namespace seam
