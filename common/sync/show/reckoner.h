#pragma once
/// Dead reckoning of what is displayed: of single bodies, and of mechanisms, which move on as one.

#include <cstdint>
#include <vector>

#include "common/sync/show/joint_closer.h"
#include "common/sync/snapshots.h"

namespace seam {

/// What is only shown is reckoned no further than this, s. The server tells of it twice a second,
/// and again what was lost on the way: who hears nothing for longer has lost its connection for a
/// moment, and what stood still then would jump after it.
constexpr float kReckonShownMax = 2.0f;

/// Ticks from one look at the path of what is absent to the next: between them it goes straight on.
constexpr int kAbsentEvery = 6;

/// A body's motion along its path: of its origin, m/s, and rad/s.
struct PathSpeed {
  Vec2 velocity{0, 0};
  float spin = 0;
};

/// A mechanism's centre of mass goes on with its momentum, its bodies turn about that with its
/// angular momentum (that of their centres), each turns with its own spin and drifts with what is
/// left of its velocity; then its joints are closed. So wheels go on turning and limbs swinging.
/// A body without joints that falls freely goes on by gravity and bounces off what is anchored.
class Reckoner {
 public:
  /// All must outlive this.
  Reckoner(const World& world, const Snapshots& snapshots, const JointCloser& joints);
  ~Reckoner();

  /// From now on what is asked for is computed anew: a tick has passed, states have come or bodies
  /// have changed.
  void Begin(std::int64_t next);
  /// Where the body is at the tick before `next`, and at `next`. Angles go on from the newest
  /// snapshot's. Requires that it has been heard of, and Begin. Of a mechanism, what has not been
  /// heard of is where the world has it.
  const BodyState& Here(int body) { return Reckoned(body).here[static_cast<std::size_t>(body)]; }
  const BodyState& There(int body) { return Reckoned(body).there[static_cast<std::size_t>(body)]; }
  /// How it moves from Here to There, or if it falls and is absent, to where it is in kAbsentEvery
  /// ticks. Joints that are torn can often be closed in two ways: if one is found at Here and the
  /// other at There, what lies between is no motion, and the mechanism's bodies move as if nothing
  /// had been closed.
  const PathSpeed& Speed(int body) { return Reckoned(body).speed[static_cast<std::size_t>(body)]; }

 private:
  struct Paths {
    std::vector<BodyState> heard;        // by body; of jointed mechanisms
    std::vector<BodyState> here, there;  // by body
    std::vector<PathSpeed> speed;        // by body
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
  std::vector<bool> done_;  // by mechanism
  Paths paths_;
  /// Where the flight of what falls has come to since it was heard of.
  struct Flown {
    std::int64_t heard = -1, at = -1;  // ticks
    Vec2 from{0, 0};                   // m, when it was heard of
    BodyState state;
  };
  std::vector<Flown> flown_;     // by body
  int revision_ = -1;            // of the world, of which flown_ is
  std::vector<Heard> together_;  // bodies of the mechanism that is reckoned
  std::vector<PathSpeed> open_;  // of its bodies, before its joints were closed
};

}  // namespace seam
