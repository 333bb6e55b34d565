/// World: whether something anchored lies between two places.

#include "common/physics/world_impl.h"

namespace seam {
namespace {

/// Whether a joint keeps two bodies from colliding.
bool Tied(const b2Body& body, const b2Body& other) {
  for (const b2JointEdge* edge = body.GetJointList(); edge != nullptr; edge = edge->next) {
    if (edge->other == &other && !edge->joint->GetCollideConnected()) return true;
  }
  return false;
}

/// The nearest anchored fixture that collides with one of the body's.
class FirstAnchored : public b2RayCastCallback {
 public:
  explicit FirstAnchored(const b2Body& body) : body_(body) {}

  float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float fraction) override {
    const b2Body& other = *fixture->GetBody();
    const bool solid = other.GetType() == b2_staticBody && !fixture->IsSensor();
    if (!solid || !Collides(*fixture) || Tied(body_, other)) return -1;
    share = fraction;
    return fraction;
  }

  float share = 1;

 private:
  bool Collides(const b2Fixture& other) const {
    const b2Filter& theirs = other.GetFilterData();
    for (const b2Fixture* own = body_.GetFixtureList(); own != nullptr; own = own->GetNext()) {
      const b2Filter& ours = own->GetFilterData();
      if (own->IsSensor()) continue;
      if (ours.groupIndex == theirs.groupIndex && ours.groupIndex != 0) {
        if (ours.groupIndex > 0) return true;
        continue;
      }
      if ((ours.maskBits & theirs.categoryBits) != 0 &&
          (ours.categoryBits & theirs.maskBits) != 0) {
        return true;
      }
    }
    return false;
  }

  const b2Body& body_;
};

}  // namespace

float World::FreeWay(int body, const Vec2& from, const Vec2& to) const {
  const b2Vec2 begin = ToB2(from), end = ToB2(to);
  if ((end - begin).LengthSquared() <= 0) return 1;
  FirstAnchored first(*impl_->moving(body).body);
  impl_->world->RayCast(&first, begin, end);
  return first.share;
}

}  // namespace seam
