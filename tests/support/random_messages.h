#pragma once
/// Random valid messages of every type, and their comparison field by field: for tests.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "common/base/random.h"
#include "common/codec/message_list.h"

namespace seam {

/// Fills messages with contents that are valid and use the whole range of each field.
class RandomMessages {
 public:
  explicit RandomMessages(std::uint64_t seed) : random_(seed) {}

  std::int64_t Integer(std::int64_t low, std::int64_t high) {
    return low +
           static_cast<std::int64_t>(random_.Next() % (static_cast<std::uint64_t>(high - low) + 1));
  }
  std::size_t Count(std::size_t low, std::size_t high) {
    return static_cast<std::size_t>(
        Integer(static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)));
  }

  void Fill(Hello& m) { Common(m), m.protocol = Int32(), m.name = Name(); }
  void Fill(Challenge& m) {
    Common(m), m.token = static_cast<std::int64_t>(random_.Next());
    Vector(m.keys, kChallengeKeysBytes, 0, 255);
  }
  void Fill(Join& m) {
    Common(m), m.protocol = Int32(), m.token = static_cast<std::int64_t>(random_.Next());
    m.name = Name(), m.room = Name(), Vector(m.exchange, kJoinExchangeBytes, 0, 255);
    Set(m.epoch, 0, INT32_MAX), m.proof = static_cast<std::int64_t>(random_.Next());
    Vector(m.grant, Count(0, kPassBytesMax), 0, 255);
  }
  void Fill(Ready& m) { Common(m); }
  void Fill(Welcome& m) {
    Common(m), Set(m.peer, 1, 31), Set(m.player, -1, 31), Set(m.room_bytes, 1, kPackedRoomBytesMax);
    m.key = static_cast<std::int64_t>(random_.Next());
    Set(m.epoch, 1, INT32_MAX), m.proof = static_cast<std::int64_t>(random_.Next());
  }
  void Fill(Redirect& m) {
    Common(m), m.address = "a" + Text(60), m.room = Name(), Set(m.epoch, 1, INT32_MAX);
  }
  void Fill(Chunk& m) {
    Common(m), Set(m.offset_bytes, 0, 4000000), Vector(m.data, Count(1, kChunkBytesMax), 0, 255);
  }
  void Fill(Room& m) {
    Common(m), m.protocol = Int32(), m.room = Name(), m.scene_name = Text(64), m.mode = Text(64);
    m.scene_text = Text(300) + "\n\t" + Text(99), m.reconcile = Text(64), m.impair = Text(200);
    m.seed = static_cast<std::int64_t>(random_.Next()), Set(m.tick_hz, 10, 960);
    Set(m.send_hz, 1, m.tick_hz), Sequence(m);
    m.predict = Text(64), Set(m.input_delay_ticks, 0, kInputDelayTicksMax);
  }
  void Fill(ScenePart& m) {
    Common(m), Sequence(m), m.session = Integer(1, INT64_MAX - 1), Set(m.parts, 1, kScenePartsMax);
    m.part = m.parts - 1, Vector(m.data, Count(1, 200), 0, 255);
  }
  void Fill(Ping& m) {
    Common(m), Set(m.revision, -1, INT32_MAX);
    m.composition = static_cast<std::int64_t>(random_.Next());
    m.rest = static_cast<std::int64_t>(random_.Next()), Set(m.load, -1, INT16_MAX);
  }
  void Fill(Pong& m) {
    Common(m), m.client_us = Time(), m.tick0_us = Time();
    m.rest = static_cast<std::int64_t>(random_.Next());
    Set(m.speed_ppm, kLeastSpeedPpm, kFullSpeedPpm);
  }
  void Fill(Inputs& m, std::size_t count) {
    Common(m), Sequence(m), Set(m.player, 0, 31), m.first_tick = Tick();
    Vector(m.drive, count, -127, 127), Vector(m.lift, count, -127, 127), Any(m.buttons, count);
  }
  void Fill(Inputs& m) { Fill(m, Count(1, kInputsMax)); }
  void Fill(States& m, std::size_t count) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick();
    Set(m.revision, 0, INT32_MAX), m.composition = static_cast<std::int64_t>(random_.Next());
    Set(m.origin_x, -kOriginMax, kOriginMax), Set(m.origin_y, -kOriginMax, kOriginMax);
    Ids(m.id, count), Vector(m.epoch, count, 0, INT32_MAX), Vector(m.flags, count, 0, 3),
        Any(m.x, count);
    Any(m.y, count), Any(m.angle, count), Any(m.vx, count), Any(m.vy, count), Any(m.spin, count);
  }
  void Fill(States& m) { Fill(m, Count(0, kStatesBodiesMax)); }
  void Fill(PackedStates& m) { Vector(m.data, Count(1, kPackedBytesMax), 0, 255); }
  void Fill(Differing& m) { Vector(m.mechanism, Count(1, kDifferingMax), 0, kIdsMax - 1); }
  void Fill(Reset& m) { Set(m.number, INT16_MIN, INT16_MAX); }
  void Fill(PackedInputs& m) { Vector(m.bits, Count(1, kPackedBytesMax), 0, 255); }
  void Fill(Rest& m, std::size_t count) {
    Common(m), Set(m.peer, 0, 31), Set(m.number, 0, kTimeMaxUs - 1), m.tick = Tick();
    Set(m.revision, 0, INT32_MAX), m.composition = static_cast<std::int64_t>(random_.Next());
    Ids(m.id, count), Vector(m.epoch, count, 0, INT32_MAX);
    Floats(m.x, count), Floats(m.y, count), Floats(m.angle, count);
  }
  void Fill(Rest& m) { Fill(m, Count(0, kRestBodiesMax)); }
  void Fill(Grants& m, std::size_t count) {
    Common(m), Sequence(m), m.tick = Tick(), Vector(m.mechanism, count, 0, kIdsMax - 1);
    Vector(m.authority, count, 0, 31), Vector(m.epoch, count, 0, INT32_MAX);
    Vector(m.followers, count, 0, 1);
    Vector(m.follower,
           static_cast<std::size_t>(std::count(m.followers.begin(), m.followers.end(), 1)), 0, 31);
  }
  void Fill(Snapshot& m) {
    Common(m), Set(m.number, 0, INT32_MAX), Set(m.parts, 1, 3900), Set(m.part, 0, m.parts - 1);
    const std::size_t count = Count(0, 50);
    m.text = Text(60), Vector(m.kind, count, 1, 127), Vector(m.joint, count, -1, INT32_MAX);
    Vector(m.a, count, -1, kIdsMax - 1), Vector(m.b, count, -1, kIdsMax - 1);
    Floats(m.value, Count(0, 80));
  }
  void Fill(Release& m) {
    const std::size_t count = Count(1, kReleasesMax);
    Common(m), m.tick = Tick(), Vector(m.mechanism, count, 0, kIdsMax - 1);
    Vector(m.epoch, count, 0, INT32_MAX);
  }
  void Fill(ExactStates& m, std::size_t count) {
    Common(m), m.tick = Tick(), Set(m.revision, 0, INT32_MAX);
    Vector(m.id, count, 0, kIdsMax - 1), Vector(m.epoch, count, 0, INT32_MAX);
    Floats(m.x, count), Floats(m.y, count), Floats(m.angle, count);
    Floats(m.vx, count), Floats(m.vy, count), Floats(m.spin, count);
  }
  void Fill(ExactStates& m) { Fill(m, Count(1, kExactBodiesMax)); }
  void Fill(ImpactReport& m, std::size_t count) {
    Common(m), m.tick = Tick(), Set(m.revision, 0, INT32_MAX);
    Vector(m.id, count, 0, kIdsMax - 1), Vector(m.epoch, count, 0, INT32_MAX);
    Vector(m.by, count, -1, kIdsMax - 1);
    Floats(m.x, count), Floats(m.y, count), Floats(m.dv, count);
    for (float& dv : m.dv) dv = std::fabs(dv);
  }
  void Fill(ImpactReport& m) { Fill(m, Count(1, kReportedImpactsMax)); }
  void Fill(TouchReport& m, std::size_t count) {
    Common(m), m.tick = Tick(), Set(m.revision, 0, INT32_MAX);
    Vector(m.a, count, 0, kIdsMax / 2 - 1), Vector(m.b, count, kIdsMax / 2, kIdsMax - 1);
    Vector(m.epoch, count, 0, INT32_MAX);
  }
  void Fill(TouchReport& m) { Fill(m, Count(1, kReportedTouchesMax)); }
  void Fill(Grants& m) { Fill(m, Count(0, kGrantsMax)); }
  void Fill(EditOrder& m) {
    Common(m), Sequence(m), Set(m.number, -1, INT32_MAX), m.tick = Tick();
    Set(m.kind, 0, kEditKindsMax), Set(m.cause, 0, 1), Set(m.player, -1, 31);
    for (auto* id : {&m.a, &m.b}) Set(*id, -1, kIdsMax - 1);
    Set(m.joint, -1, INT32_MAX);
    Floats(m.value, m.kind == kEditKindBlast ? 5 : 4), m.text = Text(300);
  }
  void Fill(Meta& m, std::size_t count) {
    Common(m), Sequence(m), m.tick = Tick(), Vector(m.kind, count, 0, 1);
    Vector(m.id, count, 0, kIdsMax - 1), Vector(m.key, count, 0, kMetaKeyMax);
    Floats(m.value, count);
  }
  void Fill(Meta& m) { Fill(m, Count(0, kMetaMax)); }
  void Fill(View& m, std::size_t count) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick(), Set(m.parts, 1, kViewPartsMax);
    Set(m.revision, 0, INT32_MAX);
    Set(m.part, 0, m.parts - 1), Ids(m.id, count), Vector(m.role, count, 0, 2);
    Vector(m.authority, count, 0, 31), Floats(m.x, count), Floats(m.y, count);
    Floats(m.angle, count), Floats(m.vx, count), Floats(m.vy, count), Floats(m.spin, count);
    m.age.assign(count, 0);  // without a session, ages are not encoded
  }
  void Fill(View& m) { Fill(m, Count(0, 60)); }
  void Fill(Impacts& m, std::size_t count) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick();
    Vector(m.id_a, count, -1, kIdsMax - 1), Vector(m.id_b, count, -1, kIdsMax - 1);
    Floats(m.x, count), Floats(m.y, count), Floats(m.dv, count);
  }
  void Fill(Impacts& m) { Fill(m, Count(0, 60)); }
  void Fill(Strands& m, std::size_t count) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick();
    Vector(m.strand, count, 0, INT16_MAX), std::sort(m.strand.begin(), m.strand.end());
    Floats(m.x, count), Floats(m.y, count);
  }
  void Fill(Strands& m) { Fill(m, Count(0, 60)); }
  void Fill(Stats& m) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick();
    for (auto* n : {&m.bytes_out, &m.bytes_in, &m.datagrams_out, &m.datagrams_in,
                    &m.dropped_malformed, &m.dropped_stale, &m.dropped_right,
                    &m.dropped_implausible, &m.dropped_budget, &m.cpu_us}) {
      Set(*n, 0, kTimeMaxUs - 1);
    }
    Set(m.rtt_us, -1, INT32_MAX), Set(m.jitter_us, -1, INT32_MAX);
    Set(m.loss_ppm, 0, 1000000), m.tick_late_us = Int32(), m.clock_offset_us = Int32();
  }
  void Fill(Load& m) {
    Common(m), Sequence(m), m.tick = Tick(), Set(m.speed_ppm, kLeastSpeedPpm, kFullSpeedPpm);
    for (auto* n : {&m.ticks, &m.tick_p50_us, &m.tick_p99_us, &m.tick_max_us, &m.late_p50_us,
                    &m.late_p99_us, &m.late_max_us, &m.clients, &m.players, &m.bodies, &m.moving,
                    &m.moving_held, &m.islands}) {
      Set(*n, 0, INT32_MAX);
    }
    for (auto* n : {&m.cpu_us, &m.hand_overs, &m.jumps, &m.dropped_malformed, &m.dropped_stale,
                    &m.dropped_right, &m.dropped_implausible, &m.dropped_budget}) {
      Set(*n, 0, kTimeMaxUs - 1);
    }
    const std::size_t count = Count(0, kTrafficMax);
    Vector(m.kind, count, 0, kTrafficOther);
    m.bytes_out.resize(count), m.bytes_in.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      Set(m.bytes_out[i], 0, kTimeMaxUs - 1), Set(m.bytes_in[i], 0, kTimeMaxUs - 1);
    }
  }
  void Fill(Event& m) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick(), m.text = Text(1000);
    // Without a session, nothing of what follows the text is encoded.
  }
  void Fill(Summary& m) {
    Common(m), Sequence(m), m.session = Integer(1, INT64_MAX - 1), m.tick = Tick();
    Set(m.ended, 0, 2), m.of = Integer(1, INT64_MAX - 1);
    for (auto* n :
         {&m.ticks, &m.late_ticks, &m.edits, &m.hand_overs, &m.events, &m.events_dropped}) {
      Set(*n, 0, kTimeMaxUs - 1);
    }
    const std::size_t count = Count(0, 3);
    Set(m.clients, static_cast<int>(count), 5000), m.names = Text(60);
    Vector(m.peer, count, 0, 31), Vector(m.player, count, -1, 31), Vector(m.trust, count, 0, 5);
    for (auto* v : {&m.joins, &m.rejoins}) Vector(*v, count, 0, INT32_MAX);
    for (auto* v : {&m.rtt_us, &m.rtt_worst_us, &m.loss_ppm}) Vector(*v, count, -1, INT32_MAX);
    for (auto* v : {&m.present_ticks, &m.bytes_in, &m.bytes_out, &m.corrections, &m.malformed,
                    &m.stale, &m.right, &m.implausible, &m.budget, &m.hand_overs_to}) {
      v->resize(count);
      for (std::int64_t& n : *v) Set(n, 0, kTimeMaxUs - 1);
    }
    Floats(m.score, count);
  }
  void Fill(TickChain& m) {
    Common(m), Sequence(m), m.session = Integer(1, INT64_MAX - 1), Set(m.peer, 0, 31);
    m.tick = Tick(), Set(m.messages, -1, INT32_MAX), Set(m.log_events, 0, INT32_MAX);
    m.messages_crc = Int32(), m.log_crc = Int32();
  }
  void Fill(LogSeal& m) {
    Common(m), m.session = Integer(1, INT64_MAX - 1), Set(m.sequence, 0, INT32_MAX);
    Set(m.peer, 0, 31), m.tick = Tick(), Set(m.messages, -1, INT32_MAX);
    Set(m.log_events, 0, INT32_MAX), m.messages_crc = Int32(), m.log_crc = Int32();
    m.log_keyed.resize(Count(0, 1) * kLogKeyedBytes);
    for (std::uint8_t& byte : m.log_keyed) byte = static_cast<std::uint8_t>(Int32());
    std::vector<SealedTick> ticks(Count(0, kSealTicksMax));
    for (SealedTick& tick : ticks) {
      Set(tick.before, 0, INT32_MAX), Set(tick.after, 0, 300), Set(tick.hash, 0, UINT16_MAX);
    }
    m.ticks = PackTicks(ticks);
  }
  void Fill(Accepted& m) {
    Common(m), m.session = Integer(1, INT64_MAX - 1), Set(m.sequence, 0, INT32_MAX);
    Set(m.peer, 0, 31), Set(m.player, -1, 31), Vector(m.data, Count(0, 300), 0, 255);
  }
  void Fill(Audit& m) {
    Common(m), Sequence(m), m.session = Integer(1, INT64_MAX - 1), m.tick = Tick();
    Set(m.peer, 0, 31), Set(m.player, -1, 31), Set(m.body, -1, kIdsMax - 1);
    const std::size_t count = m.body < 0 ? 0 : kAuditNumbers;
    Floats(m.told, count), Floats(m.expected, count);
    Set(m.refused, 0, 1), Set(m.score_milli, 0, INT32_MAX), Set(m.step, 0, kAuditStepMax);
  }
  void Fill(Divergence& m) {
    Common(m), Sequence(m), Set(m.peer, 0, 31), m.tick = Tick(), Set(m.more, 0, INT32_MAX);
    const std::size_t count = Count(1, kDivergenceMax);
    Ids(m.body, count);
    m.at.resize(count);
    for (std::int64_t& at : m.at) at = Tick();
    Vector(m.holder, count, 0, kPeersMax - 1), Vector(m.missing, count, 0, kPlayersMax);
    Floats(m.apart, count), Floats(m.kick, count);
    for (float& apart : m.apart) apart = std::fabs(apart);
    for (float& kick : m.kick) kick = std::fabs(kick);
  }
  void Fill(Bye& m) { Common(m), m.reason = Text(200); }

 private:
  std::int64_t Time() { return Integer(-kTimeMaxUs + 1, kTimeMaxUs - 1); }
  std::int64_t Tick() { return Integer(0, kTickMax - 1); }
  std::int32_t Int32() { return static_cast<std::int32_t>(random_.Next()); }
  template <class M>
  void Common(M& m) {
    m.utime = Time();
  }
  template <class M>
  void Sequence(M& m) {
    Set(m.sequence, 0, INT64_MAX - 1);
  }
  template <class T>
  void Set(T& value, std::int64_t low, std::int64_t high) {
    value = static_cast<T>(Integer(low, high));
  }
  template <class T>
  void Vector(std::vector<T>& v, std::size_t count, std::int64_t low, std::int64_t high) {
    v.resize(count);
    for (T& x : v) Set(x, low, high);
  }
  template <class T>
  void Any(std::vector<T>& v, std::size_t count) {
    v.resize(count);
    for (T& x : v) x = static_cast<T>(random_.Next());
  }
  void Floats(std::vector<float>& v, std::size_t count) {
    v.resize(count);
    for (float& x : v) x = static_cast<float>(random_.Uniform(-1e6, 1e6));
  }
  void Ids(std::vector<std::int32_t>& ids, std::size_t count) {
    ids.resize(count);
    const auto step = kIdsMax / static_cast<std::int64_t>(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
      Set(ids[i], static_cast<std::int64_t>(i) * step, static_cast<std::int64_t>(i + 1) * step - 1);
    }
  }
  std::string Name() {
    std::string name(Count(1, 32), ' ');
    for (char& c : name) c = "abcXYZ019_-"[Integer(0, 10)];
    return name;
  }
  std::string Text(std::size_t bytes_max) {
    static const char* const kPieces[] = {"a",  "Z",      " ",      "~",
                                          "\"", "\u00e4", "\u20ac", "\U0001F600"};
    std::string text;
    for (std::size_t n = Count(0, bytes_max / 4); n > 0; --n) text += kPieces[Integer(0, 7)];
    return text;
  }

  Random random_;
};

/// Returns the fields of a message as a tie, for comparison.
template <class Message>
auto Fields(const Message& m) {
  return MessageTraits<Message>::Fields(m);
}

}  // namespace seam
