#pragma once
/// Factories of the stages, and tests for the need of each. MakeStages (stages.cpp) has one line
/// for each.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

/// Sets the tangent speed of the contacts of parts with a conveyor: friction does the rest and
/// limits the belt's pull.
std::unique_ptr<Stage> MakeConveyorStage(const StageWorld& world);

/// Applies thrusts before each of the engine's steps. Only a changed command of a player wakes a
/// sleeping body.
std::unique_ptr<Stage> MakeThrustStage(const StageWorld& world);

/// Simulates bodies of water: sensors in the contact pipeline report the bodies within.
std::unique_ptr<Stage> MakeWaterStage(const StageWorld& world);

/// Drives propellers: only the water that the blades meet pushes them. A changed command of a
/// player wakes a sleeping body.
std::unique_ptr<Stage> MakePropellerStage(const StageWorld& world);

/// Returns true if a load can break the joint.
bool IsBreakableGlue(const Joint& joint);

/// Breaks overloaded glue. Forces are means over a tick: an impulse of J N s counts as J times the
/// scene's ticks per second. Contacts and joints act on single parts. All other forces (gravity,
/// water, thrust) are taken to act on the whole body in proportion to mass, and so cause no strain;
/// but gravity on anchored parts does. A body that all forces together could not break costs next
/// to nothing.
std::unique_ptr<Stage> MakeGlueStage(const StageWorld& world);

/// Joins connectors that meet.
std::unique_ptr<Stage> MakeJoinStage(const StageWorld& world);

/// Returns true if a bond may be a group's: between single bodies that no joint holds.
bool MayGroup(const Scene& scene, const Composition& composition, const BondEdit& bond);

/// Groups single bodies (held by no joint) that touch and have moved relative to each other by less
/// than kRestSpeed and kRestSpin for the scene's time, however both move. A group is undone when it
/// is shaken (Grouping), or when the engine's box of a body with at least twice that relative
/// motion reaches the group's box. This happens before the impact; otherwise the impact would meet
/// one body of the whole mass.
std::unique_ptr<Stage> MakeGroupStage(const StageWorld& world);

/// m/s and rad/s: relative motion below these counts as rest. The engine's own limits for sleep are
/// 0.01 and 0.035.
constexpr float kRestSpeed = 0.05f, kRestSpin = 0.05f;

/// Creates the fixtures of bricks near moving bodies, and removes them again. Requires
/// world.scene.bricks. The set of cells with fixtures is a function of the bodies' positions since
/// the world was last built; a fixture that touches a body, or could within a tick, is never
/// missing.
std::unique_ptr<Stage> MakeFeatherStage(const StageWorld& world);

/// Returns true if any character of the scene is active; MakeCharacterStage requires one.
bool HasActiveCharacter(const Scene& scene);
std::unique_ptr<Stage> MakeCharacterStage(const StageWorld& world);
/// Numbers that the stages of seats save, for each seat of the scene.
constexpr std::size_t kNumbersOfSeat = 8 + 2;

/// Draws a player that takes a seat to it, rigidly with all limbs, from the SeatEdit on, by a pull
/// of at most kSeatPull (seat_pull.h). After SeatTicks ticks the player's part is in its place, if
/// the pull was enough; it is held until a bond joins the two.
std::unique_ptr<Stage> MakeSeatStage(const StageWorld& world);

/// Draws a player that leaves a seat out of it: from the breaking of the bond on, upwards from the
/// seat at kLeaveSpeed and by the same pull, through the vehicle and only while inside it. The seat
/// receives the reaction.
std::unique_ptr<Stage> MakeSeatLeaveStage(const StageWorld& world);

/// m/s. After kLeaveSeconds, s, the player is released in any case.
constexpr float kLeaveSpeed = 2;
constexpr double kLeaveSeconds = 0.8;

/// Duration of the way to a seat, s: shorter looks like a jump, longer like flying. And the delay
/// after the SeatEdit, s: if the edit takes longer to reach a peer, that peer's view has to catch
/// up.
constexpr double kSeatSeconds = 0.5, kSeatWaitSeconds = 0.13;
/// Return the ticks until the way begins, and until it ends.
constexpr int SeatWaitTicks(int tick_hz) {
  return static_cast<int>(kSeatWaitSeconds * tick_hz + 0.5);
}
constexpr int SeatTicks(int tick_hz) {
  return SeatWaitTicks(tick_hz) + static_cast<int>(kSeatSeconds * tick_hz + 0.5);
}

}  // namespace seam
