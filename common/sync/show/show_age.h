#pragma once
/// Decides how long ago each mechanism is displayed: a peer knows others' bodies exactly only as
/// far as it knows their players' inputs, while its own are displayed in the present. After
/// Sharkey, Ryan and Roberts, "A local perception filter for distributed virtual environments"
/// (VRAIS 1998), where the past is extrapolated; here it is simulated.
///
///      age
///       |         ________  the age at which inputs are complete, at most --show-age
///       |        /
///       |       /  kAgeFall ticks for each tick that is left before it may touch ...
///       |______/________________ time to contact
///      ... a mechanism of less age: at first one that the viewer drives, whose age is 0
///
/// What hardly moves may be older than what it touches: its past pose overlaps nothing.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/mode.h"
#include "common/sync/reach/zones.h"
#include "common/sync/roles.h"
#include "common/sync/show/recent_ages.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

/// Greatest rates at which an age falls and rises, ticks a tick: the body is displayed faster, or
/// slower, by that share.
constexpr float kAgeFall = 0.2f, kAgeRise = 0.2f;

class ShowAge {
 public:
  /// All must outlive this.
  ShowAge(const SyncConfig& config, const World& world, const BodyTable& table)
      : config_(config), world_(world), due_(table, MechanismRule::kFresh, 0) {}

  /// Call after a step. `missing`: the newest ticks for which an input or state is not known yet.
  void Look(const Roles& roles, std::int64_t missing);
  /// Returns the age that the mechanism's displayed poses are to have, ticks.
  double Due(int mechanism) const { return due_[mechanism]; }
  /// Returns the moment to display at tick `now` after `moment` at the tick before: as near to
  /// `due` ticks ago as the rates let it.
  static double Glide(double moment, double now, double due);

 private:
  /// Two mechanisms that may touch, and by how many ticks each may be older than the other.
  struct Meeting {
    int a = -1, b = -1;
    double b_older = 0, a_older = 0;
  };
  void FindMeetings(double ticks_max);

  const SyncConfig& config_;
  const World& world_;
  RecentAges missing_;
  MechanismColumn<double> due_;
  std::vector<MovingBox> boxes_;  // memory for FindMeetings, by mechanism
  std::vector<Meeting> meetings_;
};

}  // namespace seam
