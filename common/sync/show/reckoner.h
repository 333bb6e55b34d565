#pragma once
/// Dead reckoning of displayed bodies: single ones, and mechanisms, which move on as a whole.

#include <cstdint>
#include <vector>

#include "common/sync/show/joint_closer.h"
#include "common/sync/show/path_speed.h"
#include "common/sync/snapshots.h"

namespace seam {

/// Extrapolates mechanisms and free bodies. A mechanism's centre of mass keeps its momentum, and
/// its bodies turn about it with their angular momentum (of their centres). Each body also turns
/// with its own spin and drifts with the rest of its velocity. Then joints are closed, so wheels go
/// on turning and limbs go on swinging. A jointless body in free fall moves by gravity and bounces
/// off anchored shapes.
class Reckoner {
 public:
  /// All must outlive this.
  Reckoner(const World& world, const Snapshots& snapshots, const JointCloser& joints);
  ~Reckoner();

  /// Starts a new tick: paths are recomputed when asked for. Call after each tick, and when states
  /// have come or bodies have changed.
  void Begin(std::int64_t next);
  /// Return the body's pose at the tick before `next`, and at `next`. Angles continue from the
  /// newest snapshot's. Require Begin, and a state heard of the body. Bodies of its mechanism
  /// without one stay where the world has them.
  const BodyState& Here(int body) { return Reckoned(body).here[static_cast<std::size_t>(body)]; }
  const BodyState& There(int body) { return Reckoned(body).there[static_cast<std::size_t>(body)]; }
  /// Returns the velocity from Here to There; for a falling body that is not present, the velocity
  /// to its place in kShownEvery ticks. Torn joints can often be closed in two ways. If Here and
  /// There are closed differently, the difference is no motion, and the speeds are those before
  /// closing.
  const PathSpeed& Speed(int body) { return Reckoned(body).speed[static_cast<std::size_t>(body)]; }

 private:
  /// By body; those of bodies that are not done_ are old.
  struct Paths {
    std::vector<BodyState> heard;  // of jointed mechanisms
    std::vector<BodyState> here, there;
    std::vector<PathSpeed> speed;
  };
  struct Heard;
  struct Common;
  static Common CommonOf(const std::vector<Heard>& heard, const Snapshots& snapshots, float dt);
  const Paths& Reckoned(int body);
  void Reckon(int mechanism);
  void Fly(int body);
  const BodyState& FlownTo(int body, std::int64_t tick);
  PathSpeed SpeedOf(int body) const;
  void CloseJoints(int mechanism);
  bool IsMotion(int mechanism) const;
  void MoveOn(const Common& common, std::int64_t newest, std::int64_t tick,
              std::vector<BodyState>* states) const;

  const World& world_;
  const Snapshots& snapshots_;
  const JointCloser& joints_;
  std::int64_t next_ = 0;
  std::vector<bool> done_;  // rebuilt by Begin, by mechanism
  Paths paths_;
  /// Cached flight of a falling body since its newest state.
  struct Flown {
    std::int64_t heard = -1, at = -1;  // ticks
    Vec2 from{0, 0};                   // m, position in that state
    BodyState state;
  };
  std::vector<Flown> flown_;     // rebuilt for each revision, by body
  int revision_ = -1;            // world revision that flown_ belongs to
  std::vector<Heard> together_;  // bodies of the mechanism being extrapolated that move as one
  std::vector<PathSpeed> open_;  // speeds of its bodies before its joints were closed
};

}  // namespace seam
