#pragma once
/// Interface of the modules that act on a world besides gravity, contacts and joints: water,
/// conveyors, thrust, characters, fixtures of featherweight parts. Made only for scenes that use
/// them.

#include <box2d/box2d.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "common/physics/world_build.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/scene/types.h"
#include "common/topology/edit.h"
#include "common/topology/topology.h"

namespace seam {

enum class Motion;  // world.h

/// The data that a stage works on. The references stay valid for the stage's life, but the objects
/// change: Barrier, Restore and changes of topology rebuild the bodies.
struct StageWorld {
  const Scene& scene;
  const Composition& composition;
  const BuiltScene& built;
  const std::int64_t& tick;            ///< ticks stepped so far
  const std::vector<Motion>& motions;  ///< by moving body
  const Topology& topology;
};

/// Deterministic: a function of the scene, the calls and the saved memory. In each tick:
///
///   BeforeTick,  then per substep: BeforeStep, the engine's step (contacts),  then AfterTick
///
/// No hidden forces: a body is moved only by a stage or by the engine.
class Stage {
 public:
  virtual ~Stage() = default;

  /// Called when the bodies, fixtures and joints in `world` are new (also once at the start): look
  /// them up again. May add fixtures, and bodies whose user data pointer is 0 (anchored); no
  /// joints.
  virtual void Rebuilt(b2World* world) = 0;
  /// Called after Rebuilt when the world goes back to a snapshot: the bodies are placed, velocities
  /// and memory follow. Contacts are found next: fixtures that bodies may touch must exist by then.
  virtual void Placed() {}
  /// Called before the world is emptied: drop all pointers into it.
  virtual void Emptied() {}
  /// Called when the tick jumps: a peer joined late, or went back.
  virtual void TickSet() {}
  /// Called once before each tick, even if no body is awake: choose motor speeds, stream fixtures.
  virtual void BeforeTick() {}
  /// Called before each of the engine's steps of `h` s: apply forces. Forces must not wake sleeping
  /// bodies (pass wake = false) unless something changed.
  virtual void BeforeStep(float /*h*/) {}
  virtual void AfterTick() {}
  /// Sets a player's axes and buttons from the next tick on.
  virtual void SetInput(int /*player*/, const Input& /*input*/) {}

  /// Called after AfterTick: adds the edits that this stage finds necessary (a bond breaks, parts
  /// join). The authority proposes them; nothing has changed yet.
  virtual void ProposeEdits(std::vector<Edit>* /*edits*/) {}
  /// Called when an edit was applied (after Rebuilt, if bodies changed).
  virtual void Edited(const Edit& /*edit*/) {}

  /// Saves the stage's memory between ticks, so that Restore can go back bit for bit. Load takes
  /// the values that Save gave.
  virtual void Save(std::vector<float>* /*memory*/) const {}
  /// Returns the number of values that it took.
  virtual std::size_t Load(const float* /*memory*/) { return 0; }

  /// True if the stage needs contact events; the contact pipeline is unchanged for the rest.
  virtual bool listens() const { return false; }
  virtual void BeginContact(b2Contact* /*contact*/) {}
  virtual void EndContact(b2Contact* /*contact*/) {}
  virtual void PreSolve(b2Contact* /*contact*/) {}
  virtual void PostSolve(b2Contact* /*contact*/, const b2ContactImpulse* /*impulse*/) {}
};

/// Returns the stages that this scene needs, in their order of action (a line each in stages.cpp).
std::vector<std::unique_ptr<Stage>> MakeStages(const StageWorld& world);

/// True if physics alone can cause edits of the scene (a bond breaks, parts join, a hand grips).
bool ProposesEdits(const Scene& scene);

/// Fixtures carry their part's id in their user data. Fixtures of stages carry at least this
/// number, so that they are never mistaken for a part's.
constexpr std::uintptr_t kStageFixture = 1u << 24;

}  // namespace seam
