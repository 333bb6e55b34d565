#include "common/codec/validate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "common/base/names.h"

namespace seam {
namespace {

template <class T, class L, class H>
bool Within(T value, L low, H high) {
  return value >= static_cast<T>(low) && value <= static_cast<T>(high);
}

bool Time(std::int64_t us) { return us > -kTimeMaxUs && us < kTimeMaxUs; }
bool Counter(std::int64_t n) { return n >= 0 && n < kTimeMaxUs; }
bool Tick(std::int64_t tick) { return tick >= 0 && tick < kTickMax; }
/// Returns true for a tick, or for -1: statistics and events may precede the first tick.
bool TickOrBefore(std::int64_t tick) { return tick == -1 || Tick(tick); }
/// Returns true for an index below `blocks`, or for index 0 if there are no blocks.
bool Block(int blocks, int block) {
  return Within(blocks, 0, kRestBlocksMax) && Within(block, 0, std::max(0, blocks - 1));
}
bool Peer(std::int32_t peer) { return Within(peer, 0, kPeersMax - 1); }

/// Most bodies in one View of protocol 12, which had no ages.
constexpr std::size_t kViewBodiesReadMax = 1900;
static_assert(kViewBodiesMax <= kViewBodiesReadMax);

template <class... Vectors>
bool Lengths(std::size_t length, const Vectors&... vectors) {
  return ((vectors.size() == length) && ...);
}

template <class T, class L, class H>
bool AllWithin(const std::vector<T>& values, L low, H high) {
  return std::all_of(values.begin(), values.end(), [&](T v) { return Within(v, low, high); });
}

template <class... Vectors>
bool Finite(const Vectors&... vectors) {
  const auto finite = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  };
  return (finite(vectors) && ...);
}

bool Ids(const std::vector<std::int32_t>& ids, std::int32_t least = 0) {
  return AllWithin(ids, least, kIdsMax - 1);
}

/// Returns true if the ids ascend strictly.
bool Ascending(const std::vector<std::int32_t>& ids) {
  return Ids(ids) && std::adjacent_find(ids.begin(), ids.end(), [](std::int32_t a, std::int32_t b) {
                       return a >= b;
                     }) == ids.end();
}

}  // namespace

bool Valid(const Hello& m) { return Time(m.utime) && IsName(m.name); }

bool Valid(const Challenge& m) { return Time(m.utime) && m.keys.size() == kChallengeKeysBytes; }

bool Valid(const Join& m) {
  return Time(m.utime) && IsName(m.name) && (m.room.empty() || IsName(m.room)) &&
         m.exchange.size() == kJoinExchangeBytes && m.epoch >= 0 && m.grant.size() <= kPassBytesMax;
}

bool Valid(const Ready& m) { return Time(m.utime); }

bool Valid(const Welcome& m) {
  return Time(m.utime) && Within(m.peer, 1, kPeersMax - 1) && Within(m.player, -1, kPeersMax - 1) &&
         Within(m.room_bytes, 1, kPackedRoomBytesMax) && m.epoch >= 1;
}

bool Valid(const Chunk& m) {
  return Time(m.utime) && Within(m.offset_bytes, 0, kPackedRoomBytesMax) &&
         Within(m.data.size(), 1, kChunkBytesMax) &&
         static_cast<std::size_t>(m.offset_bytes) + m.data.size() <= kPackedRoomBytesMax;
}

bool Valid(const Room& m) {
  return Time(m.utime) && m.sequence >= kSaidAgain && IsPrintable(m.room, kLabelBytesMax) &&
         IsPrintable(m.scene_name, kLabelBytesMax) &&
         IsPrintable(m.scene_text, kSceneTextBytesMax, true) &&
         IsPrintable(m.mode, kLabelBytesMax) && IsPrintable(m.reconcile, kLabelBytesMax) &&
         IsPrintable(m.predict, kLabelBytesMax) && IsPrintable(m.impair, kImpairBytesMax) &&
         Within(m.input_delay_ticks, 0, kInputDelayTicksMax) &&
         Within(m.tick_hz, kTickHzMin, kTickHzMax) && Within(m.send_hz, 1, m.tick_hz);
}

bool Valid(const ScenePart& m) {
  const bool last = m.part == m.parts - 1;
  return Time(m.utime) && m.session != 0 && m.sequence >= kSaidAgain &&
         Within(m.parts, 1, kScenePartsMax) && Within(m.part, 0, m.parts - 1) &&
         Within(m.data.size(), last ? 1 : kScenePartBytes, kScenePartBytes);
}

bool Valid(const Ping& m) {
  return Time(m.utime) && m.revision >= -1 && m.load >= -1 && Block(m.rest_blocks, m.rest_block);
}

bool Valid(const Pong& m) {
  return Time(m.utime) && Time(m.client_us) && Time(m.tick0_us) &&
         Within(m.speed_ppm, kLeastSpeedPpm, kFullSpeedPpm) && Block(m.rest_blocks, m.rest_block);
}

bool Valid(const Inputs& m) {
  return Time(m.utime) && m.sequence >= 0 && Within(m.player, 0, kPeersMax - 1) &&
         Tick(m.first_tick) && Within(m.drive.size(), 1, kInputsMax) &&
         Lengths(m.drive.size(), m.lift, m.buttons) && AllWithin(m.drive, -127, 127) &&
         AllWithin(m.lift, -127, 127);
}

bool Valid(const States& m) {
  return Time(m.utime) && m.sequence >= 0 && m.revision >= 0 && Peer(m.peer) && Tick(m.tick) &&
         m.id.size() <= kStatesBodiesMax &&
         Lengths(m.id.size(), m.epoch, m.flags, m.x, m.y, m.angle, m.vx, m.vy, m.spin) &&
         Ascending(m.id) && AllWithin(m.epoch, 0, INT32_MAX) &&
         AllWithin(m.flags, 0, kStateAsleep | kStateImpact | kStateFalls) &&
         Within(m.origin_x, -kOriginMax, kOriginMax) && Within(m.origin_y, -kOriginMax, kOriginMax);
}

bool Valid(const PackedInputs& m) { return Within(m.bits.size(), 1, kPackedBytesMax); }

bool Valid(const Reset&) { return true; }

bool Valid(const Differing& m) {
  return Within(m.mechanism.size(), 1, kDifferingMax) && Ids(m.mechanism);
}

bool Valid(const PackedStates& m) { return Within(m.data.size(), 1, kPackedBytesMax); }

bool Valid(const Rest& m) {
  return Time(m.utime) && Counter(m.number) && m.revision >= 0 && Peer(m.peer) && Tick(m.tick) &&
         m.id.size() <= kRestBodiesMax && Lengths(m.id.size(), m.epoch, m.x, m.y, m.angle) &&
         Ascending(m.id) && AllWithin(m.epoch, 0, INT32_MAX) && Finite(m.x, m.y, m.angle);
}

bool Valid(const Grants& m) {
  return Time(m.utime) && m.sequence >= 0 && Tick(m.tick) && m.mechanism.size() <= kGrantsMax &&
         Lengths(m.mechanism.size(), m.authority, m.epoch, m.followers) &&
         m.follower.size() <= kGrantFollowersMax && Ids(m.mechanism) &&
         AllWithin(m.authority, 0, kPeersMax - 1) && AllWithin(m.epoch, 0, INT32_MAX) &&
         AllWithin(m.followers, 0, kPeersMax) && AllWithin(m.follower, 0, kPeersMax - 1) &&
         std::accumulate(m.followers.begin(), m.followers.end(), std::size_t{0}) ==
             m.follower.size();
}

bool Valid(const Release& m) {
  return Time(m.utime) && Tick(m.tick) && Within(m.mechanism.size(), 1, kReleasesMax) &&
         Lengths(m.mechanism.size(), m.epoch) && Ids(m.mechanism) &&
         AllWithin(m.epoch, 0, INT32_MAX);
}

bool Valid(const ExactStates& m) {
  return Time(m.utime) && Tick(m.tick) && m.revision >= 0 &&
         Within(m.id.size(), 1, kExactBodiesMax) &&
         Lengths(m.id.size(), m.epoch, m.x, m.y, m.angle, m.vx, m.vy, m.spin) && Ids(m.id) &&
         AllWithin(m.epoch, 0, INT32_MAX) && Finite(m.x, m.y, m.angle, m.vx, m.vy, m.spin);
}

bool Valid(const ImpactReport& m) {
  return Time(m.utime) && Tick(m.tick) && m.revision >= 0 &&
         Within(m.id.size(), 1, kReportedImpactsMax) &&
         Lengths(m.id.size(), m.epoch, m.by, m.x, m.y, m.dv) && Ids(m.id) &&
         AllWithin(m.epoch, 0, INT32_MAX) && Ids(m.by, -1) && Finite(m.x, m.y, m.dv) &&
         std::all_of(m.dv.begin(), m.dv.end(), [](float dv) { return dv >= 0; });
}

bool Valid(const TouchReport& m) {
  bool ascend = m.a.size() == m.b.size();
  for (std::size_t i = 0; ascend && i < m.a.size(); ++i) ascend = m.a[i] < m.b[i];
  return Time(m.utime) && Tick(m.tick) && m.revision >= 0 &&
         Within(m.a.size(), 1, kReportedTouchesMax) && Lengths(m.a.size(), m.b, m.epoch) &&
         Ids(m.a) && Ids(m.b) && ascend && AllWithin(m.epoch, 0, INT32_MAX);
}

bool Valid(const EditOrder& m) {
  return Time(m.utime) && m.sequence >= 0 && m.number >= -1 && Tick(m.tick) &&
         Within(m.kind, 0, kEditKindsMax) && Within(m.cause, 0, 1) &&
         Within(m.a, -1, kIdsMax - 1) && Within(m.b, -1, kIdsMax - 1) && m.joint >= -1 &&
         Within(m.player, -1, kPeersMax - 1) &&
         (m.value.size() == 4 || (m.kind == kEditKindBlast && m.value.size() == 5)) &&
         Finite(m.value) && IsPrintable(m.text, kEditTextBytesMax, true);
}

bool Valid(const Snapshot& m) {
  const std::size_t bytes = kSnapshotBytes + kSnapshotEntryBytes * m.kind.size() +
                            kSnapshotValueBytes * m.value.size() + m.text.size();
  return Time(m.utime) && m.number >= 0 && Within(m.parts, 1, kSnapshotPartsMax) &&
         Within(m.part, 0, m.parts - 1) && bytes <= kMessageBytesMax &&
         Lengths(m.kind.size(), m.joint, m.a, m.b) && AllWithin(m.kind, 1, INT8_MAX) &&
         AllWithin(m.joint, -1, INT32_MAX) && Ids(m.a, -1) && Ids(m.b, -1) && Finite(m.value) &&
         IsPrintable(m.text, kEditTextBytesMax, true);
}

bool Valid(const Meta& m) {
  return Time(m.utime) && m.sequence >= 0 && Tick(m.tick) && m.id.size() <= kMetaMax &&
         Lengths(m.id.size(), m.kind, m.key, m.value) &&
         AllWithin(m.kind, kMetaPart, kMetaPlayer) && Ids(m.id) &&
         AllWithin(m.key, 0, kMetaKeyMax) && Finite(m.value);
}

bool Valid(const View& m) {
  return Time(m.utime) && m.sequence >= 0 && m.revision >= 0 && Peer(m.peer) && Tick(m.tick) &&
         Within(m.parts, 1, kViewPartsMax) && Within(m.part, 0, m.parts - 1) &&
         m.id.size() <= kViewBodiesReadMax &&
         Lengths(m.id.size(), m.role, m.authority, m.x, m.y, m.angle, m.vx, m.vy, m.spin, m.age) &&
         Ascending(m.id) && AllWithin(m.role, kRoleRemote, kRoleAuthority) &&
         AllWithin(m.authority, 0, kPeersMax - 1) &&
         Finite(m.x, m.y, m.angle, m.vx, m.vy, m.spin) && AllWithin(m.age, 0, kTickMax) &&
         Within(m.unmoved, 0, kViewUnmovedMax);
}

bool Valid(const Impacts& m) {
  return Time(m.utime) && m.sequence >= 0 && Peer(m.peer) && Tick(m.tick) &&
         m.id_a.size() <= kImpactsMax && Lengths(m.id_a.size(), m.id_b, m.x, m.y, m.dv) &&
         Ids(m.id_a, -1) && Ids(m.id_b, -1) && Finite(m.x, m.y, m.dv);
}

bool Valid(const Strands& m) {
  return Time(m.utime) && m.sequence >= 0 && Peer(m.peer) && Tick(m.tick) &&
         m.strand.size() <= kStrandPointsMax && Lengths(m.strand.size(), m.x, m.y) &&
         AllWithin(m.strand, 0, INT16_MAX) && std::is_sorted(m.strand.begin(), m.strand.end()) &&
         Finite(m.x, m.y);
}

bool Valid(const Stats& m) {
  return Time(m.utime) && m.sequence >= 0 && Peer(m.peer) && TickOrBefore(m.tick) &&
         Counter(m.bytes_out) && Counter(m.bytes_in) && Counter(m.datagrams_out) &&
         Counter(m.datagrams_in) && Counter(m.dropped_malformed) && Counter(m.dropped_stale) &&
         Counter(m.dropped_right) && Counter(m.dropped_implausible) && Counter(m.dropped_budget) &&
         Counter(m.cpu_us) && m.rtt_us >= -1 && m.jitter_us >= -1 && Within(m.loss_ppm, 0, 1000000);
}

bool Valid(const Load& m) {
  bool good = Time(m.utime) && m.sequence >= 0 && TickOrBefore(m.tick) &&
              Within(m.speed_ppm, kLeastSpeedPpm, kFullSpeedPpm) && m.kind.size() <= kTrafficMax &&
              Lengths(m.kind.size(), m.bytes_out, m.bytes_in) &&
              AllWithin(m.kind, 0, kTrafficOther);
  for (const std::int32_t n :
       {m.ticks, m.tick_p50_us, m.tick_p99_us, m.tick_max_us, m.late_p50_us, m.late_p99_us,
        m.late_max_us, m.clients, m.players, m.bodies, m.moving, m.moving_held, m.islands}) {
    good = good && n >= 0;
  }
  for (const std::int64_t n :
       {m.cpu_us, m.hand_overs, m.jumps, m.dropped_malformed, m.dropped_stale, m.dropped_right,
        m.dropped_implausible, m.dropped_budget}) {
    good = good && Counter(n);
  }
  for (const std::int64_t n : m.bytes_out) good = good && Counter(n);
  for (const std::int64_t n : m.bytes_in) good = good && Counter(n);
  return good;
}

bool Valid(const Event& m) {
  return Time(m.utime) && m.sequence >= 0 && Peer(m.peer) && TickOrBefore(m.tick) &&
         IsPrintable(m.text, kTextBytesMax) && Within(m.kind, 0, kEventKindMax) &&
         Within(m.client, -1, kPeersMax - 1) && Within(m.player, -1, kPlayersMax - 1) &&
         Within(m.body, -1, kIdsMax - 1) && Within(m.other, -1, kIdsMax - 1) && m.index >= -1 &&
         Within(m.value_milli, -kEventValueMax, kEventValueMax);
}

bool Valid(const Summary& m) {
  const std::size_t count = m.peer.size();
  bool good = Time(m.utime) && m.session != 0 && m.sequence >= 0 && TickOrBefore(m.tick) &&
              Within(m.ended, 0, static_cast<std::int8_t>(Ended::kKilled)) &&
              count <= kSummaryClientsMax && m.clients >= static_cast<std::int32_t>(count) &&
              IsPrintable(m.names, 33 * kSummaryClientsMax) &&
              Lengths(count, m.player, m.joins, m.rejoins, m.present_ticks, m.score, m.bytes_in,
                      m.bytes_out, m.rtt_us, m.rtt_worst_us, m.loss_ppm, m.corrections, m.malformed,
                      m.stale, m.right, m.implausible, m.budget, m.hand_overs_to, m.trust) &&
              AllWithin(m.peer, 0, kPeersMax - 1) && AllWithin(m.player, -1, kPlayersMax - 1) &&
              Finite(m.score) && AllWithin(m.trust, 0, kAuditStepMax);
  const std::int64_t totals[] = {m.ticks,      m.late_ticks, m.edits,
                                 m.hand_overs, m.events,     m.events_dropped};
  good = good && std::all_of(std::begin(totals), std::end(totals), Counter);
  for (const auto* counts :
       {&m.present_ticks, &m.bytes_in, &m.bytes_out, &m.corrections, &m.malformed, &m.stale,
        &m.right, &m.implausible, &m.budget, &m.hand_overs_to}) {
    good = good && std::all_of(counts->begin(), counts->end(), Counter);
  }
  for (const auto* counts : {&m.joins, &m.rejoins}) good = good && AllWithin(*counts, 0, INT32_MAX);
  return good && AllWithin(m.rtt_us, -1, INT32_MAX) && AllWithin(m.rtt_worst_us, -1, INT32_MAX) &&
         AllWithin(m.loss_ppm, -1, INT32_MAX);
}

bool Valid(const TickChain& m) {
  return Time(m.utime) && m.session != 0 && m.sequence >= 0 && Peer(m.peer) &&
         TickOrBefore(m.tick) && m.messages >= -1 && m.log_events >= 0;
}

bool Valid(const LogSeal& m) {
  const bool keyed = m.log_keyed.empty() || m.log_keyed.size() == kLogKeyedBytes;
  return Time(m.utime) && m.session != 0 && m.sequence >= 0 && Peer(m.peer) && keyed &&
         TickOrBefore(m.tick) && m.messages >= -1 && m.log_events >= 0 && TicksOf(m);
}

bool Valid(const Accepted& m) {
  return Time(m.utime) && m.session != 0 && m.sequence >= 0 && Peer(m.peer) &&
         Within(m.player, -1, kPlayersMax - 1) && m.data.size() <= kAcceptedBytesMax;
}

bool Valid(const Audit& m) {
  const std::size_t numbers = m.body < 0 ? 0 : kAuditNumbers;
  return Time(m.utime) && m.session != 0 && m.sequence >= 0 && Tick(m.tick) && Peer(m.peer) &&
         Within(m.player, -1, kPlayersMax - 1) && Within(m.body, -1, kIdsMax - 1) &&
         Within(m.refused, 0, 1) && m.score_milli >= 0 && Within(m.step, 0, kAuditStepMax) &&
         Lengths(numbers, m.told, m.expected) && Finite(m.told, m.expected);
}

bool Valid(const Divergence& m) {
  const auto sizes = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return v >= 0; });
  };
  return Time(m.utime) && m.sequence >= 0 && Peer(m.peer) && Tick(m.tick) && m.more >= 0 &&
         Within(m.body.size(), 1, kDivergenceMax) && Ascending(m.body) &&
         Lengths(m.body.size(), m.at, m.holder, m.missing, m.apart, m.kick) &&
         std::all_of(m.at.begin(), m.at.end(), Tick) && AllWithin(m.holder, 0, kPeersMax - 1) &&
         AllWithin(m.missing, 0, kPlayersMax) && Finite(m.apart, m.kick) && sizes(m.apart) &&
         sizes(m.kick);
}

bool Valid(const Bye& m) { return Time(m.utime) && IsPrintable(m.reason, kImpairBytesMax); }

}  // namespace seam
