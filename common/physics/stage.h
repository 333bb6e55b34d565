#pragma once
/// What acts on a world besides gravity, contacts and joints: water, conveyors, thrust, characters,
/// the fixtures of featherweight parts. One stage each, made only for scenes that use it.

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

/// What a stage works on. The references stay valid for the stage's life; what they refer to
/// changes (bodies are made anew by Barrier, Restore and changes of topology).
struct StageWorld {
  const Scene& scene;
  const Composition& composition;
  const BuiltScene& built;
  const std::int64_t& tick;            ///< ticks stepped so far
  const std::vector<Motion>& motions;  ///< by moving body
  const Topology& topology;
};

/// Deterministic: a function of the scene, the calls and what Save keeps. In each tick:
///
///   BeforeTick,  then per substep: BeforeStep, the engine's step (contacts),  then AfterTick
///
/// No hidden forces: whatever moves a body comes from here or from the engine.
class Stage {
 public:
  virtual ~Stage() = default;

  /// The bodies, fixtures and joints in `world` are new (also called once at the start): look them
  /// up again. May add fixtures, and bodies whose user data pointer is 0 (anchored); no joints.
  virtual void Rebuilt(b2World* world) = 0;
  /// After Rebuilt, when the world goes back to a snapshot: the bodies are where they were then,
  /// velocities and memory follow. Contacts are found next: what bodies touch must be there.
  virtual void Placed() {}
  /// Before the world is emptied: forget all pointers into it.
  virtual void Emptied() {}
  /// The tick is another one than that after the last step: a peer joined late, or went back.
  virtual void TickSet() {}
  /// Once before each tick, awake bodies or not: choose motor speeds, stream fixtures.
  virtual void BeforeTick() {}
  /// Before each of the engine's steps of `h` s: apply forces. Forces must not wake what sleeps
  /// (pass wake = false) unless something changed.
  virtual void BeforeStep(float /*h*/) {}
  virtual void AfterTick() {}
  /// A player's axes and buttons from the next tick on.
  virtual void SetInput(int /*player*/, const Input& /*input*/) {}

  /// After AfterTick: adds what this stage finds should change (a bond breaks, parts join). Whoever
  /// has authority proposes it; nothing has changed yet.
  virtual void ProposeEdits(std::vector<Edit>* /*edits*/) {}
  /// An edit was applied (after Rebuilt, if bodies changed).
  virtual void Edited(const Edit& /*edit*/) {}

  /// What the stage remembers from tick to tick, so that Restore can go back bit for bit. Load
  /// takes what Save gave.
  virtual void Save(std::vector<float>* /*memory*/) const {}
  /// Returns how many it took.
  virtual std::size_t Load(const float* /*memory*/) { return 0; }

  /// Stages that return true hear of contacts; others cost the contact pipeline nothing.
  virtual bool listens() const { return false; }
  virtual void BeginContact(b2Contact* /*contact*/) {}
  virtual void EndContact(b2Contact* /*contact*/) {}
  virtual void PreSolve(b2Contact* /*contact*/) {}
  virtual void PostSolve(b2Contact* /*contact*/, const b2ContactImpulse* /*impulse*/) {}
};

/// The stages that this scene needs, in their order of action (stages.cpp has one line for each).
std::vector<std::unique_ptr<Stage>> MakeStages(const StageWorld& world);

/// Whether physics alone can give reason to edits of the scene (a bond breaks, parts join, a hand
/// grips).
bool ProposesEdits(const Scene& scene);

/// Fixtures carry their part's id in their user data; those that stages make carry at least this,
/// so that they are never taken for a part's.
constexpr std::uintptr_t kStageFixture = 1u << 24;

}  // namespace seam
