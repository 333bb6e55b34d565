#include "common/codec/packed/states_packer.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace seam {
namespace {

/// Most messages with contents remembered until they are acknowledged.
constexpr std::size_t kSentMost = 256;
/// Time between resends of a lost state, us: the first, and the longest.
constexpr std::int64_t kResendUs = 100000, kResendUsMax = 400000;
/// Most emptied records kept for reuse of their memory.
constexpr std::size_t kSpareMost = 16;
/// Most bytes of an entry, a group's header and all end marks together.
constexpr std::size_t kEntryBytesMost = 64;

/// Joins successive codes into one Put. Its bits stay in registers, while those of BitWriter are in
/// memory; this requires that every function is inlined.
class Run {
 public:
  explicit Run(BitWriter* bits) : bits_(bits) {}
  /// Like BitWriter::Put, but `value` must have no more than `width` bits.
  __attribute__((always_inline)) void Put(std::uint64_t value, int width) {
    if (width_ + width > 32) End();
    held_ = held_ << width | value;
    width_ += width;
  }
  __attribute__((always_inline)) void PutGolomb(std::uint32_t value, int k) {
    const std::uint64_t shifted = value + (std::uint64_t{1} << k);
    const int width = 2 * BitWidth(shifted) - 1 - k;
    if (__builtin_expect(width <= 32, 1)) return Put(shifted, width);
    End();
    PutLong(bits_, value, k);
  }
  __attribute__((always_inline)) void End() {
    PutAll(bits_, held_, width_);
    held_ = 0;
    width_ = 0;
  }

 private:
  __attribute__((noinline)) static void PutAll(BitWriter* bits, std::uint64_t held, int width) {
    bits->Put(held, width);
  }
  __attribute__((noinline)) static void PutLong(BitWriter* bits, std::uint32_t value, int k) {
    bits->PutGolomb(value, k);
  }

  BitWriter* const bits_;
  std::uint64_t held_ = 0;
  int width_ = 0;  // at most 32
};

std::int32_t Difference(std::int16_t a, std::int16_t b) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(a - b));
}

std::int32_t VelocityError(const WireBody& state, const WireBody& guess) {
  return std::abs(Difference(state.vx, guess.vx)) + std::abs(Difference(state.vy, guess.vy));
}

}  // namespace

StatesPacker::Known& StatesPacker::KnownOf(std::int32_t id) {
  const auto i = static_cast<std::size_t>(id);
  if (place_.size() <= i) place_.resize(i + 1, -1);
  if (place_[i] < 0) {
    place_[i] = static_cast<std::int32_t>(known_.size());
    known_.emplace_back();
  }
  return known_[static_cast<std::size_t>(place_[i])];
}

void StatesPacker::Spare(std::vector<Sent>* bodies) {
  bodies->clear();
  if (bodies->capacity() > 0 && spare_.size() < kSpareMost) spare_.push_back(std::move(*bodies));
  *bodies = {};
}

void StatesPacker::Begin(const StatesHeader& header) {
  open_ = true;
  ++number_;
  if (sent_.size() >= kSentMost) {
    Spare(&sent_.front());
    sent_.pop_front();
  }
  sent_.emplace_back();
  if (!spare_.empty()) {
    sent_.back().swap(spare_.back());
    spare_.pop_back();
  }
  context_ = PackedContext();
  revision_ = header.revision;
  composition_ = header.composition;
  const auto composition = static_cast<std::uint64_t>(header.composition);
  bits_.Put(static_cast<std::uint64_t>(number_), 16);
  bits_.PutGolomb(static_cast<std::uint32_t>(header.revision), 4);
  bits_.Put(composition >> 32, 32);
  bits_.Put(composition, 32);
  bits_.Put(static_cast<std::uint64_t>(header.tick) >> 20, 20);
  bits_.Put(static_cast<std::uint64_t>(header.tick), 20);
  context_.tick = header.tick;
}

void StatesPacker::BeginGroup(const StatesHeader& header) {
  group_ = true;
  peer_ = header.peer;
  bits_.Put(1, 1);
  bits_.PutGolomb(static_cast<std::uint32_t>(header.peer), 4);
  const std::int64_t ticks = header.tick - context_.tick;
  bits_.PutGolomb(ZigZag(static_cast<std::int32_t>(ticks)), 0);
  context_.tick = header.tick;
  context_.id = -1;
  context_.id_gap = 0;
}

bool StatesPacker::Continues(const StatesHeader& header, std::int32_t id) const {
  return group_ && header.peer == peer_ && header.tick == context_.tick && id > context_.id;
}

void StatesPacker::End() {
  if (!open_) return;
  bits_.Put(0, group_ ? 2 : 1);
  open_ = group_ = false;
  Message message;
  message.number = number_;
  message.bodies = sent_.back().size();
  message.packed.data = bits_.Finish();
  ready_.push_back(std::move(message));
}

void StatesPacker::PutDifferences(const WireBody& state, const WireBody& guess,
                                  std::array<AdaptiveGolomb, kPackedFields>* learned) {
  Run run(&bits_);
  const auto put = [&](PackedField field, std::int32_t difference) __attribute__((always_inline)) {
    AdaptiveGolomb& with = (*learned)[field];
    const std::uint32_t code = ZigZag(difference);
    run.PutGolomb(code, with.k());
    with.Note(code);
  };
  put(kPackedVx, Difference(state.vx, guess.vx));
  put(kPackedVy, Difference(state.vy, guess.vy));
  put(kPackedSpin, Difference(state.spin, guess.spin));
  put(kPackedX, static_cast<std::int32_t>(state.x - guess.x));
  put(kPackedY, static_cast<std::int32_t>(state.y - guess.y));
  put(kPackedAngle, Difference(state.angle, guess.angle));
  run.End();
}

void StatesPacker::AddBody(const WireBody& state) {
  Run run(&bits_);
  run.Put(1, 1);
  const std::int32_t gap = state.id - context_.id;
  if (gap == context_.id_gap) {
    run.Put(1, 1);
  } else {
    if (context_.id_gap > 0) run.Put(0, 1);
    run.PutGolomb(static_cast<std::uint32_t>(gap - 1), context_.id < 0 ? 8 : 2);
  }
  context_.id_gap = context_.id < 0 ? 1 : gap;
  context_.id = state.id;
  Known& known = KnownOf(state.id);
  const bool kept = known.number >= 0 && known.sent - known.count < kPackedKept;
  const auto back = kept ? static_cast<std::uint32_t>(number_ - known.number) : 0;
  run.Put(back == context_.back ? 1 : 0, 1);
  if (back != context_.back) run.PutGolomb(back, 4);
  context_.back = back;
  const WireBody& before = kept ? known.state : context_.last;
  const bool same = state.epoch == before.epoch && state.flags == before.flags;
  run.Put(same ? 1 : 0, 1);
  if (!same) {
    run.PutGolomb(static_cast<std::uint32_t>(state.epoch), 4);
    run.Put(static_cast<std::uint64_t>(state.flags) & 7, 3);
  }
  if (kept) {
    // Chooses the better prediction: free fall or constant velocity.
    const WireBody fallen = PredictVelocity(motion_, before, state.tick, true);
    const bool falls = VelocityError(state, fallen) < VelocityError(state, before);
    run.Put(falls ? 1 : 0, 1);
    run.End();
    WireBody now = state;
    PredictPose(motion_, before, &now);
    now.vx = falls ? fallen.vx : before.vx;
    now.vy = falls ? fallen.vy : before.vy;
    now.spin = before.spin;
    PutDifferences(state, now, &context_.known);
  } else {
    run.End();
    WireBody guess;
    guess.x = context_.last.x;
    guess.y = context_.last.y;
    PutDifferences(state, guess, &context_.fresh);
  }
  context_.last = state;
  sent_.back().push_back({state, ++known.sent});
}

void StatesPacker::AddEntry(const StatesHeader& header, const WireBody& state, bool* begun) {
  if (open_ && bits_.size() + kEntryBytesMost > kPackedBytesMax) End();
  if (!open_) {
    Begin(header);
    *begun = false;
  }
  if (!*begun) {
    if (group_) bits_.Put(0, 1);
    BeginGroup(header);
    *begun = true;
  }
  AddBody(state);
}

void StatesPacker::Add(const States& states) {
  const StatesHeader header = HeaderOf(states);
  const bool other = header.revision != revision_ || header.composition != composition_;
  if (open_ && other) End();
  bool begun = !states.id.empty() && Continues(header, states.id.front());
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    AddEntry(header, BodyAt(states, i), &begun);
  }
}

void StatesPacker::Add(const StatesHeader& header, const WireBody* begin, const WireBody* end) {
  const bool other = header.revision != revision_ || header.composition != composition_;
  if (open_ && other) End();
  bool begun = begin != end && Continues(header, begin->id);
  for (; begin != end; ++begin) AddEntry(header, *begin, &begun);
}

std::vector<StatesPacker::Message> StatesPacker::Take(std::int64_t now_us) {
  End();
  for (const Message& message : ready_) in_flight_.push_back({message.number, now_us});
  while (in_flight_.size() > kSentMost) in_flight_.pop_front();
  return std::exchange(ready_, {});
}

std::vector<StatesPacker::Sent>* StatesPacker::StatesSentIn(std::int64_t number) {
  const std::int64_t age = number_ - number;
  if (age < 0 || age >= static_cast<std::int64_t>(sent_.size())) return nullptr;
  return &sent_[sent_.size() - 1 - static_cast<std::size_t>(age)];
}

void StatesPacker::FindLostStates(std::int64_t until_us) {
  const std::size_t before = owed_.size();
  for (; !in_flight_.empty() && in_flight_.front().sent_us <= until_us; in_flight_.pop_front()) {
    const std::vector<Sent>* const bodies = StatesSentIn(in_flight_.front().number);
    if (bodies == nullptr) continue;
    for (const Sent& sent : *bodies) {
      const std::int32_t id = sent.state.id;
      if (KnownOf(id).count < sent.count) owed_.push_back({id, sent.count, 0, kResendUs});
    }
  }
  if (owed_.size() != before) MergeOwed();
}

/// Merges entries of one body: the last lost state counts, the timer continues.
void StatesPacker::MergeOwed() {
  std::stable_sort(owed_.begin(), owed_.end(),
                   [](const Owed& a, const Owed& b) { return a.id < b.id; });
  std::size_t left = 0;
  for (const Owed& owed : owed_) {
    if (left > 0 && owed_[left - 1].id == owed.id) {
      owed_[left - 1].count = owed.count;
    } else {
      owed_[left++] = owed;
    }
  }
  owed_.resize(left);
}

std::vector<std::int32_t> StatesPacker::TakeLost(std::int64_t now_us, std::int64_t late_us,
                                                 const Wanted& wanted) {
  FindLostStates(now_us - late_us);
  std::vector<std::int32_t> again;
  std::size_t left = 0;
  for (Owed owed : owed_) {
    if (KnownOf(owed.id).count >= owed.count) continue;
    if (now_us >= owed.due_us) {
      if (!wanted(owed.id)) continue;
      again.push_back(owed.id);
      owed.due_us = now_us + owed.again_us;
      owed.again_us = std::min(2 * owed.again_us, kResendUsMax);
    }
    owed_[left++] = owed;
  }
  owed_.resize(left);
  return again;
}

void StatesPacker::Reset(std::uint16_t number) {
  const auto ahead = static_cast<std::uint16_t>(number - static_cast<std::uint16_t>(number_));
  const std::int64_t refused = number_ + static_cast<std::int16_t>(ahead);
  if (refused > number_ - (open_ ? 1 : 0) || refused <= refused_) return;
  refused_ = refused;
  for (std::size_t id = 0; id < place_.size(); ++id) {
    if (place_[id] < 0) continue;
    Known& known = known_[static_cast<std::size_t>(place_[id])];
    if (known.number > refused) continue;
    known.number = -1;
    known.count = 0;
    owed_.push_back({static_cast<std::int32_t>(id), known.sent, 0, kResendUs});
  }
  MergeOwed();
}

void StatesPacker::Acknowledge(std::int64_t number) {
  if (number <= refused_) return;
  std::vector<Sent>* const bodies = StatesSentIn(number);
  if (bodies == nullptr) return;
  for (const Sent& sent : *bodies) {
    Known& known = KnownOf(sent.state.id);
    if (number < known.number) continue;
    known.number = number;
    known.count = sent.count;
    known.state = sent.state;
  }
  Spare(bodies);
}

}  // namespace seam
