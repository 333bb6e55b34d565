#pragma once
/// Decides how long ago others' bodies are displayed: a peer knows them exactly only as far as it
/// knows their players' inputs, while its own are displayed in the present. After Sharkey, Ryan and
/// Roberts, "A local perception filter for distributed virtual environments" (VRAIS 1998), where
/// the past is extrapolated; here it is simulated.
///
///     ann's, in the present            [ann]
///     bob's, where it was            [bob]  . . [bob now]     its past pose would lie in ann's:
///                                       [bob]                 so it is displayed less late

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/mode.h"
#include "common/sync/show/recent_ages.h"

namespace seam {

/// An age changes so slowly that nobody notices it (kVelocityShareLong, kVelocityFloor of the
/// measures): the body is displayed faster, or slower, by at most this share of its speed, or by
/// this speed, m/s, if that is more.
constexpr double kUnseenShare = 0.06, kUnseenSpeed = 0.05;

/// Players that are waited for, with the number of newest ticks for which nothing has come from
/// them.
using MissingInputs = std::vector<std::pair<int, std::int64_t>>;

/// The age at which inputs are known: a player that tells nothing has changed nothing, up to as
/// long ago as its changes take to come. Before one has come, the age is that at which inputs are
/// complete, and at first the greatest that is allowed: bodies wait for it once, and it need not
/// rise while they move.
class ShowAge {
 public:
  /// `config` must outlive this.
  explicit ShowAge(const SyncConfig& config) : config_(config) {}

  /// Notes that an input of a player has come that differs from the assumed one of these newest
  /// ticks.
  void NoteLate(int player, std::int64_t ticks);
  /// Call after a step.
  void Look(const MissingInputs& missing);
  /// Returns the age that displayed poses are to have, ticks.
  double due() const { return due_; }
  /// Returns the moment to display at tick `now` after `moment` at the tick before: as near to
  /// `due` ticks ago as nobody notices. `speed`: of the body's fastest point, m/s.
  static double Glide(double moment, double now, double due, double speed);

 private:
  const SyncConfig& config_;
  std::vector<RecentAges> late_;  // by player
  RecentAges unknown_;
  double due_ = 0;
};

/// A mechanism on the screen.
struct ShownMechanism {
  const std::vector<int>* bodies = nullptr;
  double moment = 0;  ///< the tick of its poses
};

/// Moves on the moments of mechanisms whose poses overlap those of a later moment, until they do
/// so by no more than a viewer would miss, or than now. Only mechanisms of a moment after `oldest`
/// push others. `pose_at`: returns a body's displayed pose at a moment.
void KeepApart(const World& world, double oldest,
               const std::function<BodyState(int body, double moment)>& pose_at,
               std::vector<ShownMechanism>* shown);

}  // namespace seam
