#pragma once
/// Noticeable errors: the seconds in which a person would see that a body's motion is wrong.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/measure/screen/age.h"

namespace seam {

/// Sets of seconds by peer and body. Seconds begin at the recording's first tick.
class BodySeconds {
 public:
  BodySeconds(std::int64_t first_tick, int tick_hz) : first_(first_tick), hz_(tick_hz) {}
  void Move(int peer, PartId id, std::int64_t tick) { Insert(&moved_, peer, id, tick); }
  void Notice(int peer, PartId id, std::int64_t tick) { Insert(&noticed_, peer, id, tick); }
  /// Returns the noticed share of the seconds in which a body moves. nullopt: nothing moves.
  std::optional<double> Share() const;

 private:
  using Key = std::pair<std::pair<int, PartId>, std::int64_t>;
  void Insert(std::set<Key>* set, int peer, PartId id, std::int64_t tick) {
    set->insert(set->end(), {{peer, id}, (tick - first_) / hz_});
  }
  std::int64_t first_;
  int hz_;
  std::set<Key> moved_, noticed_;
};

/// One body's displayed path in one peer's views, with the oracle's path and the view's ages.
struct ShownBody {
  const BodyPath& shown;
  const BodyPath& truth;
  const ViewAges& ages;
  double radius = 0;  ///< m
  double h = 0;       ///< s per tick

  /// Returns the oracle's displacement from tick `from` to `to`, both shifted by the age at `aged`;
  /// nullopt where the oracle is not known, or its body is not the same.
  std::optional<Place3> TrueWay(std::int64_t from, std::int64_t to, std::int64_t aged) const;
};

/// noticed.cpp: returns the ticks in which the body moves, on the screen or in the oracle.
std::vector<std::int64_t> MovingTicks(const ShownBody& body);
/// noticed_velocity.cpp: returns the ticks at the end of a window with a wrong velocity.
std::vector<std::int64_t> WrongVelocities(const ShownBody& body);
/// noticed_path.cpp: returns the ticks in which the body has stood still for kStopLong or longer,
/// while the oracle's moves.
std::vector<std::int64_t> Stops(const ShownBody& body);
/// noticed_path.cpp: returns the ticks at which the path bends, while the oracle's does not.
std::vector<std::int64_t> Kinks(const ShownBody& body);
/// links.cpp: marks, in `seconds`, the ticks in which a joint of a body has drifted more than the
/// oracle's by kStretch of the link's length, in clients' views that show all bodies.
void NoticeLinks(const Recording& recording, const Oracle& oracle, const RevisionHistory& revisions,
                 BodySeconds* seconds);

}  // namespace seam
