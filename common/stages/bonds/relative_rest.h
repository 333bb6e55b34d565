#pragma once
/// How much bodies that are near each other move against each other, and for how long they have
/// not: at rest is meant against each other, wherever both of them may be going.

#include <box2d/box2d.h>

#include <vector>

#include "common/physics/stage.h"

namespace seam {

/// Two bodies at the point where they touch, or where their boxes overlap most.
struct RelativeMotion {
  float speed = 0;  ///< m/s
  float spin = 0;   ///< rad/s
};

RelativeMotion MotionAt(const StageWorld& world, b2Contact* contact);

/// Two parts of different bodies whose boxes meet.
struct NearPair {
  PartId a = 0, b = 0;  ///< a < b
  int body_a = 0, body_b = 0;
  bool still = false;     ///< they rest against each other
  bool touching = false;  ///< with contact points
  int ticks = 0;          ///< for how long they have rested, at most the limit
};

/// Ticks of rest by pair of parts. What a pair has is kept as long as its boxes meet.
class RestPairs {
 public:
  /// Takes the pairs of this tick in any order; the same pair may be there several times, and rests
  /// only if each of them does. Counts them on, up to `limit` ticks.
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
