#pragma once
/// Who is in which trigger of a scene. A function of the poses it is told, in the order of ticks.

#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/scene/feature.h"
#include "common/scene/part_rules.h"

namespace seam {

struct TriggerEvent {
  int trigger = -1;     ///< index into Scene::triggers
  PartId part = -1;     ///< who
  int player = -1;      ///< whose it is
  bool entered = true;  ///< else left
};

class Triggers {
 public:
  /// Where a part is; nullopt when it is gone.
  using PlaceOf = std::function<std::optional<Vec2>(PartId)>;
  /// Whose a part is; -1 nobody's.
  using PlayerOf = std::function<int(PartId)>;

  explicit Triggers(const FeatureList<Trigger>& triggers);

  /// After a tick: who entered and who left, in the order of triggers, then of parts. A trigger
  /// that is over (once, and entered; its part is gone) says that its parts left, then no more.
  std::vector<TriggerEvent> Update(const PlaceOf& place_of, const PlayerOf& player_of);

  /// Pairs (trigger, part) that are inside now.
  const std::set<std::pair<int, PartId>>& inside() const { return inside_; }
  bool over(int trigger) const { return over_[static_cast<std::size_t>(trigger)]; }

 private:
  const FeatureList<Trigger> triggers_;
  std::vector<bool> over_;
  std::set<std::pair<int, PartId>> inside_;
};

}  // namespace seam
