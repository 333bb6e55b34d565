#pragma once
/// Keeps bodies awake that are slow but would not stay where they are. The engine lets an island
/// sleep when all its bodies have been slow for b2_timeToSleep; this class restarts that time for a
/// body that goes on:
///
///   held by nothing   goes on while it moves: no joint, no pressed contact, no water
///   resting           goes on while it becomes faster: a chain of pressed contacts leads to
///                     something that is not dynamic. Steady creep is the solver's error there
///   held otherwise    goes on while it becomes faster, or slows down so little that it has more
///                     than the engine's own slop (0.01 m/s or 2 degrees/s for 0.5 s) before it,
///                     or slows down as if to turn: its acceleration alone would move it by that
///                     slop within 4 s. The last 0.125 s before it stops do not count, so that what
///                     a damper stops as soon as that sleeps
///
/// The way left is v / (-dv/dt / v), as if the speed went on to fall at its present relative rate.
/// A fall and the rise after it count as one, a rise and the fall after it do not: what trembles
/// faster than 1.3 times in a second sleeps. A steady speed is neither: in a body that a belt or a
/// motor drives, rounding makes it rise and fall in its last digits.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"
#include "common/physics/world_build.h"

namespace seam {

class SlowWatch {
 public:
  /// Begins anew for so many moving bodies.
  void Reset(std::size_t bodies);

  /// Call before and after one of the engine's steps of `h` s. `present`: bodies to watch, if they
  /// are dynamic.
  void Before(const std::vector<int>& present, const BuiltScene& built);
  void After(const std::vector<int>& present, const std::vector<Activity>& activities,
             const BuiltScene& built, float h);

  /// Time for which the body has gone on, s, negative while it slows down. Part of the world's
  /// state.
  float going_s(int body) const { return going_s_[static_cast<std::size_t>(body)]; }
  void Restore(int body, float going_s) { going_s_[static_cast<std::size_t>(body)] = going_s; }

 private:
  struct Motion {
    float speed = 0;  // SpeedOf
    b2Vec2 velocity{0, 0};
    float spin = 0;
  };
  bool GoesOn(b2Body* body, float before, float h);
  bool Rests(b2Body* body);

  std::vector<float> going_s_;       // by moving body
  std::vector<Motion> before_;       // by moving body: before the step
  std::vector<std::int64_t> found_;  // by moving body: steps_, negative if it does not rest
  std::vector<b2Body*> chain_;       // scratch
  std::int64_t steps_ = 0;           // number of After
};

}  // namespace seam
