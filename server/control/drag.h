#pragma once
/// A hand that drags a body: a damped spring from a point of it to a target, as pushes.

#include <cstdint>
#include <optional>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

/// Pushes a second. Each is an ordered edit that every peer gets: more cost bytes and replays, and
/// fewer let the body fall further between two (by 3 mm at 20).
constexpr int kDragPushHz = 20;
/// Frequency of the spring, Hz; its damping is critical. A stiffer one swings where the server's
/// copy of the body is old; in a softer one a body hangs lower (by 13 cm at 2 Hz).
constexpr float kDragHz = 2;
/// Greatest force for each kilogram, N: twenty times the body's weight.
constexpr float kDragForcePerKg = 200;

/// Least distance of a hand from the scene's bounds, m: a body that leaves them is removed.
constexpr float kDragMargin = 2;

struct Grip {
  PartId part = -1;
  Vec2 point{0, 0};   ///< m, in the part's frame
  Vec2 target{0, 0};  ///< m
};

/// Returns the push that brings the grip's point to its target within `seconds`, until the next
/// push; nullopt if the part is gone, anchored, or moved by the scene. The target is taken within
/// the scene's bounds, and so near that the spring stays below a quarter of its speed limit.
///
///     J = -(K + 1/(s(d + sk)))^-1 (v + x k/(d + sk)),   k = m w^2, d = 2 m w
///
/// for the point's stretch x and velocity v and its inverse mass K: an implicit step of s seconds
/// of the spring, which is stable however long that is (Catto, "Soft constraints", GDC 2011).
std::optional<PushEdit> DragPush(const World& world, const Grip& grip, float seconds);

}  // namespace seam
