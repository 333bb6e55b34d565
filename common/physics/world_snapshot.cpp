/// World: snapshots and going back in time. In this engine a snapshot of poses, velocities and
/// impulses alone does not replay, because the order in which contacts are solved depends on
/// history and cannot be set. So the live world goes the same way as a restored one: it is rebuilt
/// from its own snapshot at the tick at which it takes one (the barrier, docs/lessons.md).

#include <algorithm>
#include <cstring>
#include <string>
#include <tuple>

#include "common/base/bytes.h"
#include "common/physics/joint_impulses.h"
#include "common/physics/reveal.h"
#include "common/physics/world_impl.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace {

SEAM_REVEAL(SleepTime, float, b2Body, m_sleepTime);

using PointKey = std::tuple<std::uint64_t, std::uint64_t>;
PointKey KeyOf(const WorldSnapshot::Point& p) { return {p.pair, p.feature}; }

/// Calls `visit(key, point)` for all points of a contact.
template <typename Visit>
void EachPointOf(b2Contact* c, const Visit& visit) {
  // Part numbers and ids of features are below 2^32, a chain's segments and pieces of parts below
  // 2^12: together they identify a point.
  const std::uint64_t a = PartOf(c->GetFixtureA()), b = PartOf(c->GetFixtureB());
  const std::uint64_t pieces =
      std::uint64_t{PieceOf(c->GetFixtureA())} << 8 | PieceOf(c->GetFixtureB());
  const auto child =
      static_cast<std::uint64_t>(c->GetChildIndexA() + c->GetChildIndexB()) | pieces << 12;
  b2Manifold* manifold = c->GetManifold();
  for (int32 i = 0; i < manifold->pointCount; ++i) {
    b2ManifoldPoint& point = manifold->points[i];
    visit(PointKey{a << 32 | b, child << 32 | point.id.key}, &point);
  }
}

/// Calls `visit(key, point)` for all points of all contacts.
template <typename Visit>
void EachPoint(b2World* world, const Visit& visit) {
  for (b2Contact* c = world->GetContactList(); c != nullptr; c = c->GetNext()) {
    EachPointOf(c, visit);
  }
}

bool IsBefore(const WorldSnapshot::Point& x, const WorldSnapshot::Point& y) {
  return KeyOf(x) < KeyOf(y);
}

/// Returns nullptr if the point is not found. Requires ascending points.
const WorldSnapshot::Point* Find(const std::vector<WorldSnapshot::Point>& points,
                                 const PointKey& key) {
  const auto found = std::lower_bound(
      points.begin(), points.end(), key,
      [](const WorldSnapshot::Point& p, const PointKey& k) { return KeyOf(p) < k; });
  return found == points.end() || KeyOf(*found) != key ? nullptr : &*found;
}

}  // namespace

WorldSnapshot World::Impl::Keep() {
  WorldSnapshot out;
  out.tick = tick;
  out.composition = composition.hash;
  out.joints_there = JointsHash();
  MarkPresent();
  for (std::size_t page = 0; page < kept.page_count(); ++page) {
    if (stale[page] == 0) continue;
    const auto noted = [this](std::size_t i) { return std::exchange(changed[i], 0) != 0; };
    kept.Remake(page, noted, [this](std::size_t i) {
      const b2Body* b = built.moving[i].body;
      WorldSnapshot::Body body;
      body.state = {FromB2(b->GetPosition()), b->GetAngle(), FromB2(b->GetLinearVelocity()),
                    b->GetAngularVelocity()};
      body.awake = b->IsAwake();
      body.quiet_s = b->*Member(SleepTime());
      body.going_s = slow.going_s(static_cast<int>(i));
      return body;
    });
    stale[page] = 0;
  }
  out.bodies = kept;
  EachPoint(&*world, [&](const PointKey& key, const b2ManifoldPoint* point) {
    const auto& [pair, feature] = key;
    out.points.push_back({pair, feature, point->normalImpulse, point->tangentImpulse});
  });
  std::sort(out.points.begin(), out.points.end(), IsBefore);
  out.joints.resize(built.joints.size());
  for (const int joint : memory.joints) {
    const auto j = static_cast<std::size_t>(joint);
    for (const float* impulse : ImpulsesOf(built.joints[j])) out.joints[j].push_back(*impulse);
  }
  if (exact) out.left = exact->Left();
  for (const auto& stage : stages) stage->Save(&out.stages);
  out.speeds = Speeds();
  if (touch_log) out.touching = touch_log->touching();
  return out;
}

std::vector<float> World::Impl::Speeds() const {
  std::vector<float> speeds(scene.joints.size(), 0.0f);
  for (const Motor& motor : built.motors) {
    speeds[static_cast<std::size_t>(motor.index)] = motor.Speed();
  }
  return speeds;
}

std::uint64_t World::Impl::JointsHash() const {
  if (joints_hash && joints_hash_revision == topology.revision()) return *joints_hash;
  std::uint64_t hash = Fnv1a("", 0);
  for (std::size_t j = 0; j < built.joints.size(); ++j) {
    const char holds = Holds(j) ? 1 : 0;
    hash = Fnv1a(&holds, 1, hash);
  }
  joints_hash_revision = topology.revision();
  joints_hash = hash;
  return hash;
}

void World::Impl::Settle() {
  if (!unsettled) return;
  Rebuild(Keep(), nullptr);
}

void World::Settle() { impl_->Settle(); }

void World::Impl::RememberContacts(int body) {
  b2Body* const b = moving(body).body;
  if (IsAside(*b)) return;  // already remembered
  std::vector<WorldSnapshot::Point> points;
  for (b2ContactEdge* edge = b->GetContactList(); edge != nullptr; edge = edge->next) {
    EachPointOf(edge->contact, [&](const PointKey& key, const b2ManifoldPoint* point) {
      const auto& [pair, feature] = key;
      points.push_back({pair, feature, point->normalImpulse, point->tangentImpulse});
    });
  }
  const BodyState pose{FromB2(b->GetPosition()), b->GetAngle(), Vec2(0, 0), 0};
  remembered[body] = {pose, std::move(points)};
}

std::vector<WorldSnapshot::Point> World::Impl::Remembered(const WorldSnapshot& snapshot) const {
  std::vector<WorldSnapshot::Point> points;
  if (remembered.empty()) return points;
  for (const int body : present) {
    const auto found = remembered.find(body);
    if (found == remembered.end()) continue;
    const BodyState& lies = snapshot.bodies[static_cast<std::size_t>(body)].state;
    const BodyState& lay = found->second.pose;
    if (lies.position != lay.position || lies.angle != lay.angle) continue;
    points.insert(points.end(), found->second.points.begin(), found->second.points.end());
  }
  std::sort(points.begin(), points.end(), IsBefore);
  return points;
}

/// Before a full rebuild: decides which bodies are to be aside. If the memory is of other bodies,
/// none is, and the next rebuild may move them.
void World::Impl::Arrange(const std::vector<Activity>& wanted) {
  const bool any = !std::all_of(wanted.begin(), wanted.end(), IsPresent);
  const bool others = memory.composition != composition.hash;
  unsettled = others && any;
  if (others) {
    memory.Clear(composition.hash);
    all_present.reset();
    return;
  }
  SaveAllJoints(any);
  memory.goes_aside.clear();
  for (const Activity each : wanted) memory.goes_aside.push_back(IsPresent(each) ? 0 : 1);
}

/// Likewise, before a rebuild of the present bodies.
void World::Impl::ArrangeCrossed() {
  unsettled = false;
  SaveAllJoints(present.size() < activities.size());
  for (const int body : crossed) {
    const auto i = static_cast<std::size_t>(body);
    memory.goes_aside[i] = IsPresent(activities[i]) ? 0 : 1;
  }
}

void World::Impl::Rebuild(const WorldSnapshot& snapshot, const std::vector<Activity>* edited) {
  const bool same = edited == nullptr && memory.composition == composition.hash &&
                    memory.revision == topology.revision();
  std::vector<Activity> wanted;
  if (!same) wanted = edited != nullptr ? *edited : activities;
  same ? ArrangeCrossed() : Arrange(wanted);
  Empty();
  tick = snapshot.tick;  // stages place things by the tick
  // The engine scales warm-start impulses by the ratio to its last step, which is 0 in a new world:
  // give it one.
  world->Step(step_s(), 1, 1);
  if (same) {
    const auto at = [&](int body) { return snapshot.bodies[static_cast<std::size_t>(body)].state; };
    BuildPresent(scene, composition, {present, crossed, at}, &*world, &memory, &built);
    for (const int body : crossed) NoteChanged(body);
    crossed.clear();
    Built();
  } else {
    Build();
    activities = std::move(wanted);
    FindPresent(!unsettled);
  }
  MarkPresent();
  SEAM_ASSERT(snapshot.bodies.size() == built.moving.size());
  Listen();
  for (const auto& stage : stages) stage->Rebuilt(&*world);
  for (Motor& motor : built.motors) {
    const auto index = static_cast<std::size_t>(motor.index);
    if (index < snapshot.speeds.size()) motor.SetSpeed(snapshot.speeds[index]);
  }
  // A body that was aside, and still is, is visited only if it may have changed.
  const auto each = [&](const auto& visit) {
    for (std::size_t page = 0; page < snapshot.bodies.page_count(); ++page) {
      const bool shared = snapshot.bodies.Shares(kept, page);
      if (stale[page] == 0 && shared) continue;
      stale[page] = 1;
      for (std::size_t i = snapshot.bodies.begin(page); i < snapshot.bodies.end(page); ++i) {
        if (shared && changed[i] == 0) continue;
        changed[i] = 1;
        visit(i, snapshot.bodies[i]);
      }
    }
  };
  prescribed_count = 0;
  each([&](std::size_t i, const WorldSnapshot::Body& body) {
    b2Body* b = built.moving[i].body;
    if (activities[i] == Activity::kKinematic) b->SetType(b2_kinematicBody);
    if (activities[i] == Activity::kPrescribed) ++prescribed_count;
    const BodyState& state = body.state;
    const bool there = b->GetPosition() == ToB2(state.position) && b->GetAngle() == state.angle;
    if (!there) b->SetTransform(ToB2(state.position), state.angle);
  });
  BeginContacts();
  const std::vector<WorldSnapshot::Point> before = Remembered(snapshot);
  EachPoint(&*world, [&](const PointKey& key, b2ManifoldPoint* point) {
    const WorldSnapshot::Point* found = Find(snapshot.points, key);
    if (found == nullptr) found = Find(before, key);
    if (found == nullptr) return;
    point->normalImpulse = found->normal;
    point->tangentImpulse = found->tangent;
  });
  for (const int joint : memory.joints) {
    const auto j = static_cast<std::size_t>(joint);
    if (j >= snapshot.joints.size() || snapshot.joints[j].empty()) continue;
    std::size_t next = 0;
    for (float* impulse : ImpulsesOf(built.joints[j])) *impulse = snapshot.joints[j].at(next++);
  }
  each([&](std::size_t i, const WorldSnapshot::Body& body) {
    b2Body* b = built.moving[i].body;
    b->SetLinearVelocity(ToB2(body.state.velocity));
    b->SetAngularVelocity(body.state.spin);
    b->SetAwake(body.awake);
    b->*Member(SleepTime()) = body.quiet_s;
    slow.Restore(static_cast<int>(i), body.going_s);
    if (IsAside(*b)) MarkAside(static_cast<int>(i));
  });
  if (exact && snapshot.composition == composition.hash) exact->Leave(snapshot.left);
  StageMemory memory_of_stages(snapshot.stages);
  if (!snapshot.stages.empty()) {
    for (const auto& stage : stages) stage->Load(&memory_of_stages);
  }
  SEAM_ASSERT(memory_of_stages.done());
  meter.Clear();
  if (touch_log) touch_log->Rebuilt(*world, snapshot.touching);
  touches.reset();
  blocked_directions.reset();
  still.reset();
  if (AllStill()) still = snapshot;
  as_built = true;
}

bool World::Impl::AllStill() const {
  if (unsettled || !crossed.empty()) return false;
  const bool moves = std::any_of(present.begin(), present.end(), [this](int body) {
    return built.moving[static_cast<std::size_t>(body)].body->IsAwake();
  });
  return !moves && std::none_of(composition.assemblies.begin(), composition.assemblies.end(),
                                [](const Assembly& assembly) { return assembly.kinematic >= 0; });
}

/// True if a rebuild from the snapshot would change nothing: the world was built from it, and
/// nothing that takes part in steps has moved since.
bool World::Impl::BuiltAlready(const WorldSnapshot& snapshot) const {
  if (!still || !AllStill() || still->composition != snapshot.composition) return false;
  if (still->joints_there != snapshot.joints_there || still->joints != snapshot.joints)
    return false;
  if (still->left != snapshot.left || still->speeds != snapshot.speeds ||
      still->stages != snapshot.stages)
    return false;
  const auto same_point = [](const WorldSnapshot::Point& x, const WorldSnapshot::Point& y) {
    return KeyOf(x) == KeyOf(y) && x.normal == y.normal && x.tangent == y.tangent;
  };
  if (!std::equal(still->points.begin(), still->points.end(), snapshot.points.begin(),
                  snapshot.points.end(), same_point)) {
    return false;
  }
  return std::all_of(present.begin(), present.end(), [&](int body) {
    const auto i = static_cast<std::size_t>(body);
    return std::memcmp(&still->bodies[i].state, &snapshot.bodies[i].state, sizeof(BodyState)) == 0;
  });
}

WorldSnapshot World::Barrier() {
  WorldSnapshot snapshot = impl_->Keep();
  if (!impl_->as_built && !impl_->BuiltAlready(snapshot)) SEAM_ASSERT(Restore(snapshot).ok());
  return snapshot;
}

std::vector<int> World::MayDifferFrom(const WorldSnapshot& snapshot) const {
  SEAM_ASSERT(snapshot.bodies.size() == impl_->kept.size());
  impl_->MarkPresent();
  std::vector<int> apart;
  for (std::size_t page = 0; page < impl_->kept.page_count(); ++page) {
    if (impl_->stale[page] == 0 && snapshot.bodies.Shares(impl_->kept, page)) continue;
    for (std::size_t i = impl_->kept.begin(page); i < impl_->kept.end(page); ++i) {
      apart.push_back(static_cast<int>(i));
    }
  }
  return apart;
}

Status World::Impl::ValidateSnapshot(const WorldSnapshot& snapshot) const {
  if (snapshot.composition != composition.hash || snapshot.bodies.size() != built.moving.size()) {
    return Status::Error("the world cannot go back to tick " + std::to_string(snapshot.tick) +
                         ": since then an edit has changed its bodies");
  }
  if (snapshot.joints_there == JointsHash()) return Status::Ok();
  return Status::Error("the world cannot go back to tick " + std::to_string(snapshot.tick) +
                       ": since then an edit has changed its joints");
}

Status World::Restore(const WorldSnapshot& snapshot) {
  const Status good = impl_->ValidateSnapshot(snapshot);
  if (!good.ok()) return good;
  impl_->Rebuild(snapshot, nullptr);
  return Status::Ok();
}

}  // namespace seam
