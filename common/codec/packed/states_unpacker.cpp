#include "common/codec/packed/states_unpacker.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>

#include "common/codec/validate.h"

namespace seam {
namespace {

/// Messages by which another may be overtaken without harm. Differences in later messages refer to
/// the same state or a newer one, so that older states are dropped only after this many.
constexpr std::int64_t kOvertaken = 64;

std::int16_t Low(std::uint32_t value) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(value & 0xffffu));
}

/// Returns true if the coordinate is within the range of origins.
bool InRange(std::uint32_t coordinate) {
  constexpr std::int64_t kCoordinateMax = std::int64_t{kOriginMax} * kQuantaPerMetre;
  const std::int64_t value = static_cast<std::int32_t>(coordinate);
  return value >= -kCoordinateMax && value <= kCoordinateMax;
}

}  // namespace

const WireBody* StatesUnpacker::Find(std::int32_t id, std::int64_t number) const {
  const auto i = static_cast<std::size_t>(id);
  if (i >= place_.size() || place_[i] < 0) return nullptr;
  // Searched from the newest: most reference states are recent.
  const std::vector<Kept>& all = kept_[static_cast<std::size_t>(place_[i])].all;
  auto at = all.rbegin();
  while (at != all.rend() && at->number > number) ++at;
  return at != all.rend() && at->number == number ? &at->state : nullptr;
}

std::size_t StatesUnpacker::kept() const {
  return std::accumulate(kept_.begin(), kept_.end(), std::size_t{0},
                         [](std::size_t sum, const Body& body) { return sum + body.all.size(); });
}

void StatesUnpacker::Keep(std::int64_t number, const Entry& entry) {
  const auto i = static_cast<std::size_t>(entry.state.id);
  if (place_.size() <= i) place_.resize(i + 1, -1);
  if (place_[i] < 0) {
    place_[i] = static_cast<std::int32_t>(kept_.size());
    kept_.emplace_back();
  }
  Body& body = kept_[static_cast<std::size_t>(place_[i])];
  std::vector<Kept>& all = body.all;
  auto at = all.end();
  while (at != all.begin() && (at - 1)->number > number) --at;
  if (at != all.begin() && (at - 1)->number == number) {
    (at - 1)->state = entry.state;  // the body is twice in one message: the later entry counts
    return;
  }
  all.insert(at, {number, entry.state});
  if (all.size() > static_cast<std::size_t>(kPackedKept)) all.erase(all.begin());
  if (number - body.marked < kOvertaken) return;
  const auto forgotten = [&](const Kept& kept) { return kept.number < body.marked_from; };
  all.erase(all.begin(), std::find_if_not(all.begin(), all.end(), forgotten));
  body.marked = number;
  body.marked_from = entry.from;
}

bool StatesUnpacker::TakeBody(BitReader* bits, std::int64_t number, Entry* entry) {
  PackedContext& context = context_;
  const bool as_before = context.id_gap > 0 && bits->Get(1) != 0;
  const std::int64_t gap =
      as_before ? context.id_gap : std::int64_t{bits->GetGolomb(context.id < 0 ? 8 : 2)} + 1;
  const std::int64_t id = context.id + gap;
  if (id >= ids_) return false;
  context.id_gap = context.id < 0 ? 1 : static_cast<std::int32_t>(gap);
  context.id = static_cast<std::int32_t>(id);
  if (bits->Get(1) == 0) context.back = bits->GetGolomb(4);
  const WireBody* from = nullptr;
  if (context.back > 0) {
    entry->from = number - context.back;
    from = Find(context.id, entry->from);
    if (from == nullptr) return false;
  }
  const WireBody& before = from != nullptr ? *from : context.last;
  WireBody state;
  state.tick = context.tick;
  state.id = context.id;
  state.epoch = before.epoch;
  state.flags = before.flags;
  if (bits->Get(1) == 0) {
    state.epoch = static_cast<std::int32_t>(bits->GetGolomb(4));
    state.flags = static_cast<std::int8_t>(bits->Get(3));
  }
  std::array<AdaptiveGolomb, kPackedFields>& learned =
      from != nullptr ? context.known : context.fresh;
  const auto get = [&](PackedField field) {
    const std::uint32_t code = bits->GetGolomb(learned[field].k());
    learned[field].Note(code);
    return static_cast<std::uint32_t>(UnZigZag(code));
  };
  const auto add = [&](PackedField field, std::int16_t* value) {
    *value = Low(static_cast<std::uint32_t>(*value) + get(field));
  };
  if (from != nullptr) {
    const WireBody guess = PredictVelocity(motion_, *from, state.tick, bits->Get(1) != 0);
    state.vx = guess.vx;
    state.vy = guess.vy;
    state.spin = guess.spin;
  }
  add(kPackedVx, &state.vx);
  add(kPackedVy, &state.vy);
  add(kPackedSpin, &state.spin);
  if (from != nullptr) {
    PredictPose(motion_, *from, &state);
  } else {
    state.x = context.last.x;
    state.y = context.last.y;
  }
  state.x += get(kPackedX);
  state.y += get(kPackedY);
  add(kPackedAngle, &state.angle);
  context.last = entry->state = state;
  return bits->ok() && InRange(state.x) && InRange(state.y);
}

/// Begins the next States of a message, without bodies, with its origin at the first body.
States* StatesUnpacker::Begin(const States& header, const WireBody& first) {
  if (spare_.empty()) spare_.emplace_back();
  told_.push_back(std::move(spare_.back()));
  spare_.pop_back();
  States& states = told_.back();
  states.peer = header.peer;
  states.tick = header.tick;
  states.revision = header.revision;
  states.composition = header.composition;
  states.origin_x = static_cast<std::int32_t>(first.x) / kQuantaPerMetre;
  states.origin_y = static_cast<std::int32_t>(first.y) / kQuantaPerMetre;
  states.id.clear();
  states.epoch.clear();
  states.flags.clear();
  for (auto* all : {&states.x, &states.y, &states.angle, &states.vx, &states.vy, &states.spin}) {
    all->clear();
  }
  return &states;
}

Reset StatesUnpacker::Refusal(const PackedStates& packed) {
  BitReader bits(ByteView(packed.data));
  return {static_cast<std::int16_t>(static_cast<std::uint16_t>(bits.Get(16)))};
}

const std::vector<States>* StatesUnpacker::Take(const PackedStates& packed, std::int32_t ids) {
  ids_ = std::min(ids, kIdsMax);
  BitReader bits(ByteView(packed.data));
  const auto low = static_cast<std::uint16_t>(newest_);
  const auto wire = static_cast<std::uint16_t>(bits.Get(16));
  const std::int64_t number =
      newest_ + static_cast<std::int16_t>(static_cast<std::uint16_t>(wire - low));
  States header;
  header.revision = static_cast<std::int32_t>(bits.GetGolomb(4));
  const std::uint64_t high = bits.Get(32);
  header.composition = static_cast<std::int64_t>(high << 32 | bits.Get(32));
  context_ = PackedContext();
  const std::int64_t tick_high = bits.Get(20);
  context_.tick = tick_high << 20 | bits.Get(20);
  std::move(told_.begin(), told_.end(), std::back_inserter(spare_));
  told_.clear();
  entries_.clear();
  while (bits.Get(1) != 0) {
    header.peer = static_cast<std::int32_t>(bits.GetGolomb(4));
    context_.tick += UnZigZag(bits.GetGolomb(0));
    header.tick = context_.tick;
    context_.id = -1;
    context_.id_gap = 0;
    States* states = nullptr;
    while (bits.Get(1) != 0) {
      Entry entry;
      if (!TakeBody(&bits, number, &entry)) return nullptr;
      if (states == nullptr || !Fits(*states, entry.state)) states = Begin(header, entry.state);
      AppendBody(entry.state, states);
      entries_.push_back(entry);
    }
    if (states == nullptr || !bits.ok()) return nullptr;
  }
  const auto valid = [](const States& states) { return Valid(states); };
  if (!bits.AtEnd() || told_.empty() || !std::all_of(told_.begin(), told_.end(), valid)) {
    return nullptr;
  }
  newest_ = std::max(newest_, number);
  for (const Entry& entry : entries_) Keep(number, entry);
  return &told_;
}

}  // namespace seam
