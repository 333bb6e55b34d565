#pragma once
/// How much bodies that are near each other move against each other, and for how long they have
/// not: at rest is meant against each other, wherever both of them may be going.

#include <box2d/box2d.h>

#include <vector>

#include "common/physics/stage.h"

namespace seam {

/// Of two bodies, at the middle of where their boxes overlap.
struct RelativeMotion {
  float speed = 0;  ///< m/s
  float spin = 0;   ///< rad/s
};

RelativeMotion MotionAt(const StageWorld& world, b2Contact* contact);

/// Whether they overlap more than the engine leaves bodies that rest on each other.
bool IsPressed(b2Contact* contact);

/// What is between their shapes, rims included, m; 0 where they touch. Boxes around what lies at an
/// angle meet far from it.
float GapOf(b2Contact* contact);

/// Two parts of different bodies whose boxes meet.
struct NearPair {
  PartId a = 0, b = 0;  ///< a < b
  int body_a = 0, body_b = 0;
  bool still = false;     ///< they rest against each other
  bool touching = false;  ///< with contact points
  int looks = 0;          ///< at how many looks in a row they have rested, at most the limit
};

/// Looks at which pairs of parts rested. What a pair has is kept as long as its boxes meet.
class RestPairs {
 public:
  /// Takes the pairs of a look in any order; the same pair may be there several times, and rests
  /// only if each of them does. Counts them on, up to `limit`.
  void Count(std::vector<NearPair> now, int limit);
  /// Those of the last Count, ascending by parts, each once.
  const std::vector<NearPair>& pairs() const { return pairs_; }
  /// Pairs of the part begin anew.
  void Forget(PartId part);

  void Save(std::vector<float>* memory) const;
  /// Returns how many numbers it took.
  std::size_t Load(const float* memory);

 private:
  std::vector<NearPair> pairs_;
};

}  // namespace seam
