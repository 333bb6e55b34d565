#pragma once
/// Paths of bodies that are shown in the past, between received states (modes strict and central).

#include <algorithm>
#include <cstdint>

#include "common/physics/world.h"
#include "common/sync/show/path_speed.h"
#include "common/sync/show/recent_ages.h"
#include "common/sync/snapshots.h"

namespace seam {

/// Display delay for which the state after the displayed moment has nearly always arrived, although
/// one in between may be lost: the age that 19 of 20 states stay below, plus two intervals. Changes
/// slowly, because a jump of it is a stutter.
class DisplayDelay {
 public:
  explicit DisplayDelay(int interval_ticks) : interval_ticks_(interval_ticks) {}
  /// Records that a state was `age_ticks` old on arrival.
  void AddAge(std::int64_t age_ticks) { ages_.Add(age_ticks); }
  /// Call once a tick. Returns the delay in ticks.
  double Advance();
  double ticks() const { return delay_; }  ///< -1: not known yet

 private:
  int interval_ticks_;
  RecentAges ages_;
  double delay_ = -1;
};

/// Shows a body as it was DisplayDelay ago: between two states, or beyond the newest by dead
/// reckoning. The sender assumes the same (NewestStates): it leaves out states that dead reckoning
/// gives, so the newest one may be half a second old.
class DelayedPath {
 public:
  /// Both must outlive this.
  DelayedPath(const World& world, const Snapshots& snapshots, int interval_ticks)
      : world_(world), snapshots_(snapshots), delay_(interval_ticks) {}

  /// Records that a state was `age_ticks` old on arrival.
  void AddAge(std::int64_t age_ticks) { delay_.AddAge(age_ticks); }
  /// Starts a new tick. Call once a tick.
  void Begin(std::int64_t next);
  /// Returns the age of the displayed moment, ticks; 0 before the delay is known.
  double age() const { return std::max(0.0, delay_.ticks()); }
  /// Returns the body's displayed state at the tick before `next`. Requires Begin, and a state
  /// heard of the body.
  BodyState Here(int body) const { return At(body, here_); }
  /// Returns the velocity to its place at `next`; for a body that is not present, in kShownEvery
  /// ticks.
  PathSpeed Speed(int body) const;
  /// Returns the body's state at a moment, ticks: between two states, or beyond the newest by dead
  /// reckoning. Requires a state heard of the body.
  BodyState At(int body, double tick) const;

 private:
  const World& world_;
  const Snapshots& snapshots_;
  DisplayDelay delay_;
  double here_ = 0, there_ = 0;  // displayed moments of the ticks before `next` and `next`
};

}  // namespace seam
