#include "common/stages/character/character_hands.h"

#include "common/base/geometry.h"
#include "common/physics/world_couplings.h"
#include "common/scene/mass.h"
#include "common/stages/contact_force.h"
#include "common/topology/grip.h"

namespace seam {
namespace {

/// m from the fingertip within which a contact counts as the hand's, for 1.8 m.
constexpr float kHandLength = 0.12f;

PartId HandOf(const Character& character, int side) {
  return character.parts[side == 0 ? kLowerArmLeft : kLowerArmRight];
}

}  // namespace

void CharacterHands::Find() {
  for (int side = 0; side < 2; ++side) {
    const PartId hand = HandOf(character_, side);
    const int assembly = world_.composition.assembly_of_part[static_cast<std::size_t>(hand)];
    const std::optional<Vec2> tip = FingertipOf(world_.scene, hand);
    body_[side] = nullptr;
    grip_[side] = -1;
    if (assembly < 0 || !tip || !character_.grip) continue;
    const Assembly& whole = world_.composition.assemblies[static_cast<std::size_t>(assembly)];
    const Part& part = world_.scene.parts[static_cast<std::size_t>(hand)];
    const Part& root = world_.scene.parts[static_cast<std::size_t>(whole.id)];
    b2Body* const body = world_.built.bodies[static_cast<std::size_t>(assembly)];
    if (IsAside(*body)) continue;
    body_[side] = body;
    tip_[side] = ToB2(ToRootFrame(part, root, tip->cast<double>()).cast<float>());
    for (std::size_t j = 0; j < world_.scene.joints.size(); ++j) {
      const Joint& joint = world_.scene.joints[j];
      const bool own = !joint.gone && joint.b == hand && IsGrip(joint);
      if (own && world_.built.joints[j] != nullptr) grip_[side] = static_cast<int>(j);
    }
  }
}

void CharacterHands::Forget() {
  for (int side = 0; side < 2; ++side) {
    body_[side] = nullptr;
    grip_[side] = -1;
  }
}

float CharacterHands::Strength(int side) const {
  return world_.scene.joints[static_cast<std::size_t>(grip_[side])].strength;
}

float CharacterHands::Force(int side) const {
  const auto j = static_cast<std::size_t>(grip_[side]);
  const Solver& solver = world_.scene.solver;
  const auto hz = static_cast<float>(solver.tick_hz * solver.substeps);
  return ForcesOf(world_.built.joints[j], hz).on_b.Length();
}

void CharacterHands::Propose(const float hold[2], std::vector<Edit>* edits) const {
  for (int side = 0; side < 2; ++side) {
    if (!has(side)) continue;
    if (!holds(side)) {
      if (hold[side] > 0) ProposeGrip(side, edits);
    } else if (hold[side] <= 0) {
      edits->emplace_back(BreakEdit{grip_[side]});
    }
  }
}

void CharacterHands::ProposeGrip(int side, std::vector<Edit>* edits) const {
  const b2Vec2 tip = Tip(side);
  float nearest = kHandLength * character_.height / 1.8f;
  BondEdit bond;
  for (b2ContactEdge* edge = body_[side]->GetContactList(); edge != nullptr; edge = edge->next) {
    b2Contact* contact = edge->contact;
    if (!contact->IsTouching() || !contact->IsEnabled()) continue;
    const bool first = contact->GetFixtureA()->GetBody() == body_[side];
    b2Fixture* other = first ? contact->GetFixtureB() : contact->GetFixtureA();
    const std::uint32_t id = PartOf(other);
    if (other->IsSensor() || id >= kStageFixture) continue;
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    for (int i = 0; i < contact->GetManifold()->pointCount; ++i) {
      const float away = (manifold.points[i] - tip).Length();
      if (away >= nearest) continue;
      nearest = away;
      bond.a = PartAt(world_, static_cast<PartId>(id), other->GetBody()->GetLocalPoint(tip));
    }
  }
  if (bond.a < 0) return;
  const auto a = static_cast<std::size_t>(bond.a);
  const auto index = static_cast<std::size_t>(world_.composition.assembly_of_part[a]);
  const Part& part = world_.scene.parts[a];
  const Part& root =
      world_.scene.parts[static_cast<std::size_t>(world_.composition.assemblies[index].id)];
  const b2Body& body = *world_.built.bodies[index];
  // An anchored part's body may be shared with other parts, and lie anywhere.
  const bool still = body.GetType() == b2_staticBody;
  const Transform2 whole = still ? Transform2{root.position.cast<double>(), root.angle}
                                 : Transform2{FromB2(body.GetPosition()).cast<double>(),
                                              static_cast<double>(body.GetAngle())};
  const Transform2 pose =
      whole.Then({ToRootFrame(part, root, Eigen::Vector2d(0, 0)),
                  static_cast<double>(part.angle) - static_cast<double>(root.angle)});
  bond.b = HandOf(character_, side);
  bond.position = pose.Inverse()(FromB2(tip).cast<double>()).cast<float>();
  bond.cause = BondCause::kGrip;
  bond.strength = GripStrength(world_.scene, CharacterOfHand(world_.scene, bond.b));
  edits->emplace_back(bond);
}

}  // namespace seam
