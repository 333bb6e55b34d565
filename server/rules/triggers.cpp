#include "server/rules/triggers.h"

#include "common/base/state_archive.h"
#include "common/scene/part_rules.h"

namespace seam {
namespace {

/// A part inside leaves only when it is this far outside, m: more than two authorities differ at a
/// hand-over, so that a hand-over causes no second entry.
constexpr float kLeaveMargin = 0.05f;

/// True if the place is inside, borders included.
bool Within(const Vec2& place, const Vec2& centre, const Vec2& size, float margin) {
  return ((place - centre).array().abs() <= size.array() / 2 + margin).all();
}

}  // namespace

Triggers::Triggers(const FeatureList<Trigger>& triggers)
    : triggers_(triggers), over_(triggers.size(), false) {}

std::vector<TriggerEvent> Triggers::Update(const PlaceOf& place_of, const PlayerOf& player_of,
                                           const std::function<bool(PartId)>& doubted) {
  std::vector<TriggerEvent> events;
  for (std::size_t t = 0; t < triggers_.size(); ++t) {
    const Trigger& trigger = triggers_[t];
    const int index = static_cast<int>(t);
    Vec2 centre = trigger.position;
    if (trigger.part >= 0 && !over_[t]) {
      const std::optional<Vec2> carrier = place_of(trigger.part);
      if (carrier) centre += *carrier;
      over_[t] = !carrier;
    }
    for (const PartId part : trigger.parts) {
      const bool was = inside_.count({index, part}) != 0;
      if (over_[t] && !was) continue;
      const std::optional<Vec2> place = place_of(part);
      bool is = !over_[t] && place && Within(*place, centre, trigger.size, was ? kLeaveMargin : 0);
      const int player = is || was ? player_of(part) : -1;
      is = is && (was || Allows(trigger.players, player));
      is = is && (was || !doubted || !doubted(part));
      if (is == was) continue;
      events.push_back({index, part, player, is});
      if (!is) {
        inside_.erase({index, part});
        continue;
      }
      inside_.emplace(index, part);
      if (trigger.once) over_[t] = true;
    }
  }
  return events;
}

void Triggers::Persist(StateArchive& a, std::size_t parts) {
  for (std::size_t t = 0; t < over_.size(); ++t) {
    bool over = over_[t];
    a.Flag(&over);
    over_[t] = over;
  }
  const auto last = static_cast<std::int64_t>(over_.size()) - 1;
  a.Members(&inside_, over_.size() * parts, [&](std::pair<int, PartId>* inside) {
    a.Int(&inside->first, 0, last);
    a.Int(&inside->second, 0, static_cast<std::int64_t>(parts) - 1);
  });
}

}  // namespace seam
