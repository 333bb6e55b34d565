#pragma once
/// How each stage is made, and what tells whether a scene needs it. MakeStages (stages.cpp) has one
/// line for each.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

/// Gives the contacts of parts with a conveyor their tangent speed: friction does the rest, and is
/// the most that a belt can pull with.
std::unique_ptr<Stage> MakeConveyorStage(const StageWorld& world);

/// Pushes bodies before each of the engine's steps. What sleeps is woken when a player's command
/// changes, and by nothing else.
std::unique_ptr<Stage> MakeThrustStage(const StageWorld& world);

/// Bodies of water: sensors in the contact pipeline say which bodies they hold.
std::unique_ptr<Stage> MakeWaterStage(const StageWorld& world);

/// Turns propellers: each is pushed by the water that its blades meet, and by nothing else. What
/// sleeps is woken when a player's command changes.
std::unique_ptr<Stage> MakePropellerStage(const StageWorld& world);

/// Whether anything in the scene can break.
bool HasBreakableGlue(const Scene& scene);

/// Forces are means over a tick: a blow of J N s counts as J times the scene's ticks per second.
/// What acts on a part: contacts and joints. Whatever else moves the body (gravity, water, thrust)
/// is taken to act on all of it alike, by mass, and so strains nothing; but gravity on what is
/// anchored does. A body that could not break by the sum of all that acts costs next to nothing.
std::unique_ptr<Stage> MakeGlueStage(const StageWorld& world);

/// Finds connectors that meet.
std::unique_ptr<Stage> MakeJoinStage(const StageWorld& world);

/// Whether a bond may be one that resting parts make: of single bodies that no joint holds.
bool MayGroup(const Scene& scene, const Composition& composition, const BondEdit& bond);

/// Grouped: single bodies (no joint holds them) that touch and have moved against each other by
/// less than kRestSpeed and kRestSpin for the scene's time, wherever both are going. Undone: when
/// the group is shaken (Grouping), or the engine's box around what moves against it by twice as
/// much comes to its own, which is before the blow: otherwise the blow would meet one body of all
/// their mass.
std::unique_ptr<Stage> MakeGroupStage(const StageWorld& world);

/// m/s and rad/s: below, things rest against each other. The engine's own limits for sleep are 0.01
/// and 0.035.
constexpr float kRestSpeed = 0.05f, kRestSpin = 0.05f;

/// Gives bricks fixtures where something moves, and takes them away again.
/// Requires world.scene.bricks. Which cells have fixtures is a function of where the bodies are and
/// were since the world was last built; nothing that touches or could touch within a tick is ever
/// missing.
std::unique_ptr<Stage> MakeFeatherStage(const StageWorld& world);

/// Whether any of the scene's characters is active; MakeCharacterStage requires one.
bool HasActiveCharacter(const Scene& scene);
std::unique_ptr<Stage> MakeCharacterStage(const StageWorld& world);

/// Draws whoever takes a seat to it, rigidly with all limbs, from the SeatEdit on, by a pull of at
/// most kSeatPull (seat_pull.h). After SeatTicks ticks the player's part is in its place there, if
/// the pull was enough; it is held until a bond joins the two.
std::unique_ptr<Stage> MakeSeatStage(const StageWorld& world);

/// Draws whoever leaves a seat out of it: from the breaking of the bond on, upwards from the seat
/// at kLeaveSpeed and by the same pull, through the vehicle and no longer than it is in it. The
/// seat feels the reaction.
std::unique_ptr<Stage> MakeSeatLeaveStage(const StageWorld& world);

/// m/s. And after so long, s, it is let go wherever it is.
constexpr float kLeaveSpeed = 2;
constexpr double kLeaveSeconds = 0.8;

/// How long the way to a seat takes, s: shorter looks like a jump, and longer like flying. And how
/// long after the SeatEdit it begins: less than the edit is under way to a peer, and the view of
/// that peer has to catch up.
constexpr double kSeatSeconds = 0.5, kSeatWaitSeconds = 0.13;
/// In ticks, until it begins and until it is over.
constexpr int SeatWaitTicks(int tick_hz) {
  return static_cast<int>(kSeatWaitSeconds * tick_hz + 0.5);
}
constexpr int SeatTicks(int tick_hz) {
  return SeatWaitTicks(tick_hz) + static_cast<int>(kSeatSeconds * tick_hz + 0.5);
}

}  // namespace seam
