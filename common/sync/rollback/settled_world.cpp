/// Replica: the world of another peer, for one that has come later. States on the wire are rounded
/// and have no impulses, so copies that begin with them are only nearly the same.

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/base/state_archive.h"
#include "common/physics/saved/world_saved.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

/// `simulated`: by body.
void PersistSettled(StateArchive& a, int* revision, WorldSnapshot* world,
                    std::vector<char>* simulated) {
  a.Section("settled world");
  a.Int(revision, 0, StateArchive::kCountMost);
  Persist(a, world);
  a.List(simulated, StateArchive::kListMost, [&](char* each) { a.Int(each, 0, 1); });
}

}  // namespace

Bytes Replica::SettledWorld(std::int64_t from, std::int64_t to) const {
  if (!config_.policy->SendsCompleteTicks()) return {};
  to = std::min({to, reach_.CompleteTickOfAll(), replay_.settled()});
  const std::shared_ptr<const WorldSnapshot> barrier = replay_.SharedBarrier(from, to);
  if (barrier == nullptr) return {};
  WorldSnapshot world = *barrier;
  std::vector<char> simulated;
  for (int body = 0; body < world_.body_count(); ++body) {
    simulated.push_back(SettledPast(body, world.tick) != nullptr ? 1 : 0);
  }
  int edits = revision();
  StateArchive a;
  PersistSettled(a, &edits, &world, &simulated);
  return a.Take();
}

Status Replica::TakeWorld(ByteView settled) {
  int edits = 0;
  WorldSnapshot world;
  std::vector<char> simulated;
  StateArchive a(settled);
  PersistSettled(a, &edits, &world, &simulated);
  if (a.ok() && a.left() > 0) a.Fail("there is more than the world");
  if (!a.ok()) return a.status();
  ApplyEdits();
  const WorldSnapshot now = world_.Barrier();
  const bool same = edits == revision() && world.composition == now.composition;
  if (!same || world.joints_there != now.joints_there) return Status::Ok();  // edited since
  const auto count = static_cast<std::size_t>(world_.body_count());
  if (world.bodies.size() != count || simulated.size() != count) {
    return Status::Error("it has another number of bodies than its edits");
  }
  const auto joins = [&](int body) {
    const bool both = simulated[static_cast<std::size_t>(body)] != 0 && roles_.Simulates(body);
    return both && memory_.track(body).placed && memory_.history().At(world.tick, body) != nullptr;
  };
  std::vector<WorldSnapshot::Body> bodies;
  for (int body = 0; body < world_.body_count(); ++body) {
    WorldSnapshot::Body each = world.bodies[static_cast<std::size_t>(body)];
    const BodyState* const past = memory_.history().At(world.tick, body);
    if (!joins(body) && past != nullptr) each.state = *past;
    bodies.push_back(each);
  }
  world.bodies.Take(bodies);
  const Status good = world_.Load(world);
  if (!good.ok()) return good;
  SEAM_ASSERT(world_.Restore(now).ok());
  if (!replay_.GoOnFrom(std::make_shared<const WorldSnapshot>(world))) return Status::Ok();
  for (int body = 0; body < world_.body_count(); ++body) {
    if (!joins(body)) continue;
    *memory_.history().At(world.tick, body) = world.bodies[static_cast<std::size_t>(body)].state;
    memory_.track(body).dynamic_since = world.tick;
  }
  return Status::Ok();
}

}  // namespace seam
