#include "common/physics/world_contacts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

/// Returns the parts that number the two shapes, the lower first, in one word.
std::uint64_t ShapesOf(const b2Contact& contact) {
  auto& c = const_cast<b2Contact&>(contact);
  const std::uint64_t a = PartOf(c.GetFixtureA()), b = PartOf(c.GetFixtureB());
  return std::min(a, b) << 32 | std::max(a, b);
}

/// True for shapes of two parts, none of a stage.
bool OfTwoParts(std::uint64_t shapes) {
  const std::uint64_t lower = shapes >> 32, higher = shapes & 0xffffffffu;
  return higher < kStageFixture && lower != higher;
}

/// True if another contact of the same two parts touches.
bool TouchesElsewhere(b2Contact* contact) {
  b2Body* body = contact->GetFixtureA()->GetBody();
  // An anchored body has far more contacts.
  if (body->GetType() != b2_dynamicBody) body = contact->GetFixtureB()->GetBody();
  const std::uint64_t shapes = ShapesOf(*contact);
  for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    if (edge->contact == contact || !Touching(edge->contact)) continue;
    if (ShapesOf(*edge->contact) == shapes) return true;
  }
  return false;
}

/// Returns the part of a touching shape. Of anchored parts merged into one, that at the contact.
PartId TouchedPart(b2Contact& contact, const b2Fixture* fixture, const Scene& scene,
                   const BuiltScene& built) {
  const auto lowest = static_cast<PartId>(PartOf(fixture));
  const auto merged = built.merged.find(lowest);
  const bool still = fixture->GetBody()->GetType() == b2_staticBody;
  if (merged == built.merged.end() || !still) return lowest;
  b2WorldManifold manifold;
  contact.GetWorldManifold(&manifold);
  return NearestPart(scene, merged->second, FromB2(manifold.points[0]).cast<double>());
}

PartTouch TouchOf(b2Contact& contact, const Scene& scene, const BuiltScene& built) {
  const PartId a = TouchedPart(contact, contact.GetFixtureA(), scene, built);
  const PartId b = TouchedPart(contact, contact.GetFixtureB(), scene, built);
  return {std::min(a, b), std::max(a, b)};
}

void KeepEachOnce(std::vector<PartTouch>* touches) {
  std::sort(touches->begin(), touches->end());
  touches->erase(std::unique(touches->begin(), touches->end()), touches->end());
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
  std::vector<PartTouch> touches;
  for (const b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    if (!Touching(c) || !OfTwoParts(ShapesOf(*c))) continue;
    touches.push_back(TouchOf(*const_cast<b2Contact*>(c), scene, built));
  }
  KeepEachOnce(&touches);
  return touches;
}

void TouchLog::BeginTick() { begun_ = std::exchange(next_, {}); }

void TouchLog::BeginSubstep(int substep) {
  substep_ = substep;
  ended_.clear();
}

void TouchLog::EndTick(const b2World& world) {
  substep_ = -1;
  std::vector<PartTouch> now = FindPartTouches(world, scene_, built_);
  // No contact begins where a body slides from one merged part to the next.
  std::set_difference(now.begin(), now.end(), touching_.begin(), touching_.end(),
                      std::back_inserter(begun_));
  KeepEachOnce(&begun_);
  touching_ = std::move(now);
}

void TouchLog::Rebuilt(const b2World& world, std::vector<PartTouch> before) {
  touching_ = std::move(before);
  next_.clear();
  const std::vector<PartTouch> now = FindPartTouches(world, scene_, built_);
  std::set_difference(now.begin(), now.end(), touching_.begin(), touching_.end(),
                      std::back_inserter(next_));
}

void TouchLog::Begin(b2Contact* contact) {
  const std::uint64_t shapes = ShapesOf(*contact);
  if (substep_ < 0 || contact->GetManifold()->pointCount == 0 || !OfTwoParts(shapes)) return;
  // A chain's next segment takes over, or the contact itself was made anew.
  if (ended_.count(shapes) > 0 || TouchesElsewhere(contact)) return;
  const PartTouch touch = TouchOf(*contact, scene_, built_);
  if (substep_ == 0 && std::binary_search(touching_.begin(), touching_.end(), touch)) return;
  begun_.push_back(touch);
}

void TouchLog::End(b2Contact* contact) {
  if (substep_ >= 0) ended_.insert(ShapesOf(*contact));
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
