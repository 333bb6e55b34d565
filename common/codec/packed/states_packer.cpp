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
/// Most bytes of an entry, a group's header and all end marks together: 11 numbers and 16 bits. A
/// bit costs at most 10, where its model is surest of the other; a number has 7 such, and 30 raw.
constexpr std::size_t kEntryBytesMost = (11 * (7 * 10 + 30) + 16 * 10) / 8 + 1;

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
    Spare(&sent_.front().bodies);
    sent_.pop_front();
  }
  sent_.emplace_back();
  if (!spare_.empty()) {
    sent_.back().bodies.swap(spare_.back());
    spare_.pop_back();
  }
  context_ = FreshContext();
  header_ = {number_, header.revision, header.composition, header.tick};
  sent_.back().header = header_;
  bits_.Raw(static_cast<std::uint64_t>(number_), 16);
  CodeHeader(
      arrived_, [&](std::int64_t) { return &arrived_; }, &context_, &bits_, &header_);
  context_.tick = header.tick;
}

void StatesPacker::BeginGroup(const StatesHeader& header) {
  group_ = true;
  peer_ = header.peer;
  bits_.Code(true, &context_.another_group);
  bits_.Code(static_cast<std::uint32_t>(header.peer), &context_.peer);
  const std::int64_t ticks = header.tick - context_.tick;
  bits_.Code(ZigZag(static_cast<std::int32_t>(ticks)), &context_.ticks);
  context_.tick = header.tick;
  context_.id = -1;
  context_.id_gap = 0;
}

bool StatesPacker::Continues(const StatesHeader& header, std::int32_t id) const {
  return group_ && header.peer == peer_ && header.tick == context_.tick && id > context_.id;
}

void StatesPacker::End() {
  if (!open_) return;
  if (group_) bits_.Code(false, &context_.another_body);
  bits_.Code(false, &context_.another_group);
  bits_.Raw(context_.entries, kEntriesBits);
  open_ = group_ = false;
  Message message;
  message.number = number_;
  message.bodies = sent_.back().bodies.size();
  message.packed.data = bits_.Finish();
  ready_.push_back(std::move(message));
}

void StatesPacker::AddBody(const WireBody& state) {
  bits_.Code(true, &context_.another_body);
  const std::int32_t gap = state.id - context_.id;
  const bool other_gap = gap != context_.id_gap;
  if (context_.id_gap > 0) bits_.Code(other_gap, &context_.other_gap);
  if (other_gap) {
    bits_.Code(static_cast<std::uint32_t>(gap - 1),
               context_.id < 0 ? &context_.first_id : &context_.gap);
  }
  context_.id_gap = context_.id < 0 ? 1 : gap;
  context_.id = state.id;
  Known& known = KnownOf(state.id);
  const bool kept = known.number >= 0 && known.sent - known.count < kPackedKept;
  const auto back = kept ? static_cast<std::uint32_t>(number_ - known.number) : 0;
  if (bits_.Code(back != context_.back, &context_.other_back)) bits_.Code(back, &context_.back_by);
  context_.back = back;
  const WireBody& before = kept ? known.state : context_.last;
  const bool other = state.epoch != before.epoch || state.flags != before.flags;
  if (bits_.Code(other, &context_.other_owner)) {
    bits_.Code(static_cast<std::uint32_t>(state.epoch), &context_.epoch);
    bits_.Raw(static_cast<std::uint64_t>(state.flags), kFlagBits);
  }
  bool falls = false;
  if (kept) {
    // The better prediction: free fall or constant velocity.
    const WireBody fallen = PredictVelocity(motion_, before, state.tick, true);
    falls = VelocityError(state, fallen) < VelocityError(state, before);
    bits_.Code(falls, &context_.falls);
  }
  WireBody coded = state;
  CodeFields(motion_, kept ? &before : nullptr, falls, &context_, &bits_, &coded);
  context_.last = state;
  ++context_.entries;
  sent_.back().bodies.push_back({state, ++known.sent});
}

void StatesPacker::AddEntry(const StatesHeader& header, const WireBody& state, bool* begun) {
  if (open_ && bits_.size() + kEntryBytesMost > kPackedBytesMax) End();
  if (!open_) {
    Begin(header);
    *begun = false;
  }
  if (!*begun) {
    if (group_) bits_.Code(false, &context_.another_body);
    BeginGroup(header);
    *begun = true;
  }
  AddBody(state);
}

void StatesPacker::Add(const States& states) {
  const StatesHeader header = HeaderOf(states);
  const bool other =
      header.revision != header_.revision || header.composition != header_.composition;
  if (open_ && other) End();
  bool begun = !states.id.empty() && Continues(header, states.id.front());
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    AddEntry(header, BodyAt(states, i), &begun);
  }
}

void StatesPacker::Add(const StatesHeader& header, const WireBody* begin, const WireBody* end) {
  const bool other =
      header.revision != header_.revision || header.composition != header_.composition;
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

StatesPacker::SentMessage* StatesPacker::Find(std::int64_t number) {
  const std::int64_t age = number_ - number;
  if (age < 0 || age >= static_cast<std::int64_t>(sent_.size())) return nullptr;
  return &sent_[sent_.size() - 1 - static_cast<std::size_t>(age)];
}

void StatesPacker::FindLostStates(std::int64_t until_us) {
  const std::size_t before = owed_.size();
  for (; !in_flight_.empty() && in_flight_.front().sent_us <= until_us; in_flight_.pop_front()) {
    const SentMessage* const message = Find(in_flight_.front().number);
    if (message == nullptr) continue;
    for (const Sent& sent : message->bodies) {
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
  if (arrived_.number <= refused) arrived_ = PackedHeader();
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
  SentMessage* const message = Find(number);
  if (message == nullptr) return;
  if (number > arrived_.number) arrived_ = message->header;
  for (const Sent& sent : message->bodies) {
    Known& known = KnownOf(sent.state.id);
    if (number < known.number) continue;
    known.number = number;
    known.count = sent.count;
    known.state = sent.state;
  }
  Spare(&message->bodies);
}

}  // namespace seam
