#pragma once
/// In which seconds of a body a person would notice that its motion on a screen is wrong.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/measure/screen/age.h"

namespace seam {

/// The seconds of every peer's bodies: since the recording's first tick, of whole ticks.
class BodySeconds {
 public:
  BodySeconds(std::int64_t first_tick, int tick_hz) : first_(first_tick), hz_(tick_hz) {}
  void Move(int peer, PartId id, std::int64_t tick) { Insert(&moved_, peer, id, tick); }
  void Notice(int peer, PartId id, std::int64_t tick) { Insert(&noticed_, peer, id, tick); }
  /// Of the seconds in which the body moves, how many are noticed. nullopt: nothing moves.
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

/// What one peer shows of one body, with the oracle's path and the age at which that is shown.
struct ShownBody {
  const BodyPath& shown;
  const BodyPath& truth;
  const ViewAges& ages;
  double radius = 0;  ///< m
  double h = 0;       ///< s per tick

  /// From `from` to `to`, the age being that at `to`; nullopt where the oracle is not known, or its
  /// body is not the same.
  std::optional<Place3> TrueWay(std::int64_t from, std::int64_t to, std::int64_t aged) const;
};

/// noticed.cpp: ticks in which the body moves, on the screen or in the oracle.
std::vector<std::int64_t> MovingTicks(const ShownBody& body);
/// noticed_velocity.cpp: ticks to which the velocity has been wrong.
std::vector<std::int64_t> WrongVelocities(const ShownBody& body);
/// noticed_path.cpp: ticks to which the body stood still, while the oracle's moves.
std::vector<std::int64_t> Stops(const ShownBody& body);
/// noticed_path.cpp: ticks in which the path bends, while the oracle's does not.
std::vector<std::int64_t> Kinks(const ShownBody& body);
/// links.cpp: ticks in which a joint of a body is farther apart than the oracle's, by kStretch of
/// the link's length, in the clients' views that show all bodies.
void NoticeLinks(const Recording& recording, const Oracle& oracle, const RevisionHistory& revisions,
                 BodySeconds* seconds);

}  // namespace seam
