#pragma once
/// What a World is made of; for its own files.

#include <box2d/box2d.h>

#include <algorithm>
#include <cfloat>
#include <optional>
#include <vector>

#include "common/base/check.h"
#include "common/physics/contact_hub.h"
#include "common/physics/stage.h"
#include "common/physics/world.h"
#include "common/physics/world_build.h"
#include "common/physics/world_contacts.h"

namespace seam {

struct World::Impl {
  explicit Impl(const Scene& s) : scene(s), composition(Compose(s)) {
    Empty();
    built = BuildScene(scene, composition, &*world);
    float lightest = FLT_MAX;
    for (const MovingBody& m : built.moving) lightest = std::min(lightest, m.mass.mass);
    meter.Set(s.solver.substeps, lightest);
    stages = MakeStages({scene, composition, built, tick});
    std::vector<Stage*> listening;
    for (const auto& stage : stages) {
      if (stage->listens()) listening.push_back(stage.get());
    }
    if (!listening.empty()) hub.emplace(meter, std::move(listening));
    Listen();
    for (const auto& stage : stages) stage->Rebuilt(&*world);
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
    world.emplace(ToB2(scene.gravity));
    world->SetContinuousPhysics(scene.solver.continuous);
    world->SetAllowSleeping(scene.solver.sleep);
    world->SetWarmStarting(scene.solver.warm_starting);
  }

  /// Of one of the engine's steps, s.
  float step_s() const {
    return 1.0f / static_cast<float>(scene.solver.tick_hz * scene.solver.substeps);
  }

  const MovingBody& moving(int body) const {
    SEAM_ASSERT(body >= 0 && body < static_cast<int>(built.moving.size()));
    return built.moving[static_cast<std::size_t>(body)];
  }

  const Scene scene;
  const Composition composition;
  ImpulseMeter meter;
  std::optional<b2World> world;         // rebuilt by Barrier and Restore
  BuiltScene built;
  std::int64_t tick = 0;
  std::vector<std::unique_ptr<Stage>> stages;   // in their order of action
  std::optional<ContactHub> hub;        // only when a stage listens
  std::vector<Impact> impacts;
  // Looked up when asked for: a world that nobody asks pays nothing.
  std::optional<std::vector<Touch>> touches;
  std::optional<std::vector<Block>> blocks;
};

}  // namespace seam
