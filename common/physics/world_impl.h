#pragma once
/// What a World is made of; for its own files.

#include <box2d/box2d.h>

#include <algorithm>
#include <cfloat>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/physics/contact_hub.h"
#include "common/physics/exact/exact_step.h"
#include "common/physics/flight/flight.h"
#include "common/physics/stage.h"
#include "common/physics/world.h"
#include "common/physics/world_build.h"
#include "common/physics/world_contacts.h"

namespace seam {

struct World::Impl {
  explicit Impl(Topology begin) : topology(std::move(begin)) {
    const bool blasts = !scene.charges.empty() || !scene.scripts.empty();
    if (blasts && !scene.bricks.empty()) topology.BricksLeft();  // not in the tick of the first
    memory.Clear(composition.hash);
    Empty();
    Build();
    FindPresent(true);
    FindStages();
    Listen();
    for (const auto& stage : stages) stage->Rebuilt(&*world);
  }

  /// Everything.
  void Build() {
    memory.revision = topology.revision();
    built = BuildScene(scene, composition, &*world, &memory);
    body_of_id.assign(scene.parts.size(), -1);
    for (std::size_t i = 0; i < built.moving.size(); ++i) {
      body_of_id[static_cast<std::size_t>(built.moving[i].id)] = static_cast<int>(i);
    }
    motions.assign(built.moving.size(), Motion::kDynamic);
    led_count = 0;
    lightest = FLT_MAX;
    for (const MovingBody& m : built.moving) lightest = std::min(lightest, m.mass.mass);
    gives_all = GivesAll(scene);
    joints_hash.reset();
    remembered.clear();
    ForgetPages();
    Built();
  }

  /// The bodies and joints of the world are new.
  void Built() {
    meter.Set(scene.solver.substeps, lightest);
    if (scene.solver.joints == JointSolving::kIterative) return;
    if (memory.joints.empty() && !gives_all) return exact.reset();
    exact.emplace(scene, &*world, built, memory, gives_all);
    if (!exact->needed()) exact.reset();
  }

  /// Makes the stages anew if the scene needs more of them than there are.
  void FindStages() {
    std::vector<std::unique_ptr<Stage>> needed =
        MakeStages({scene, composition, built, tick, motions, topology});
    if (needed.size() <= stages.size()) return;
    stages = std::move(needed);
    std::vector<Stage*> listening;
    for (const auto& stage : stages) {
      if (stage->listens()) listening.push_back(stage.get());
    }
    hub.reset();
    if (!listening.empty()) hub = std::make_unique<ContactHub>(meter, std::move(listening));
  }

  void Listen() {
    if (hub) {
      world->SetContactListener(&*hub);
    } else {
      world->SetContactListener(&meter);
    }
  }

  /// Begins a world without bodies.
  void Empty() {
    for (const auto& stage : stages) stage->Emptied();
    exact.reset();
    world.emplace(ToB2(scene.gravity));
    world->SetContinuousPhysics(scene.solver.continuous);
    world->SetAllowSleeping(scene.solver.sleep);
    world->SetWarmStarting(scene.solver.warm_starting);
  }

  /// Of one of the engine's steps, s.
  float step_s() const {
    return 1.0f / static_cast<float>(scene.solver.tick_hz * scene.solver.substeps);
  }

  /// What survives when the bodies are made anew.
  WorldSnapshot Keep();
  std::vector<float> Speeds() const;  ///< of motors, by the scene's joints
  /// Whether its bodies and joints are those that are there now.
  Status ValidateSnapshot(const WorldSnapshot& snapshot) const;
  /// Makes everything anew, in the states of the snapshot. What it has of joints that are gone
  /// is left out. The snapshot of stages may be empty: they begin anew, too.
  /// `new_motions`: by body of the snapshot; nullptr: they stay, and so do the bodies.
  void Rebuild(const WorldSnapshot& snapshot, const std::vector<Motion>* new_motions);
  /// Whether nothing that takes part in steps moves, or is moved.
  bool AllStill() const;
  bool BuiltAlready(const WorldSnapshot& snapshot) const;
  /// Lets bodies that have become absent, or are so no more, leave the engine or come back.
  void Settle();
  /// Before a rebuild: decides which bodies will be aside.
  void Arrange(const std::vector<Motion>& wanted);
  void ArrangeCrossed();
  void KnowJoints(bool any_absent);
  /// Hashes of which joints are there, absent bodies' included.
  std::uint64_t JointsHash() const;
  /// Whether the joint holds, or would if its bodies were not absent.
  bool Holds(std::size_t joint) const;
  std::vector<Pin> FindPins() const;

  /// Before and after one of the engine's steps of h seconds.
  void LetLedBodiesMove();
  void PutLedBodiesOnTheirPath(float h);
  /// After a tick.
  void MoveAbsentBodies();
  /// By motions: who is present. All else is to be moved aside, if `aside` is not set.
  void FindPresent(bool aside);
  void Cross(int body, bool goes);
  /// Nothing is known of which pages are as they were.
  void ForgetPages();
  /// The body, and so its page of `kept`, may have changed.
  void NoteChanged(int body) {
    const auto i = static_cast<std::size_t>(body);
    stale[i / kept.kPage] = 1;
    changed[i] = 1;
    stamps[i] = ++last_stamp;
    change_log[last_stamp & (change_log.size() - 1)] = body;
  }
  /// A body that is aside was changed.
  void NoteAside(int body);
  /// Any of them may have been.
  void NoteAllAside();
  /// Pages of what is present are never as they were.
  void NotePresent();
  /// What is remembered of contacts of those that are present and lie as they did then; ascending.
  std::vector<WorldSnapshot::Point> Remembered(const WorldSnapshot& snapshot) const;

  const MovingBody& moving(int body) const {
    SEAM_ASSERT(body >= 0 && body < static_cast<int>(built.moving.size()));
    ++looks;
    return built.moving[static_cast<std::size_t>(body)];
  }

  Topology topology;
  const Scene& scene = topology.scene();
  const Composition& composition = topology.composition();
  ImpulseMeter meter;
  std::optional<b2World> world;  // rebuilt by Barrier and Restore
  BuildMemory memory;
  BuiltScene built;
  std::optional<ExactStep> exact;      // only when there are joints for it
  std::vector<int> body_of_id;         // by part: the moving body of that id, -1: none
  std::vector<Motion> motions;         // by moving body
  mutable std::int64_t looks = 0;      // calls of moving()
  int led_count = 0;                   // of them kLed
  std::vector<BodyState> led_path;     // by moving body: of led ones, where the step began
  bool ordered = false;                // contacts are solved in an order of their own
  std::optional<WorldSnapshot> still;  // of which all was built, when nothing moved
  bool unsettled = false;              // some are absent, or are so no more, but still to be moved
  std::vector<int> present;            // moving bodies that are not absent, ascending
  std::vector<int> crossed;            // moving bodies that have come or gone since the last build
  std::vector<int> awake_aside;        // moving bodies that are aside and may be awake
  std::vector<char> noted_awake;       // by moving body: it is in awake_aside
  Paged<WorldSnapshot::Body> kept;     // of the last Keep
  std::vector<char> stale;             // by page of `kept`: what it tells of may have changed since
  std::vector<char> changed;          // by moving body of such a page: it may have; else it has not
  std::vector<std::uint64_t> stamps;  // by moving body: another each time that it may have changed
  std::uint64_t last_stamp = 0;
  std::vector<int> change_log;  // by stamp, the last of them: the body; 2^n of them
  std::uint64_t log_from = 0;   // stamps up to this one are not in it
  struct Contacts {
    BodyState pose;
    std::vector<WorldSnapshot::Point> points;
  };
  std::map<int, Contacts> remembered;                // by moving body, see RememberContacts
  float lightest = FLT_MAX;                          // kg, of the moving bodies
  bool gives_all = false;                            // GivesAll of the scene
  mutable std::optional<std::uint64_t> joints_hash;  // of this revision
  mutable int joints_hash_revision = -1;
  /// While bodies are absent: the joints as they were found when none was.
  struct AllPresent {
    std::vector<Pin> pins;
    std::vector<char> made;  // by the scene's joints
  };
  std::optional<AllPresent> all_present;
  std::int64_t tick = 0;
  std::vector<std::unique_ptr<Stage>> stages;  // in their order of action
  std::unique_ptr<ContactHub> hub;             // only when a stage listens
  std::vector<Impact> impacts;
  mutable Flight flight;
  // Computed when asked for, so that a world that nobody asks has no cost.
  std::optional<std::vector<Touch>> touches;
  std::optional<std::vector<BlockedDirection>> blocked_directions;
};

}  // namespace seam
