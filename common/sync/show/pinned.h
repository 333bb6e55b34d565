#pragma once
/// Two bodies and a pin between them: how far it is open, and the least move that closes it.

#include "common/physics/pin.h"

namespace seam {

/// A body that is moved to where its pins want it; what is anchored has no inverse mass.
struct PinnedBody {
  Vec2 centre{0, 0};  ///< m, of mass
  float angle = 0;    ///< rad
  float inverse_mass = 0, inverse_inertia = 0;
  Vec2 local{0, 0};  ///< m, the centre in the body's frame
  bool moved = false;

  PinnedBody(const BodyState& pose, const MassPoint& mass);
  Vec2 ToWorld(const Vec2& point) const;
  /// What can be moved has a mass like any other from now on, and is harder to turn.
  void MakeAlike();
  /// As an impulse acts on velocities, but at once and on the pose.
  void Push(const Vec2& at, const Vec2& impulse);
};

/// A gap that may stay: any between this and none, m (in the frame of the axis) and rad.
struct PinLeft {
  Vec2 excess{0, 0};
  float turn = 0;
};

/// A pin's two bodies as they are.
struct PinGap {
  Vec2 at_a{0, 0}, at_b{0, 0};  ///< m, the two points in the world
  Vec2 axis{1, 0};              ///< unit, in the world; from point to point if by distance
  float along = 0;              ///< m, of b's point from a's
  Vec2 excess{0, 0};            ///< m beyond the limits: along the axis, across it
  float turn = 0;               ///< rad beyond the limits
};
PinGap GapOf(const Pin& pin, const PinnedBody& a, const PinnedBody& b);

/// The pin with the ranges of its springs narrowed to what its bodies reach from here, without
/// damping: as far from rest as they are, and their speed there / swing. `a_moves`, `b_moves`: the
/// velocities of their centres of mass.
Pin Within(Pin pin, const PinnedBody& a, const BodyState& a_moves, const PinnedBody& b,
           const BodyState& b_moves);

/// Moves both by as little, weighed by mass, as closes the pin but for what may stay. False: it is
/// closed, to 0.1 mm and 0.1 mrad, or nothing can be moved.
bool ClosePin(const Pin& pin, const PinLeft& left, PinnedBody* a, PinnedBody* b);

}  // namespace seam
