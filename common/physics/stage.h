#pragma once
/// Interface of the modules that act on a world besides gravity, contacts and joints: water,
/// conveyors, thrust, characters, fixtures of featherweight parts. Made only for scenes that use
/// them.

#include <box2d/box2d.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/physics/activity.h"
#include "common/physics/world_build.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/scene/scene_limits.h"
#include "common/scene/types.h"
#include "common/topology/edit.h"
#include "common/topology/topology.h"

namespace seam {

/// The data that a stage works on. The references stay valid for the stage's life, but the objects
/// change: Barrier, Restore and changes of topology rebuild the bodies.
struct StageWorld {
  const Scene& scene;
  const Composition& composition;
  const BuiltScene& built;
  const std::int64_t& tick;                 ///< ticks stepped so far
  const std::vector<Activity>& activities;  ///< by moving body
  const Topology& topology;
};

/// Whole numbers up to here are exact in the floats that stages save: parts, ticks, counts.
constexpr int kStageNumberMax = 1 << 24;

/// The numbers that the stages of a world have saved, to be read back in their order. Trusts none
/// of them: after a number that is missing or out of its range, good() is false.
class StageMemory {
 public:
  /// `numbers` must outlive this.
  explicit StageMemory(const std::vector<float>& numbers) : numbers_(numbers) {}

  /// Returns the next number; 0 if it is none.
  float Next() {
    const float number = at_ < numbers_.size() ? numbers_[at_++] : NAN;
    const bool in = std::abs(number) <= kImpulseMax;  // no place, speed or time is larger
    good_ = good_ && in;
    return in ? number : 0;
  }
  /// Returns the next number as a whole one; `least` if it is not in least..most.
  int NextInt(int least, int most) {
    const auto number = static_cast<double>(Next());
    const bool in = number >= least && number <= most;
    good_ = good_ && in;
    return in ? static_cast<int>(number) : least;
  }
  /// Returns the next number as a count of groups of `each` numbers that follow.
  std::size_t NextCount(std::size_t each) {
    const int count = NextInt(0, kStageNumberMax);
    const bool in = static_cast<std::size_t>(count) <= (numbers_.size() - at_) / each;
    good_ = good_ && in;
    return in ? static_cast<std::size_t>(count) : 0;
  }
  bool good() const { return good_; }
  /// True if every number has been read.
  bool done() const { return at_ == numbers_.size(); }

 private:
  const std::vector<float>& numbers_;
  std::size_t at_ = 0;
  bool good_ = true;
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
  /// Called after Rebuilt: the bodies are placed. When the world goes back to a snapshot,
  /// velocities and memory follow. Contacts are found next: fixtures that bodies may touch must
  /// exist by then.
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
  /// the values that Save gave, and no more.
  virtual void Save(std::vector<float>* /*memory*/) const {}
  virtual void Load(StageMemory* /*memory*/) {}

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
