#include "common/physics/world_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "common/physics/outline/outline_contacts.h"
#include "common/physics/stage.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace {

/// Returns the indices of a contact's bodies, the lower first; -1: anchored.
std::pair<int, int> PairOf(const b2Contact* contact) {
  const int a = IndexOf(const_cast<b2Fixture*>(contact->GetFixtureA())->GetBody());
  const int b = IndexOf(const_cast<b2Fixture*>(contact->GetFixtureB())->GetBody());
  return {std::min(a, b), std::max(a, b)};
}

bool Touching(const b2Contact* contact) {
  return contact->IsTouching() && contact->GetManifold()->pointCount > 0;
}

/// A rope this much shorter than its maximal length still counts as taut, m.
constexpr float kTaut = 0.01f;

/// Keeps at most two directions of each body, the first of those that are nearly parallel.
std::vector<BlockedDirection> Distinct(std::vector<BlockedDirection> all) {
  std::stable_sort(
      all.begin(), all.end(),
      [](const BlockedDirection& x, const BlockedDirection& y) { return x.body < y.body; });
  std::vector<BlockedDirection> out;
  for (const BlockedDirection& found : all) {
    std::size_t known = 0;
    bool same = false;
    for (auto it = out.rbegin(); it != out.rend() && it->body == found.body; ++it, ++known) {
      same = same || std::fabs(it->normal.dot(found.normal)) > kSameDirection;
    }
    if (!same && known < 2) out.push_back(found);
  }
  return out;
}

}  // namespace

void ImpulseMeter::PreSolve(b2Contact* contact, const b2Manifold* old) {
  if (outlines_ != nullptr) outlines_->Correct(contact, *old);
}

void ImpulseMeter::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  Felt felt;
  for (int i = 0; i < impulse->count; ++i) felt.impulse += impulse->normalImpulses[i];
  if (felt.impulse <= least_) return;  // most contacts end here, without access to their bodies
  // Anchored bodies have mass 0 here.
  const float mass_a = contact->GetFixtureA()->GetBody()->GetMass();
  const float mass_b = contact->GetFixtureB()->GetBody()->GetMass();
  const float lighter = mass_a <= 0 || (mass_b > 0 && mass_b < mass_a) ? mass_b : mass_a;
  if (felt.impulse <= counts_from_ * lighter) return;
  std::tie(felt.body_a, felt.body_b) = PairOf(contact);
  b2WorldManifold manifold;
  contact->GetWorldManifold(&manifold);
  felt.point = FromB2(manifold.points[0]);
  felt_.push_back(felt);
}

std::vector<Impact> ImpulseMeter::Impacts(const std::vector<MovingBody>& moving) {
  // Stable: sums in the order of solving, which is the same everywhere.
  std::stable_sort(felt_.begin(), felt_.end(), [](const Felt& x, const Felt& y) {
    return std::tie(x.body_a, x.body_b) < std::tie(y.body_a, y.body_b);
  });
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i < felt_.size();) {
    Felt sum = felt_[i];
    float strongest = sum.impulse;
    for (++i; i < felt_.size() && felt_[i].body_a == sum.body_a && felt_[i].body_b == sum.body_b;
         ++i) {
      sum.impulse += felt_[i].impulse;
      if (felt_[i].impulse > strongest) {
        strongest = felt_[i].impulse;
        sum.point = felt_[i].point;
      }
    }
    float dv = 0;
    for (const int body : {sum.body_a, sum.body_b}) {
      if (body < 0) continue;
      dv = std::max(dv, sum.impulse / moving[static_cast<std::size_t>(body)].mass.mass);
    }
    if (dv > kImpactRecordMin) impacts.push_back({sum.body_a, sum.body_b, sum.point, dv});
  }
  return impacts;
}

std::vector<Touch> FindTouches(const b2World& world) {
  std::vector<std::pair<int, int>> pairs;
  for (const b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    const std::pair<int, int> pair = PairOf(c);
    if (Touching(c) && pair.first >= 0) pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Touch> touches;
  for (const auto& [a, b] : pairs) touches.push_back({a, b});
  return touches;
}

std::vector<PartTouch> FindPartTouches(const b2World& world, const Scene& scene,
                                       const BuiltScene& built) {
  const auto part_of = [&](const b2Contact* contact, const b2Fixture* fixture) {
    const auto lowest = static_cast<PartId>(PartOf(fixture));
    const auto merged = built.merged.find(lowest);
    const bool still = fixture->GetBody()->GetType() == b2_staticBody;
    if (merged == built.merged.end() || !still) return lowest;
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    return NearestPart(scene, merged->second, FromB2(manifold.points[0]).cast<double>());
  };
  std::vector<PartTouch> touches;
  for (const b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    if (!Touching(c)) continue;
    const auto a = PartOf(c->GetFixtureA()), b = PartOf(c->GetFixtureB());
    if (a >= kStageFixture || b >= kStageFixture || a == b) continue;
    const PartId one = part_of(c, c->GetFixtureA()), other = part_of(c, c->GetFixtureB());
    touches.push_back({std::min(one, other), std::max(one, other)});
  }
  std::sort(touches.begin(), touches.end());
  const auto same = [](const PartTouch& x, const PartTouch& y) { return !(x < y) && !(y < x); };
  touches.erase(std::unique(touches.begin(), touches.end(), same), touches.end());
  return touches;
}

std::vector<BlockedDirection> FindBlockedDirections(const b2World& world,
                                                    const std::vector<b2DistanceJoint*>& tethers) {
  std::vector<BlockedDirection> blocked_directions;
  for (const b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    const std::pair<int, int> pair = PairOf(c);
    if (!Touching(c) || pair.second < 0) continue;
    b2WorldManifold manifold;
    c->GetWorldManifold(&manifold);
    for (const int body : {pair.first, pair.second}) {
      if (body >= 0) blocked_directions.push_back({body, FromB2(manifold.normal)});
    }
  }
  for (b2DistanceJoint* tether : tethers) {
    const Vec2 along = FromB2(tether->GetAnchorB() - tether->GetAnchorA());
    const float length = along.norm();
    const bool slack =
        tether->GetMinLength() < tether->GetMaxLength() && length < tether->GetMaxLength() - kTaut;
    if (length <= 0 || slack) continue;
    const int body = std::max(IndexOf(tether->GetBodyA()), IndexOf(tether->GetBodyB()));
    blocked_directions.push_back({body, along / length});
  }
  return Distinct(std::move(blocked_directions));
}

}  // namespace seam
