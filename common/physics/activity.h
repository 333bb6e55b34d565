#pragma once
/// The activity of a body at a peer: how it moves, and whether it is in the Box2D world.

namespace seam {

/// Decided by the replica's `Activities` alone. `World` translates it for Box2D and keeps it
/// through rebuilds, restores and edits, so it is no column of a table; everything else reads it
/// (World::activity).
enum class Activity {
  kSimulated,   ///< in the Box2D world; moved by contacts and joints
  kPrescribed,  ///< there, but put back on a given path after each step; hits with its real mass
  kKinematic,   ///< there, on a given path, unaffected by contacts; hits with infinite mass
  kDisplayed,   ///< not there: on a given path, touches nothing
  kParked,      ///< not there: out of every view, in one pose, skipped by per-tick loops
  kDormant,     ///< not there: this peer's own, asleep where nothing can reach it
};

/// True if the body is in the Box2D world; a step skips all other bodies.
constexpr bool IsPresent(Activity activity) {
  return activity == Activity::kSimulated || activity == Activity::kPrescribed ||
         activity == Activity::kKinematic;
}

}  // namespace seam
