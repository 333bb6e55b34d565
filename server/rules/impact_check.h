#pragma once
/// Plausibility of impacts, by the states that the authorities of all bodies reported.
///
///   a free body   dv    <=  (1 + e) max u_i            + slack    i: bodies of the touching island
///   a held body   dv m  <=  (1 + e) sum m_i u_i + weight          u_i: speed in the impact's frame
///
/// An impact may come through others: a car that strikes the first crate of a row throws the last.
/// So the momentum that entered the whole island explains it, not that of the two bodies alone.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/physics/world.h"
#include "common/stages/kinematic.h"
#include "server/rules/rule_source.h"
#include "server/rules/state_trail.h"

namespace seam {

/// Returns the distance from the root of an assembly to its farthest point, m.
float ExtentOf(const World& world, const Assembly& assembly);

/// Judges the impacts of one tick. What is known of the bodies must not change meanwhile.
class ImpactCheck {
 public:
  /// Both must outlive it.
  ImpactCheck(const World& world, const StateTrail& trail, std::int64_t tick)
      : world_(world), trail_(trail), tick_(tick) {}

  /// True if the known states explain the impact. The point must be at both bodies, and the
  /// velocity must not change by more than the momentum that entered the island explains. False
  /// also if nothing is known of one of the bodies yet.
  bool Possible(const Blow& blow);
  /// True if states of that time may still come for one of the bodies.
  bool MoreMayCome(const Blow& blow) const;

  /// Ticks around an impact whose states explain it: an authority sends one every second tick. A
  /// longer time could explain an impact by the speed before an earlier one.
  static constexpr std::int64_t kTicksAround = 4;

 private:
  using Trail = std::vector<StateTrail::Seen>;
  /// Motion of one body around the tick.
  struct Moved {
    bool known = false;            ///< a state around that tick is known
    std::vector<Vec2> velocities;  ///< m/s, as its places confirm them
    float spin = 0;                ///< rad/s, the fastest
  };

  Moved MotionOf(int body) const;
  bool IsNear(int body, const Vec2& point) const;
  bool Explained(const Blow& blow);
  /// Returns the greatest speed, in that frame, of parts on a path that meet the island, m/s.
  float FastestMover(const std::vector<int>& island, const std::vector<Vec2>& frame);
  /// True if the struck body could not give way: another body or an anchored part is behind it, or
  /// joints hold it.
  bool IsHeld(const Blow& blow, const std::vector<int>& island) const;
  /// Returns the bodies that touch this one in that tick, directly or through others, itself too.
  std::vector<int> IslandOf(int body);

  const World& world_;
  const StateTrail& trail_;
  const std::int64_t tick_;
  std::vector<int> island_;  // rebuilt by each check, by mechanism
  std::optional<ImposedMotions> movers_;
};

}  // namespace seam
