#pragma once
/// Contents of the triggers of a scene: a function of the poses given, tick by tick.

#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/scene/feature.h"
#include "common/scene/part_rules.h"

namespace seam {

class StateArchive;

struct TriggerEvent {
  int trigger = -1;     ///< index into Scene::triggers
  PartId part = -1;     ///< the part inside
  int player = -1;      ///< owner of the part; -1: none
  bool entered = true;  ///< false: left
};

class Triggers {
 public:
  /// Returns the position of a part; nullopt if it is gone.
  using PlaceOf = std::function<std::optional<Vec2>(PartId)>;
  /// Returns the owner of a part; -1: none.
  using PlayerOf = std::function<int(PartId)>;

  explicit Triggers(const FeatureList<Trigger>& triggers);

  /// Returns the parts that entered and left in a tick, in the order of triggers, then of parts. A
  /// trigger that is over (`once` and entered, or its carrier is gone) reports that its parts
  /// leave, and then nothing more.
  /// A part that `doubted` returns true for enters nothing; empty: none is.
  std::vector<TriggerEvent> Update(const PlaceOf& place_of, const PlayerOf& player_of,
                                   const std::function<bool(PartId)>& doubted = {});

  void Persist(StateArchive& a, std::size_t parts);

  /// Pairs (trigger, part) that are inside now.
  const std::set<std::pair<int, PartId>>& inside() const { return inside_; }
  bool over(int trigger) const { return over_[static_cast<std::size_t>(trigger)]; }

 private:
  const FeatureList<Trigger> triggers_;
  std::vector<bool> over_;
  std::set<std::pair<int, PartId>> inside_;
};

}  // namespace seam
