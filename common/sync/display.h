#pragma once
/// What a peer shows. Bodies that it does not simulate are driven along what was heard of them;
/// corrections of those that it does are kept out of sight.

#include <cstdint>
#include <functional>
#include <utility>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/reach/zones.h"
#include "common/sync/roles.h"
#include "common/sync/show/joint_closer.h"
#include "common/sync/show/reckoner.h"
#include "common/sync/show/seat_glide.h"
#include "common/sync/smoother.h"
#include "common/sync/snapshots.h"

namespace seam {

class Display {
 public:
  /// Config, world and memory must outlive this.
  Display(const SyncConfig& config, World& world, BodyMemory& memory);

  /// Before the step to `next`: gives each body that is only displayed the pose and velocity that
  /// take it where it is to be shown then. Where nobody looks at what is far (SyncConfig), bodies
  /// outside `seen` are left where they are: parked (BodyMemory).
  void Drive(std::int64_t next, const MovingBox& seen);
  /// After a step: lets the visual offsets return for a tick.
  void Glide(const Roles& roles);

  /// The physics state of `body` was changed by this much; the view stays where it was.
  void Moved(int body, const BodyState& by);
  /// Calls `call(body)` whenever Moved is told of more than the wire's rounding: a correction.
  void OnCorrected(std::function<void(int)> call) { on_corrected_ = std::move(call); }
  /// The body was placed anew: it is shown there at once.
  void Reset(int body) { smoother_.Reset(body); }
  /// Closes mechanisms' joints, of the world's bodies as they are now.
  const JointCloser& joints() const { return joints_; }
  /// A state was this many ticks old when it was received.
  void AddAge(std::int64_t age_ticks) {
    if (config_.mode != Mode::kBuffer) delay_.AddAge(age_ticks);
  }
  /// The bodies have changed: visual offsets stay with what a body became.
  void Remap(const BodyRemap& change);

  /// Bodies as they are shown now, joints closed: all, or what the peer simulates. utime is left 0.
  View MakeView(const Roles& roles, bool all) const;

 private:
  BodyState Visible(int body, BodyState jump) const;
  BodyState AlongSnapshots(int body, const BodyState& target, BodyState state);
  BodyState AlongReckoned(int body, BodyState state);
  void KeepClosed(const Roles& roles);
  /// Whether a simulated mechanism may be shown other than physics made it.
  bool IsOff(int mechanism) const;
  /// Of all bodies, in the view, or of those of mechanisms that the peer simulates; velocities are
  /// those of physics.
  const std::vector<BodyState>& ShownPoses(const Roles& roles, bool all) const;
  /// Calls `visit(body)` for those that ShownPoses gives, ascending.
  template <class Visit>
  void EachShown(const Roles& roles, bool all, const Visit& visit) const;
  MovingBox FarBox(int mechanism) const;
  void LookAtParked(std::int64_t next, const MovingBox& seen);
  void LookAtParkedOne(int mechanism, const MovingBox& seen);
  void Leave(int body);

  const SyncConfig& config_;
  World& world_;
  BodyMemory& memory_;
  const Snapshots& snapshots_;
  Smoother smoother_;
  DisplayDelay delay_;
  JointCloser joints_;
  Reckoner reckoner_;
  SeatGlide seats_;
  std::function<void(int)> on_corrected_ = [](int) {};
  std::int64_t glides_ = 0;                    // calls of Glide
  std::vector<std::int64_t> corrected_until_;  // by mechanism: in glides, may be torn in physics
  std::vector<MovingBox> far_;  // by mechanism: of what is parked, where it can have come to
  std::vector<int> driven_, leaving_, back_;  // bodies, in this Drive
  mutable std::vector<BodyState> poses_;      // room for ShownPoses, by body
};

}  // namespace seam
