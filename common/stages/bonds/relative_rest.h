#pragma once
/// Relative motion of neighbouring bodies, and the time for which they have been at rest relative
/// to each other, however both may move.

#include <box2d/box2d.h>

#include <vector>

#include "common/physics/stage.h"

namespace seam {

/// Motion of two bodies against each other at the middle of the overlap of their boxes.
struct RelativeMotion {
  float speed = 0;  ///< m/s
  float spin = 0;   ///< rad/s
};

RelativeMotion MotionAt(const StageWorld& world, b2Contact* contact);

/// Returns true if the two overlap more than the engine leaves bodies that rest on each other.
bool IsInterpenetrating(b2Contact* contact);

/// Returns the gap between the shapes, rims included, m; 0 if they touch. Needed because the boxes
/// of rotated shapes meet while the shapes are still far apart.
float GapOf(b2Contact* contact);

/// Two parts of different bodies with overlapping boxes.
struct NearPair {
  PartId a = 0, b = 0;  ///< a < b
  int body_a = 0, body_b = 0;
  bool still = false;     ///< at rest relative to each other
  bool touching = false;  ///< with contact points
  int looks = 0;          ///< number of consecutive checks at rest, up to the limit
};

/// Counts the checks at which pairs of parts were at rest. A pair's count is kept while its boxes
/// overlap.
class RestPairs {
 public:
  /// Takes the pairs of one check in any order. A pair may occur several times, and is at rest only
  /// if each occurrence is. Counts up to `limit`.
  void Count(std::vector<NearPair> now, int limit);
  /// Pairs of the last Count, ascending by parts, each once.
  const std::vector<NearPair>& pairs() const { return pairs_; }
  /// Restarts the counts of the part's pairs.
  void Forget(PartId part);

  void Save(std::vector<float>* memory) const;
  /// Returns the number of values read.
  void Load(StageMemory* memory);

 private:
  std::vector<NearPair> pairs_;
};

}  // namespace seam
