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

bool StatesUnpacker::TakeBody(RangeReader* bits, std::int64_t number, Entry* entry) {
  PackedContext& context = context_;
  const bool other_gap = context.id_gap == 0 || bits->Code(false, &context.other_gap);
  std::int64_t gap = context.id_gap;
  if (other_gap) {
    gap = std::int64_t{bits->Code(0, context.id < 0 ? &context.first_id : &context.gap)} + 1;
  }
  const std::int64_t id = context.id + gap;
  if (id >= ids_) return false;
  context.id_gap = context.id < 0 ? 1 : static_cast<std::int32_t>(gap);
  context.id = static_cast<std::int32_t>(id);
  if (bits->Code(false, &context.other_back)) context.back = bits->Code(0, &context.back_by);
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
  if (bits->Code(false, &context.other_owner)) {
    state.epoch = static_cast<std::int32_t>(bits->Code(0, &context.epoch));
    state.flags = static_cast<std::int8_t>(bits->Raw(0, kFlagBits));
  }
  const bool falls = from != nullptr && bits->Code(false, &context.falls);
  CodeFields(motion_, from, falls, &context, bits, &state);
  context.last = entry->state = state;
  ++context.entries;
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
  RangeReader bits(ByteView(packed.data));
  return {static_cast<std::int16_t>(static_cast<std::uint16_t>(bits.Raw(0, 16)))};
}

const std::vector<States>* StatesUnpacker::Take(const PackedStates& packed, std::int32_t ids) {
  ids_ = std::min(ids, kIdsMax);
  RangeReader bits(ByteView(packed.data));
  const auto low = static_cast<std::uint16_t>(newest_);
  const auto wire = static_cast<std::uint16_t>(bits.Raw(0, 16));
  PackedHeader common;
  common.number = newest_ + static_cast<std::int16_t>(static_cast<std::uint16_t>(wire - low));
  const std::int64_t number = common.number;
  context_ = FreshContext();
  const auto find = [&](std::int64_t of) -> const PackedHeader* {
    const PackedHeader& header = headers_[static_cast<std::size_t>(of) % headers_.size()];
    return of >= 0 && header.number == of ? &header : nullptr;
  };
  if (!CodeHeader(PackedHeader(), find, &context_, &bits, &common)) return nullptr;
  States header;
  header.revision = common.revision;
  header.composition = common.composition;
  context_.tick = common.tick;
  std::move(told_.begin(), told_.end(), std::back_inserter(spare_));
  told_.clear();
  entries_.clear();
  while (bits.Code(false, &context_.another_group)) {
    header.peer = static_cast<std::int32_t>(bits.Code(0, &context_.peer));
    context_.tick += UnZigZag(bits.Code(0, &context_.ticks));
    header.tick = context_.tick;
    context_.id = -1;
    context_.id_gap = 0;
    States* states = nullptr;
    while (bits.Code(false, &context_.another_body)) {
      Entry entry;
      if (!TakeBody(&bits, number, &entry)) return nullptr;
      if (states == nullptr || !Fits(*states, entry.state)) states = Begin(header, entry.state);
      AppendBody(entry.state, states);
      entries_.push_back(entry);
    }
    if (states == nullptr || !bits.ok()) return nullptr;
  }
  constexpr std::uint32_t kEntriesMask = (1u << kEntriesBits) - 1;
  if (bits.Raw(0, kEntriesBits) != (context_.entries & kEntriesMask)) return nullptr;
  const auto valid = [](const States& states) { return Valid(states); };
  if (!bits.AtEnd() || told_.empty() || !std::all_of(told_.begin(), told_.end(), valid)) {
    return nullptr;
  }
  newest_ = std::max(newest_, number);
  if (number >= 0) headers_[static_cast<std::size_t>(number) % headers_.size()] = common;
  for (const Entry& entry : entries_) Keep(number, entry);
  return &told_;
}

}  // namespace seam
