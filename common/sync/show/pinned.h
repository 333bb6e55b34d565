#pragma once
/// Two bodies and a pin between them: the gap, and the smallest move that closes it.

#include "common/physics/pin.h"

namespace seam {

/// A body that its pins move; an anchored one has no inverse mass.
struct PinnedBody {
  Vec2 centre{0, 0};  ///< m, of the centre of mass
  float angle = 0;    ///< rad
  float inverse_mass = 0, inverse_inertia = 0;
  Vec2 local{0, 0};  ///< m, the centre of mass in the body's frame
  bool moved = false;

  PinnedBody(const BodyState& pose, const MassPoint& mass);
  Vec2 ToWorld(const Vec2& point) const;
  /// Gives a movable body unit mass and makes it harder to turn.
  void MakeAlike();
  /// Applies an impulse to the pose instead of the velocities.
  void Push(const Vec2& at, const Vec2& impulse);
};

/// Gap that may stay open: any value between zero and this, m (in the frame of the axis) and rad.
struct PinLeft {
  Vec2 excess{0, 0};
  float turn = 0;
};

/// The gap of a pin, from the current poses of its two bodies.
struct PinGap {
  Vec2 at_a{0, 0}, at_b{0, 0};  ///< m, the two points in the world
  Vec2 axis{1, 0};              ///< unit, in the world; from point to point if by distance
  float along = 0;              ///< m, from a's point to b's
  Vec2 excess{0, 0};            ///< m beyond the limits: along the axis, across it
  float turn = 0;               ///< rad beyond the limits
};
PinGap GapOf(const Pin& pin, const PinnedBody& a, const PinnedBody& b);

/// Returns the pin with the ranges of its springs narrowed to the reach of its bodies from here,
/// without damping: their distance from rest, plus their speed there / swing. `a_moves`, `b_moves`:
/// the velocities of their centres of mass.
Pin Within(Pin pin, const PinnedBody& a, const BodyState& a_moves, const PinnedBody& b,
           const BodyState& b_moves);

/// Moves both bodies, weighted by mass, as little as closes the pin except for `left`. Returns
/// false if it is closed to 0.1 mm and 0.1 mrad, or if neither body can move.
bool ClosePin(const Pin& pin, const PinLeft& left, PinnedBody* a, PinnedBody* b);

}  // namespace seam
