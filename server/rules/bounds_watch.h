#pragma once
/// Removes mechanisms that leave the bounds of the scene, by edits. The server alone decides: for a
/// client's mechanism by the client's states, for all others by its own world.

#include <cstdint>
#include <map>
#include <vector>

#include "common/sync/replica.h"
#include "common/topology/edit.h"

namespace seam {

/// True if a point is beyond one of the scene's bounds. NaN is not.
bool OutsideBounds(const Scene& scene, const Vec2& position);

class BoundsWatch {
 public:
  /// `replica`, the server's, must outlive it.
  explicit BoundsWatch(const Replica& replica) : replica_(replica) {}

  /// Returns the removals of parts that are due now, at most kRemovalsMax. Call once after each
  /// tick. `told`: bodies outside the bounds by their authorities' states. Removals returned within
  /// the last kAgainSeconds may still be pending and are not repeated. In a large room, bodies
  /// outside the Box2D world are checked twice a second.
  std::vector<Edit> Next(const std::vector<int>& told);
  /// Call with each applied edit.
  void NoteApplied(const Edit& edit);
  /// Parts that have left since the start.
  std::int64_t left() const { return left_; }

  /// Most removals in one tick; the rest waits for the next.
  static constexpr std::size_t kRemovalsMax = 64;
  /// The EditLog has dropped a removal that was not ordered in this time, s.
  static constexpr int kAgainSeconds = 4;

 private:
  /// True if the server's own copy decides about a body.
  bool IsOurs(int body) const;

  const Replica& replica_;
  std::map<PartId, std::int64_t> asked_;  // by part: tick of its last removal
  std::int64_t left_ = 0;
};

}  // namespace seam
