#include "common/physics/anchored/anchored_bodies.h"

#include <cstdint>

#include "common/physics/reveal.h"
#include "common/physics/world_build.h"
#include "common/scene/connectors.h"
#include "common/scene/forces.h"
#include "common/scene/joint_kinds.h"

namespace seam {
namespace {

SEAM_REVEAL(ContactFlags, uint32, b2Contact, m_flags);
/// The engine's own flag: ask the contact filter again at the next step.
constexpr uint32 kFilterAgain = 0x0008;

/// User data of a dense static body; a moving one has its number there.
constexpr std::uintptr_t kDense = ~std::uintptr_t{0};

bool IsDense(b2Body* body) {
  return body->GetType() == b2_staticBody && body->GetUserData().pointer == kDense;
}

/// True if the engine's enlarged box of `other`, within which moves go unnoticed, lies beyond a
/// side of the anchored polygon.
bool IsBeyond(b2Fixture* anchored, b2Fixture* other) {
  const b2Body* body = anchored->GetBody();
  if (!IsDense(anchored->GetBody()) || anchored->GetType() != b2Shape::e_polygon) return false;
  if (other->GetShape()->GetChildCount() != 1) return false;
  const auto& polygon = *static_cast<const b2PolygonShape*>(anchored->GetShape());
  const b2BroadPhase& boxes = body->GetWorld()->GetContactManager().m_broadPhase;
  const b2AABB& box = boxes.GetFatAABB((other->*Member(Proxies()))->proxyId);
  for (int i = 0; i < polygon.m_count; ++i) {
    const b2Vec2 out = body->GetWorldVector(polygon.m_normals[i]);
    const b2Vec2 nearest(out.x > 0 ? box.lowerBound.x : box.upperBound.x,
                         out.y > 0 ? box.lowerBound.y : box.upperBound.y);
    const b2Vec2 apart = nearest - body->GetWorldPoint(polygon.m_vertices[i]);
    if (b2Dot(out, apart) > polygon.m_radius) return true;
  }
  return false;
}

/// Rejects pairs of which only the boxes overlap: a long wall at an angle has a box as large as a
/// city. The engine asks again when the other shape has left its box.
class SidesFilter : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
    return b2ContactFilter::ShouldCollide(a, b) && !IsBeyond(a, b) && !IsBeyond(b, a);
  }
};

b2ContactFilter* Sides() {
  static SidesFilter filter;  // without state
  return &filter;
}

}  // namespace

void DropFarContacts(b2World* world) {
  if (world->GetContactManager().m_contactFilter != Sides()) return;
  for (b2Contact* c = world->GetContactList(); c != nullptr; c = c->GetNext()) {
    if (c->IsTouching()) continue;
    b2Fixture *const a = c->GetFixtureA(), *const b = c->GetFixtureB();
    if (IsBeyond(a, b) || IsBeyond(b, a)) c->*Member(ContactFlags()) |= kFilterAgain;
  }
}

std::vector<bool> ShareBodies(const Scene& scene, const Composition& composition,
                              const std::vector<bool>& dense) {
  std::vector<bool> share = dense;
  const auto keep = [&](PartId part) {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(part)];
    if (index >= 0) share[static_cast<std::size_t>(index)] = false;
  };
  for (const Joint& joint : scene.joints) {
    const bool strong = joint.kind != JointKind::kGlue || joint.strength <= 0;
    if (joint.gone || (IsRigid(joint, scene.solver) && strong)) continue;
    keep(joint.a);
    keep(joint.b);
  }
  for (const Part& part : scene.parts) {
    if (part.gone) continue;
    if (!part.connectors->empty() || part.conveyor->speed != 0) keep(part.id);
  }
  for (const Seat& seat : scene.seats) keep(seat.part);
  for (const Thrust& thrust : scene.thrusts) keep(thrust.part);
  return share;
}

std::vector<std::vector<Face>> SharedFaces(const Scene& scene, const Composition& composition,
                                           const std::vector<bool>& share) {
  std::map<AnchoredSquare, Assembly> together;
  for (std::size_t a = 0; a < share.size(); ++a) {
    if (!share[a]) continue;
    const Assembly& assembly = composition.assemblies[a];
    Assembly& all = together[SquareOf(scene.parts[static_cast<std::size_t>(assembly.id)])];
    all.parts.insert(all.parts.end(), assembly.parts.begin(), assembly.parts.end());
  }
  std::vector<std::vector<Face>> faces(share.size());
  for (const auto& [square, all] : together) {
    for (Face& face : FacesOf(scene, all)) {
      const auto part = static_cast<std::size_t>(face.shape.id);
      const int assembly = composition.assembly_of_part[part];
      faces[static_cast<std::size_t>(assembly)].push_back(std::move(face));
    }
  }
  return faces;
}

void AnchoredBodies::MarkDense(b2Body* body) {
  body->GetUserData().pointer = kDense;
  world_->SetContactFilter(Sides());
}

const AnchoredBodies::Body& AnchoredBodies::For(const Part& root) {
  const AnchoredSquare square = SquareOf(root);
  if (last_ != nullptr && last_->first == square) return last_->second;
  const auto found = bodies_.try_emplace(square).first;
  last_ = &*found;
  Body& body = found->second;
  if (body.body != nullptr) return body;
  const auto middle = [](int of) { return kAnchoredSquare * (static_cast<float>(of) + 0.5f); };
  body.frame.position = {middle(square.column), middle(square.row)};
  b2BodyDef def;
  def.position = ToB2(body.frame.position);
  body.body = world_->CreateBody(&def);
  MarkDense(body.body);
  return body;
}

}  // namespace seam
