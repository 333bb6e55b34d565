#pragma once
/// Private data of World, for its own files.

#include <box2d/box2d.h>

#include <algorithm>
#include <cfloat>
#include <map>
#include <optional>
#include <typeinfo>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/physics/contact_hub.h"
#include "common/physics/contact_order.h"
#include "common/physics/exact/exact_step.h"
#include "common/physics/flight/flight.h"
#include "common/physics/outline/outline_contacts.h"
#include "common/physics/rest/slow_watch.h"
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
    BeginContacts();
  }

  /// Finds the contacts of bodies that have just been made and placed.
  void BeginContacts() {
    for (const auto& stage : stages) stage->Placed();
    FindContactsInOrder(&*world);
    // No time passes, but contacts begin to touch, which wakes their bodies.
    world->Step(0, 1, 1);
  }

  /// Builds all bodies and joints.
  void Build() {
    memory.revision = topology.revision();
    built = BuildScene(scene, composition, &*world, &memory);
    outlines.Find(scene, composition, built);
    meter.SetOutlines(outlines.any() ? &outlines : nullptr);
    body_of_id.assign(scene.parts.size(), -1);
    for (std::size_t i = 0; i < built.moving.size(); ++i) {
      body_of_id[static_cast<std::size_t>(built.moving[i].id)] = static_cast<int>(i);
    }
    activities.assign(built.moving.size(), Activity::kSimulated);
    slow.Reset(built.moving.size());
    prescribed_count = 0;
    lightest = FLT_MAX;
    for (const MovingBody& m : built.moving) lightest = std::min(lightest, m.mass.mass);
    has_elastic = HasElastic(scene);
    joints_hash.reset();
    remembered.clear();
    InvalidatePages();
    Built();
  }

  /// Prepares the meter and the exact solver for new bodies and joints.
  void Built() {
    meter.Set(scene.solver.substeps, lightest);
    const bool soft = scene.solver.contacts == ContactSolving::kSoft;
    if (scene.solver.joints == JointSolving::kIterative && !soft) return;
    if (memory.joints.empty() && !has_elastic && !soft) return exact.reset();
    exact.emplace(scene, &*world, built, memory, has_elastic);
    if (!exact->needed()) exact.reset();
  }

  /// Makes the stages that the scene needs as it is now. Returns their memory; a stage that was
  /// needed before keeps its own.
  std::vector<float> FindStages() {
    std::vector<std::unique_ptr<Stage>> needed =
        MakeStages({scene, composition, built, tick, activities, topology});
    const auto alike = [](const std::unique_ptr<Stage>& a, const std::unique_ptr<Stage>& b) {
      const Stage &one = *a, &other = *b;
      return typeid(one) == typeid(other);
    };
    std::vector<float> memories;
    for (const auto& stage : needed) {
      const auto before = std::find_if(stages.begin(), stages.end(),
                                       [&](const auto& had) { return alike(had, stage); });
      (before == stages.end() ? stage : *before)->Save(&memories);
    }
    if (std::equal(needed.begin(), needed.end(), stages.begin(), stages.end(), alike)) {
      return memories;
    }
    stages = std::move(needed);
    std::vector<Stage*> listening;
    for (const auto& stage : stages) {
      if (stage->listens()) listening.push_back(stage.get());
    }
    hub.reset();
    if (!listening.empty()) hub = std::make_unique<ContactHub>(meter, std::move(listening));
    return memories;
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

  /// Returns the duration of one of the engine's steps, s.
  float step_s() const {
    return 1.0f / static_cast<float>(scene.solver.tick_hz * scene.solver.substeps);
  }

  /// Returns the state that survives when the bodies are made anew.
  WorldSnapshot Keep();
  std::vector<float> Speeds() const;  ///< of motors, by the scene's joints
  /// Returns an error if the snapshot has other bodies or joints than the world.
  Status ValidateSnapshot(const WorldSnapshot& snapshot) const;
  /// Makes everything anew, in the states of the snapshot. Data of joints that are gone is left
  /// out. The stages' data may be empty: then they begin anew, too. `edited`: activities by body of
  /// the snapshot, after an edit; nullptr: activities and bodies stay.
  void Rebuild(const WorldSnapshot& snapshot, const std::vector<Activity>* edited);
  /// True if every body that takes part in steps is at rest and nothing moves on a path.
  bool AllStill() const;
  bool BuiltAlready(const WorldSnapshot& snapshot) const;
  /// Moves bodies between the engine and `aside` after changes of activity.
  void Settle();
  /// Before a rebuild: decides which bodies will be aside.
  void Arrange(const std::vector<Activity>& wanted);
  void ArrangeCrossed();
  void SaveAllJoints(bool any_aside);
  /// Returns a hash of the existing joints, those of bodies that are aside included.
  std::uint64_t JointsHash() const;
  /// True if the joint exists, or would if its bodies were present.
  bool Holds(std::size_t joint) const;
  std::vector<bool> AllHeld() const;  ///< Holds of each joint
  std::vector<Pin> FindPins() const;

  /// Called before and after one of the engine's steps of h seconds.
  void BeginPrescribedStep();
  void EndPrescribedStep(float h);
  /// Called after a tick.
  void MoveAside();
  /// Finds the present bodies by their activities. The others are to be moved if not `aside`.
  void FindPresent(bool aside);
  void Cross(int body, bool goes);
  /// Stores the contact impulses of a body that becomes dormant. They warm-start its contacts if it
  /// returns in the same pose.
  void RememberContacts(int body);
  /// Marks all pages as changed.
  void InvalidatePages();
  /// Marks the body, and so its page of `kept`, as possibly changed.
  void NoteChanged(int body) {
    const auto i = static_cast<std::size_t>(body);
    stale[i / kept.kPage] = 1;
    changed[i] = 1;
    stamps[i] = ++last_stamp;
    change_log[last_stamp & (change_log.size() - 1)] = body;
  }
  /// Marks a body that is aside as changed.
  void MarkAside(int body);
  /// Marks all bodies as possibly changed, if any is aside.
  void MarkAllAside();
  /// Marks all present bodies as possibly changed.
  void MarkPresent();
  /// Returns the remembered contact points of present bodies in the remembered pose; ascending.
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
  std::optional<TouchLog> touch_log;  // with WatchTouches
  std::optional<b2World> world;  // rebuilt by Barrier and Restore
  BuildMemory memory;
  BuiltScene built;
  OutlineContacts outlines;            // of the bodies in `built`
  std::optional<ExactStep> exact;      // only when there are joints for it
  std::vector<int> body_of_id;         // by part: the moving body of that id, -1: none
  std::vector<Activity> activities;    // by moving body
  SlowWatch slow;
  mutable std::int64_t looks = 0;      // calls of moving()
  int prescribed_count = 0;            // number of kPrescribed bodies
  std::vector<BodyState>
      prescribed_from;                 // by moving body: state of a kPrescribed one before the step
  std::optional<WorldSnapshot> still;  // the state last built from, if nothing moved then
  bool as_built = false;               // nothing has changed since the last Rebuild
  bool unsettled = false;              // a body is to come or go
  std::vector<int> present;            // moving bodies that are present, ascending
  std::vector<int> crossed;            // moving bodies that have come or gone since the last build
  std::vector<int> awake_aside;        // moving bodies that are aside and may be awake
  std::vector<char> listed_awake;      // by moving body: it is in awake_aside
  Paged<WorldSnapshot::Body> kept;     // of the last Keep
  std::vector<char> stale;             // by page of `kept`: may have changed since
  std::vector<char> changed;           // by moving body of a stale page: may have changed
  std::vector<std::uint64_t> stamps;   // by moving body: renewed at each possible change
  std::uint64_t last_stamp = 0;
  std::vector<int> change_log;  // body by stamp, a ring of the last 2^n
  std::uint64_t log_from = 0;   // stamps up to this one are not in it
  struct Contacts {
    BodyState pose;
    std::vector<WorldSnapshot::Point> points;
  };
  std::map<int, Contacts> remembered;                // by moving body, see RememberContacts
  float lightest = FLT_MAX;                          // kg, of the moving bodies
  bool has_elastic = false;                          // HasElastic of the scene
  mutable std::optional<std::uint64_t> joints_hash;  // for the revision below
  mutable int joints_hash_revision = -1;
  /// While bodies are aside: the joints as they were when none was.
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
  // Computed on demand, so that an unused result has no cost.
  std::optional<std::vector<Touch>> touches;
  std::optional<std::vector<BlockedDirection>> blocked_directions;
};

}  // namespace seam
