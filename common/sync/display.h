#pragma once
/// Determines the poses that a peer displays. Moves the bodies that it does not simulate along the
/// states received, and hides corrections of those that it does simulate.

#include <cstdint>
#include <functional>
#include <utility>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/reach/activities.h"
#include "common/sync/reach/zones.h"
#include "common/sync/roles.h"
#include "common/sync/show/delayed_path.h"
#include "common/sync/show/joint_closer.h"
#include "common/sync/show/reckoner.h"
#include "common/sync/show/seat_glide.h"
#include "common/sync/show/show_age.h"
#include "common/sync/smoother.h"
#include "common/sync/snapshots.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

class Display {
 public:
  /// All must outlive this.
  Display(const SyncConfig& config, World& world, BodyMemory& memory, Activities& activities);

  /// Call before the step to `next`. Gives each displayed body the pose and velocity that take it
  /// to its displayed place at `next`. Unless the config shows distant bodies (shows_far), bodies
  /// outside `seen` stay where they are, parked.
  void Drive(std::int64_t next, const MovingBox& seen);
  /// True if the peer displays others' bodies as they were some ticks ago.
  bool ShowsPast(const Roles& roles) const;
  /// Call after a step. Lets the visual offsets return by one tick. `missing` is
  /// used if ShowsPast.
  void Glide(const Roles& roles, const MissingInputs& missing);
  /// Notes that a player's input of so many ticks ago has come, and differs from the assumed one.
  void NoteLate(int player, std::int64_t ticks) { ages_.NoteLate(player, ticks); }

  /// Reports that the simulated state of `body` changed by this much; the view stays where it was.
  void Moved(int body, const BodyState& by);
  /// Reports that a replay has put `body` elsewhere by this much at the world's tick. A body that
  /// is shown in the past comes to that tick later; its view glides then.
  void MovedInPast(int body, const BodyState& by);
  /// Call when a replay begins after `tick`: forgets what earlier ones reported of later ticks.
  void ReplayedFrom(std::int64_t tick);
  /// Calls `call(body, by)` for each correction: a Moved by more than the wire's rounding.
  void OnCorrected(std::function<void(int, const BodyState&)> call) {
    on_corrected_ = std::move(call);
  }
  /// Shows the body at its new place at once.
  void Reset(int body);
  /// Closes joints of mechanisms, for the world's current bodies.
  const JointCloser& joints() const { return joints_; }
  /// Records that a state was this many ticks old on arrival.
  void AddAge(std::int64_t age_ticks) { delayed_.AddAge(age_ticks); }
  /// Returns the displayed bodies with joints closed: all of them, or those that the peer
  /// simulates. utime is left 0.
  View MakeView(const Roles& roles, bool all) const;

 private:
  /// A move of a body by other than physics, in the step to a tick.
  struct PastMove {
    std::int64_t tick = 0;
    BodyState by;
  };
  /// The past moment at which a body is displayed.
  struct Shown {
    bool past = false;         // false: it is displayed in the present
    double moment = 0;         // tick, never runs backwards
    std::int64_t since = -1;   // tick from which the body's past is known
    BodyState then;            // its state at that moment, as known when displayed
    std::int64_t edited = -1;  // tick in which an edit moved it that is not displayed yet
    BodyState jump;            // by that edit
    std::vector<PastMove> moves;  // by corrections, not displayed yet; ascending
  };
  void Edited(const BodyRemap& change);
  /// Returns the state that is displayed of a body but for its visual offset: now, or in the past.
  BodyState Base(int body) const;
  BodyState PastAt(const Roles& roles, int body, double moment) const;
  float FastestPoint(int mechanism) const;
  void ShowPast(const Roles& roles, int body, double due);
  void HidePastMoves(int body);
  void ShowPresent(int body);
  void ShowAllPresent();
  void ShowOthers(const Roles& roles, const MissingInputs& missing);
  bool IsDelayed(const Roles& roles, int body) const;
  BodyState Visible(int body, BodyState jump) const;
  BodyState Along(int body, const BodyState& here, const PathSpeed& speed, const BodyState& state);
  void KeepClosed(const Roles& roles);
  /// True if a simulated mechanism may be displayed differently from its simulated poses.
  bool IsOff(int mechanism) const;
  /// Returns the displayed poses of all bodies, or of mechanisms that the peer simulates;
  /// velocities are the simulated ones.
  const BodyColumn<BodyState>& ShownPoses(const Roles& roles, bool all) const;
  /// Returns the age of the mechanism's displayed poses, ticks.
  double AgeOf(const Roles& roles, int body) const;
  /// Calls `visit(body)` for each body that ShownPoses covers, ascending.
  template <class Visit>
  void EachShown(const Roles& roles, bool all, const Visit& visit) const;
  MovingBox FarBox(int mechanism) const;
  void CheckParked(std::int64_t next, const MovingBox& seen);
  void CheckParkedMechanism(int mechanism, const MovingBox& seen);
  void Leave(int body);

  const SyncConfig& config_;
  World& world_;
  BodyMemory& memory_;
  Activities& activities_;
  const Snapshots& snapshots_;
  Smoother smoother_;
  JointCloser joints_;
  Reckoner reckoner_;
  DelayedPath delayed_;
  SeatGlide seats_;
  ShowAge ages_;
  std::vector<ShownMechanism> shown_mechanisms_;  // memory for ShowOthers, rebuilt each tick
  BodyColumn<Shown> shown_;
  bool any_moves_ = false;  // shown_ may have some
  bool any_past_ = false;   // some may be displayed in the past
  std::function<void(int, const BodyState&)> on_corrected_ = [](int, const BodyState&) {};
  std::int64_t glides_ = 0;                        // number of Glide calls
  MechanismColumn<std::int64_t> corrected_until_;  // in glides: joints may be torn until then
  MechanismColumn<MovingBox> far_;                 // where a parked one may have moved to
  std::vector<int> driven_, leaving_, back_;       // bodies, in this Drive
  mutable BodyColumn<BodyState> poses_;            // memory for ShownPoses
  EditHook edited_;
};

}  // namespace seam
