#include "common/record/tick_splitter.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace seam {

std::vector<AnyMessage> TickSplitter::Take(std::size_t count) {
  const auto end =
      messages_.begin() + static_cast<std::ptrdiff_t>(std::min(count, messages_.size()));
  std::vector<AnyMessage> taken(std::make_move_iterator(messages_.begin()),
                                std::make_move_iterator(end));
  messages_.erase(messages_.begin(), end);
  return taken;
}

std::vector<TickMessages> TickSplitter::End(const LogSeal& seal) {
  const std::vector<SealedTick> ticks = TicksOf(seal).value_or(std::vector<SealedTick>());
  if (seal.messages < 0) return {};
  const auto fresh = static_cast<std::int64_t>(messages_.size() - carried_);
  // Messages that this seal repeats from one that was kept.
  std::int64_t repeated = std::max<std::int64_t>(0, seal.messages - fresh);
  std::vector<TickMessages> all;
  for (const SealedTick& each : ticks) {
    std::int64_t before = each.before, after = each.after;
    const bool had = repeated > 0 && before + after <= repeated;
    for (std::int64_t* count : {&before, &after}) {
      const std::int64_t less = std::min(*count, repeated);
      *count -= less;
      repeated -= less;
    }
    if (had || each.tick <= last_tick_) continue;
    TickMessages tick;
    tick.tick = last_tick_ = each.tick;
    tick.hash = each.hash;
    tick.before = Take(std::exchange(carried_, 0) + static_cast<std::size_t>(before));
    tick.after = Take(static_cast<std::size_t>(after));
    all.push_back(std::move(tick));
  }
  carried_ = messages_.size();
  return all;
}

std::vector<AnyMessage> TickSplitter::begun() const {
  return {messages_.begin(), messages_.begin() + static_cast<std::ptrdiff_t>(carried_)};
}

}  // namespace seam
