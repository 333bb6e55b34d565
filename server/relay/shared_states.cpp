#include "server/relay/shared_states.h"

#include <algorithm>
#include <utility>

#include "common/codec/codec.h"

namespace seam {

void SharedStates::Add(const States& states) {
  packer_.Add(states);
  const StatesHeader header = HeaderOf(states);
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const std::int32_t id = states.id[i];
    added_.push_back(id);
    if (newest_.size() <= static_cast<std::size_t>(id)) {
      newest_.resize(static_cast<std::size_t>(id) + 1);
    }
    Newest& newest = newest_[static_cast<std::size_t>(id)];
    newest.header = header;
    newest.body = BodyAt(states, i);
  }
}

std::vector<SharedStates::Message> SharedStates::Take(std::int64_t now_us) {
  return Finish(now_us, false);
}

std::vector<SharedStates::Message> SharedStates::Again(std::int64_t now_us,
                                                       const std::vector<std::int32_t>& ids) {
  for (const std::int32_t id : ids) {
    const Newest& newest = newest_[static_cast<std::size_t>(id)];
    packer_.Add(newest.header, &newest.body, &newest.body + 1);
    added_.push_back(id);
  }
  return Finish(now_us, true);
}

std::vector<SharedStates::Message> SharedStates::Finish(std::int64_t now_us, bool again) {
  std::vector<Message> messages;
  auto next = added_.begin();
  for (const StatesPacker::Message& packed : packer_.Take(now_us)) {
    messages.push_back({packed.number, Encode(packed.packed)});
    newest_number_ = packed.number;
    std::vector<Carried> carried;
    for (std::size_t i = 0; i < packed.bodies; ++i, ++next) {
      Newest& newest = newest_[static_cast<std::size_t>(*next)];
      if (!again) newest.first = packed.number;
      carried.push_back({*next, newest.first});
    }
    carried_.push_back(std::move(carried));
    if (carried_.size() > kMessagesMost) carried_.pop_front();
  }
  added_.clear();
  return messages;
}

void SharedStates::AddNewestIn(std::int64_t number, std::vector<std::int32_t>* ids) const {
  const std::int64_t age = newest_number_ - number;
  if (age < 0 || age >= static_cast<std::int64_t>(carried_.size())) return;
  for (const Carried& one : carried_[carried_.size() - 1 - static_cast<std::size_t>(age)]) {
    if (newest_[static_cast<std::size_t>(one.id)].first == one.first) ids->push_back(one.id);
  }
}

void SentStates::Acknowledge(std::int64_t number) {
  const auto found =
      std::lower_bound(sent_.begin(), sent_.end(), number,
                       [](const Sent& sent, std::int64_t n) { return sent.number < n; });
  if (found != sent_.end() && found->number == number) found->arrived = true;
}

std::vector<std::int32_t> SentStates::TakeLost(std::int64_t now_us, std::int64_t late_us,
                                               const SharedStates& states) {
  std::vector<std::int32_t> ids;
  for (; !sent_.empty(); sent_.pop_front()) {
    const Sent& first = sent_.front();
    if (first.arrived) continue;
    if (first.sent_us != kLost && now_us - first.sent_us < late_us) break;
    states.AddNewestIn(first.number, &ids);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace seam
