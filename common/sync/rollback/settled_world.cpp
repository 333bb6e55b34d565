/// Replica: the world of another peer, for one that has come later. States on the wire are rounded
/// and have no impulses, so copies that begin with them are only nearly the same.

#include <algorithm>
#include <memory>
#include <utility>

#include "common/base/state_archive.h"
#include "common/physics/saved/world_saved.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

void PersistSettled(StateArchive& a, int* revision, WorldSnapshot* world) {
  a.Section("settled world");
  a.Int(revision, 0, StateArchive::kCountMost);
  Persist(a, world);
}

/// Of two worlds mixed, neither's bodies would be where their contacts are.
template <class Is>
bool AreAll(const World& world, const Is& is) {
  for (int body = 0; body < world.body_count(); ++body) {
    if (!is(body)) return false;
  }
  return true;
}

}  // namespace

Bytes Replica::SettledWorld(std::int64_t from, std::int64_t to) const {
  // Where no inputs move anything, what was told is a fact (Replay::IsFact).
  if (!config_.policy->SendsCompleteTicks() || drivers_.concerned().empty()) return {};
  to = std::min({to, reach_.CompleteTickOfAll(), replay_.settled()});
  const std::shared_ptr<const WorldSnapshot> barrier = replay_.SharedBarrier(from, to);
  if (barrier == nullptr) return {};
  const auto settled = [&](int body) { return SettledPast(body, barrier->tick) != nullptr; };
  if (!AreAll(world_, settled)) return {};
  WorldSnapshot world = *barrier;
  int edits = revision();
  StateArchive a;
  PersistSettled(a, &edits, &world);
  return a.Take();
}

Status Replica::TakeWorld(ByteView settled) {
  int edits = 0;
  WorldSnapshot world;
  StateArchive a(settled);
  PersistSettled(a, &edits, &world);
  if (a.ok() && a.left() > 0) a.Fail("there is more than the world");
  if (!a.ok()) return a.status();
  ApplyEdits();
  if (edits != revision() || world.composition != world_.composition().hash) return Status::Ok();
  if (world.bodies.size() != static_cast<std::size_t>(world_.body_count())) {
    return Status::Error("it has another number of bodies than its edits");
  }
  const auto joins = [&](int body) {
    return roles_.Simulates(body) && memory_.track(body).placed &&
           memory_.history().At(world.tick, body) != nullptr;
  };
  const bool reached = replay_.oldest() <= world.tick && world.tick <= tick();
  if (!reached || drivers_.concerned().empty() || !AreAll(world_, joins)) return Status::Ok();
  const WorldSnapshot now = world_.Keep();
  if (world.joints_there != now.joints_there) return Status::Ok();  // edited since
  // Joints that only one of us has in its world.
  for (std::size_t j = 0; j < std::min(world.joints.size(), now.joints.size()); ++j) {
    if (world.joints[j].size() != now.joints[j].size()) world.joints[j] = now.joints[j];
  }
  const Status good = world_.Load(world);
  if (!good.ok()) return good;
  SEAM_ASSERT(world_.Restore(now).ok());
  if (!replay_.GoOnFrom(std::make_shared<const WorldSnapshot>(world))) return Status::Ok();
  taken_tick_ = world.tick;
  for (int body = 0; body < world_.body_count(); ++body) {
    *memory_.history().At(world.tick, body) = world.bodies[static_cast<std::size_t>(body)].state;
    BodyTrack& track = memory_.track(body);
    track.dynamic_since = world.tick;
    // Older states say nothing any more; a commitment to rest is newer than its states.
    if (!track.at_rest) track.heard_tick = std::max(track.heard_tick, world.tick);
  }
  return Status::Ok();
}

}  // namespace seam
