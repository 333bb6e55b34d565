#include "common/physics/world_build.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/physics/anchored_bodies.h"
#include "common/physics/faces.h"
#include "common/physics/world_couplings.h"
#include "common/physics/world_shapes.h"
#include "common/scene/joint_kinds.h"

namespace seam {
namespace {

/// `frame`: a part that lies as the body does.
void AddShapes(const Scene& scene, const Assembly& assembly, const Part& frame, bool guarded,
               b2Body* body, std::map<PartId, std::vector<PartId>>* merged) {
  if (assembly.parts.size() < kFacesFrom) {  // without copies of its parts
    for (const PartId id : assembly.parts) {
      AddFixture(scene.parts[static_cast<std::size_t>(id)], frame, scene.solver.skin, guarded,
                 body);
    }
    return;
  }
  for (const Face& face : FacesOf(scene, assembly)) {
    AddFixture(face.shape, frame, scene.solver.skin, guarded, body);
    if (face.parts.size() > 1) (*merged)[face.shape.id] = face.parts;
  }
}

b2Body* AddBody(const Scene& scene, const Assembly& assembly, bool enabled, b2World* world,
                std::map<PartId, std::vector<PartId>>* merged) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  b2BodyDef def;
  def.type = !assembly.anchored        ? b2_dynamicBody
             : assembly.kinematic >= 0 ? b2_kinematicBody
                                       : b2_staticBody;
  def.position = ToB2(root.position);
  def.angle = root.angle;
  def.enabled = enabled;
  for (const PartId id : assembly.parts) {
    def.bullet = def.bullet || scene.parts[static_cast<std::size_t>(id)].bullet;
  }
  b2Body* body = world->CreateBody(&def);
  AddShapes(scene, assembly, root, assembly.anchored || def.bullet, body, merged);
  return body;
}

b2Body* AddToShared(const Scene& scene, const Assembly& assembly, AnchoredBodies* shared,
                    std::map<PartId, std::vector<PartId>>* merged) {
  const AnchoredBodies::Body& its = shared->For(scene.parts[static_cast<std::size_t>(assembly.id)]);
  AddShapes(scene, assembly, its.frame, true, its.body, merged);
  return its.body;
}

b2MassData MassDataOf(const Scene& scene, const Assembly& assembly) {
  const MassProperties own = AssemblyProperties(scene, assembly);
  b2MassData data;
  data.mass = static_cast<float>(own.mass);
  data.center = ToB2(own.centre.cast<float>());
  data.I = static_cast<float>(own.inertia + own.mass * own.centre.dot(own.centre));
  // Box2D subtracts again and asserts that something is left. Something is: the root is the
  // heaviest of at most 65 535 parts, so its distance to the centre is part of the inertia.
  SEAM_ASSERT(own.inertia > 1e-5 * own.mass * own.centre.dot(own.centre));
  return data;
}

/// nullptr: one of its joints is not there, or turns something that does not move: the engine
/// would not find the gear, which it looks for only at the second bodies of the two joints.
b2Joint* AddGear(const Joint& gear, b2Body* a, b2Body* b, b2World* world, const BuiltScene& built) {
  b2Joint* first = built.joints[static_cast<std::size_t>(gear.coupled[0])];
  b2Joint* second = built.joints[static_cast<std::size_t>(gear.coupled[1])];
  if (first == nullptr || second == nullptr || IndexOf(a) < 0 || IndexOf(b) < 0) return nullptr;
  return MakeGear(gear, first, second, world);
}

/// nullptr: its parts are one body, or one is moved by the tick alone.
b2Joint* AddJoint(const Scene& scene, const Joint& joint, b2Body* a, b2Body* b, b2World* world,
                  BuiltScene* built) {
  if (a == b || (IndexOf(a) < 0 && IndexOf(b) < 0)) return nullptr;  // nothing to hold
  if (IsAside(*a) || IsAside(*b)) return nullptr;
  if (IsRigid(joint, scene.solver)) return nullptr;
  if (HoldOf(joint.kind) == JointHold::kCoupled) return AddGear(joint, a, b, world, *built);
  b2Joint* made = MakeJoint(joint, a, b, world);
  if (HasMotor(joint)) {
    built->motors.push_back(MotorOf(joint, made, static_cast<int>(built->joints.size())));
  }
  const bool anchored = IndexOf(a) < 0 || IndexOf(b) < 0;
  const bool line = HoldOf(joint.kind) == JointHold::kLine;
  if (line && joint.frequency_hz <= 0 && anchored) {
    built->tethers.push_back(static_cast<b2DistanceJoint*>(made));
  }
  return made;
}

/// The body aside; it is made if it is not there.
b2Body* BodyAside(const Scene& scene, const Assembly& assembly, std::size_t index,
                  BuildMemory* memory) {
  b2Body*& body = memory->bodies[index];
  std::map<PartId, std::vector<PartId>> merged;  // it touches nothing
  if (body == nullptr) body = AddBody(scene, assembly, false, &memory->aside, &merged);
  return body;
}

/// Makes as much room in the memory as there are bodies, and takes back those that are absent no
/// more.
void Arrange(std::size_t bodies, BuildMemory* memory) {
  memory->bodies.resize(bodies, nullptr);
  memory->absent.resize(bodies, 0);
  for (std::size_t i = 0; i < bodies; ++i) {
    if (memory->bodies[i] == nullptr || memory->absent[i] != 0) continue;
    memory->aside.DestroyBody(memory->bodies[i]);
    memory->bodies[i] = nullptr;
  }
}

}  // namespace

void BuildMemory::Clear(std::uint64_t hash) {
  composition = hash;
  mass.clear();
  for (b2Body* body : bodies) {
    if (body != nullptr) aside.DestroyBody(body);
  }
  bodies.clear();
  absent.clear();
}

int IndexOf(b2Body* body) { return static_cast<int>(body->GetUserData().pointer) - 1; }

BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world,
                      BuildMemory* memory) {
  BuiltScene built;
  const auto moves = [](const Assembly& a) { return !a.anchored; };
  Arrange(static_cast<std::size_t>(
              std::count_if(composition.assemblies.begin(), composition.assemblies.end(), moves)),
          memory);
  if (memory->share_revision != memory->revision) {
    memory->share = ShareBodies(scene, composition);
    memory->share_revision = memory->revision;
  }
  const std::vector<bool>& share = memory->share;
  built.bodies.reserve(composition.assemblies.size());
  built.moving.reserve(memory->bodies.size());
  built.joints.reserve(scene.joints.size());
  AnchoredBodies shared(world);
  for (const Assembly& assembly : composition.assemblies) {
    const std::size_t index = built.moving.size();
    const bool absent = !assembly.anchored && memory->absent[index] != 0;
    const bool kept = absent && memory->bodies[index] != nullptr;
    b2Body* body = share[built.bodies.size()] ? AddToShared(scene, assembly, &shared, &built.merged)
                   : absent                   ? BodyAside(scene, assembly, index, memory)
                            : AddBody(scene, assembly, true, world, &built.merged);
    built.bodies.push_back(body);
    if (assembly.anchored) continue;
    if (memory->mass.size() == index) memory->mass.push_back(MassDataOf(scene, assembly));
    const b2MassData& mass = memory->mass[index];
    built.moving.push_back({body, assembly.id, assembly.mechanism, mass});
    if (kept) continue;  // as it was left
    body->GetUserData().pointer = built.moving.size();
    body->SetMassData(&mass);
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    body->SetLinearVelocity(ToB2(root.velocity));
    body->SetAngularVelocity(root.spin);
  }
  const auto body_of = [&](PartId part) {
    const int assembly = composition.assembly_of_part[static_cast<std::size_t>(part)];
    return built.bodies[static_cast<std::size_t>(assembly)];
  };
  for (const Joint& joint : scene.joints) {
    if (joint.gone) {
      built.joints.push_back(nullptr);
      continue;
    }
    built.joints.push_back(
        AddJoint(scene, joint, body_of(joint.a), body_of(joint.b), world, &built));
  }
  for (Motor& motor : built.motors) motor.Drive(motor.player < 0 ? 1.0f : 0.0f);
  return built;
}

BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world) {
  BuildMemory nothing;
  return BuildScene(scene, composition, world, &nothing);
}

}  // namespace seam
