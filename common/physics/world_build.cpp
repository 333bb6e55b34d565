#include "common/physics/world_build.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/physics/anchored/anchored_bodies.h"
#include "common/physics/faces.h"
#include "common/physics/world_couplings.h"
#include "common/physics/world_shapes.h"
#include "common/scene/joint_kinds.h"

namespace seam {
namespace {

void AddFace(const Face& face, const Part& frame, float skin, bool guarded, b2Body* body,
             std::map<PartId, std::vector<PartId>>* merged) {
  AddFixture(face.shape, frame, skin, guarded, body);
  if (face.parts.size() > 1) (*merged)[face.shape.id] = face.parts;
}

/// `frame`: a part with the body's pose.
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
    AddFace(face, frame, scene.solver.skin, guarded, body, merged);
  }
}

/// `at`: its pose; nullptr: the scene's. `ready`: the body's cached fixtures, or nullptr.
b2Body* AddBody(const Scene& scene, const Assembly& assembly, const BodyState* at, bool enabled,
                b2World* world, std::map<PartId, std::vector<PartId>>* merged,
                ReadyFixtures* ready) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  b2BodyDef def;
  def.type = !assembly.anchored        ? b2_dynamicBody
             : assembly.kinematic >= 0 ? b2_kinematicBody
                                       : b2_staticBody;
  def.position = ToB2(at != nullptr ? at->position : root.position);
  def.angle = at != nullptr ? at->angle : root.angle;
  def.enabled = enabled;
  for (const PartId id : assembly.parts) {
    def.bullet = def.bullet || scene.parts[static_cast<std::size_t>(id)].bullet;
  }
  b2Body* body = world->CreateBody(&def);
  if (ready != nullptr && ready->has()) {
    ready->Give(body);
    return body;
  }
  AddShapes(scene, assembly, root, assembly.anchored || def.bullet, body, merged);
  if (ready != nullptr) ready->Take(body);
  return body;
}

/// `faces`: shapes of this and other assemblies on the same body.
b2Body* AddToShared(const Scene& scene, const Assembly& assembly, const std::vector<Face>& faces,
                    AnchoredBodies* shared, std::map<PartId, std::vector<PartId>>* merged) {
  const AnchoredBodies::Body& its = shared->For(scene.parts[static_cast<std::size_t>(assembly.id)]);
  for (const Face& face : faces) {
    AddFace(face, its.frame, scene.solver.skin, true, its.body, merged);
  }
  return its.body;
}

b2MassData MassDataOf(const Scene& scene, const Assembly& assembly) {
  const MassProperties own = AssemblyProperties(scene, assembly);
  b2MassData data;
  data.mass = static_cast<float>(own.mass);
  data.center = ToB2(own.centre.cast<float>());
  data.I = static_cast<float>(own.inertia + own.mass * own.centre.dot(own.centre));
  // Box2D subtracts this again and asserts a positive rest. The rest is positive: the root is the
  // heaviest of at most 65 535 parts, so its distance to the centre is part of the inertia.
  SEAM_ASSERT(own.inertia > kInertiaLeft / 10 * own.mass * own.centre.dot(own.centre));
  return data;
}

/// Returns nullptr if one of the coupled joints is not made, or turns a body that does not move:
/// the engine looks for a gear only at the second bodies of its two joints.
b2Joint* AddGear(const Joint& gear, b2Body* a, b2Body* b, b2World* world, const BuiltScene& built) {
  b2Joint* first = built.joints[static_cast<std::size_t>(gear.coupled[0])];
  b2Joint* second = built.joints[static_cast<std::size_t>(gear.coupled[1])];
  if (first == nullptr || second == nullptr || IndexOf(a) < 0 || IndexOf(b) < 0) return nullptr;
  return MakeGear(gear, first, second, world);
}

/// Returns nullptr if the parts are one body, a body is aside, or both bodies are anchored or
/// kinematic.
b2Joint* AddJoint(const Scene& scene, int index, b2Body* a, b2Body* b, b2World* world,
                  BuiltScene* built) {
  const Joint& joint = scene.joints[static_cast<std::size_t>(index)];
  if (a == b || (IndexOf(a) < 0 && IndexOf(b) < 0)) return nullptr;  // nothing to hold
  if (IsAside(*a) || IsAside(*b)) return nullptr;
  if (IsRigid(joint, scene.solver)) return nullptr;
  if (HoldOf(joint.kind) == JointHold::kCoupled) return AddGear(joint, a, b, world, *built);
  b2Joint* made = MakeJoint(joint, a, b, world);
  if (HasMotor(joint)) built->motors.push_back(MotorOf(joint, made, index));
  const bool anchored = IndexOf(a) < 0 || IndexOf(b) < 0;
  const bool line = HoldOf(joint.kind) == JointHold::kLine;
  if (line && joint.frequency_hz <= 0 && anchored) {
    built->tethers.push_back(static_cast<b2DistanceJoint*>(made));
  }
  return made;
}

/// Returns the body in `aside`; makes it if it is missing.
b2Body* BodyAside(const Scene& scene, const Assembly& assembly, std::size_t index,
                  BuildMemory* memory) {
  b2Body*& body = memory->bodies[index];
  std::map<PartId, std::vector<PartId>> merged;  // unused: the body has no contacts
  if (body == nullptr) {
    body = AddBody(scene, assembly, nullptr, false, &memory->aside, &merged, nullptr);
  }
  return body;
}

/// Makes a scene's bodies and joints, in order.
class Builder {
 public:
  Builder(const Scene& scene, const Composition& composition, b2World* world, BuildMemory* memory,
          BuiltScene* built)
      : scene_(scene),
        composition_(composition),
        world_(world),
        memory_(*memory),
        built_(*built),
        shared_(world) {}

  void AddAnchored(int assembly) {
    const auto a = static_cast<std::size_t>(assembly);
    const Assembly& of = composition_.assemblies[a];
    if (!memory_.share[a]) {
      built_.bodies[a] = AddBody(scene_, of, nullptr, true, world_, &built_.merged, nullptr);
      if (memory_.dense[a]) shared_.MarkDense(built_.bodies[a]);
      return;
    }
    built_.bodies[a] = AddToShared(scene_, of, memory_.shared[a], &shared_, &built_.merged);
  }

  /// Makes the body in the world, at pose `at` if that is not nullptr; or, if it goes there, in
  /// `aside`, unless it is there already.
  void AddMoving(int body, const BodyState* at) {
    const auto i = static_cast<std::size_t>(body);
    const auto a = static_cast<std::size_t>(memory_.assembly_of[i]);
    const Assembly& of = composition_.assemblies[a];
    const bool aside = memory_.goes_aside[i] != 0;
    const bool kept = aside && memory_.bodies[i] != nullptr;
    b2Body* made = aside ? BodyAside(scene_, of, i, &memory_)
                         : AddBody(scene_, of, at, true, world_, &built_.merged, &memory_.ready[i]);
    built_.bodies[a] = built_.moving[i].body = made;
    if (!aside) memory_.made.push_back(body);
    if (kept) return;  // keeps its state
    made->GetUserData().pointer = i + 1;
    made->SetMassData(&memory_.mass[i]);
    made->SetLinearDamping(memory_.motion[i].linear_damping);
    made->SetAngularDamping(memory_.motion[i].angular_damping);
    made->SetGravityScale(memory_.motion[i].gravity_scale);
    const Part& root = scene_.parts[static_cast<std::size_t>(of.id)];
    made->SetLinearVelocity(ToB2(root.velocity));
    made->SetAngularVelocity(root.spin);
  }

  void AddJoint(int joint) {
    const Joint& j = scene_.joints[static_cast<std::size_t>(joint)];
    b2Joint* made = seam::AddJoint(scene_, joint, BodyOf(j.a), BodyOf(j.b), world_, &built_);
    built_.joints[static_cast<std::size_t>(joint)] = made;
    if (made != nullptr) memory_.joints.push_back(joint);
  }

  /// Returns the indices of the joint's moving bodies.
  std::vector<int> MovingOf(int joint) const {
    const Joint& j = scene_.joints[static_cast<std::size_t>(joint)];
    std::vector<int> bodies;
    for (const PartId part : {j.a, j.b}) {
      const int body = IndexOf(BodyOf(part));
      if (body >= 0 && (bodies.empty() || bodies.front() != body)) bodies.push_back(body);
    }
    return bodies;
  }

  void Drive() {
    for (Motor& motor : built_.motors) motor.Drive(motor.player < 0 ? 1.0f : 0.0f);
  }

 private:
  b2Body* BodyOf(PartId part) const {
    const int assembly = composition_.assembly_of_part[static_cast<std::size_t>(part)];
    return built_.bodies[static_cast<std::size_t>(assembly)];
  }

  const Scene& scene_;
  const Composition& composition_;
  b2World* world_;
  BuildMemory& memory_;
  BuiltScene& built_;
  AnchoredBodies shared_;
};

/// Resizes the memory to the number of bodies, and drops bodies of `aside` that do not
/// belong there any more.
void Arrange(std::size_t bodies, BuildMemory* memory) {
  memory->bodies.resize(bodies, nullptr);
  memory->goes_aside.resize(bodies, 0);
  for (std::size_t i = 0; i < bodies; ++i) {
    if (memory->bodies[i] == nullptr || memory->goes_aside[i] != 0) continue;
    memory->aside.DestroyBody(memory->bodies[i]);
    memory->bodies[i] = nullptr;
  }
}

}  // namespace

void BuildMemory::Clear(std::uint64_t hash) {
  composition = hash;
  mass.clear();
  motion.clear();
  for (b2Body* body : bodies) {
    if (body != nullptr) aside.DestroyBody(body);
  }
  bodies.clear();
  goes_aside.clear();
  ready.clear();
  anchored.clear();
  assembly_of.clear();
  joints_of.clear();
  made.clear();
  joints.clear();
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
    memory->dense = DenseAnchored(scene, composition);
    memory->share = ShareBodies(scene, composition, memory->dense);
    memory->shared = SharedFaces(scene, composition, memory->share);
    memory->share_revision = memory->revision;
  }
  memory->anchored.clear();
  memory->assembly_of.clear();
  memory->joints_of.assign(memory->bodies.size(), {});
  memory->ready.assign(memory->bodies.size(), {});
  memory->made.clear();
  memory->joints.clear();
  built.bodies.resize(composition.assemblies.size(), nullptr);
  built.moving.reserve(memory->bodies.size());
  built.joints.resize(scene.joints.size(), nullptr);
  Builder builder(scene, composition, world, memory, &built);
  for (std::size_t a = 0; a < composition.assemblies.size(); ++a) {
    const Assembly& assembly = composition.assemblies[a];
    if (assembly.anchored) {
      memory->anchored.push_back(static_cast<int>(a));
      builder.AddAnchored(static_cast<int>(a));
      continue;
    }
    const std::size_t index = built.moving.size();
    if (memory->mass.size() == index) {
      memory->mass.push_back(MassDataOf(scene, assembly));
      memory->motion.push_back(AssemblyMotion(scene, assembly));
    }
    memory->assembly_of.push_back(static_cast<int>(a));
    built.moving.push_back({nullptr, assembly.id, assembly.mechanism, memory->mass[index]});
    builder.AddMoving(static_cast<int>(index), nullptr);
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    if (scene.joints[j].gone) continue;
    builder.AddJoint(static_cast<int>(j));
    for (const int body : builder.MovingOf(static_cast<int>(j))) {
      memory->joints_of[static_cast<std::size_t>(body)].push_back(static_cast<int>(j));
    }
  }
  builder.Drive();
  return built;
}

void BuildPresent(const Scene& scene, const Composition& composition, const Present& present,
                  b2World* world, BuildMemory* memory, BuiltScene* built) {
  for (const int body : present.crossed) {
    const auto i = static_cast<std::size_t>(body);
    if (memory->goes_aside[i] != 0 || memory->bodies[i] == nullptr) continue;
    memory->aside.DestroyBody(memory->bodies[i]);
    memory->bodies[i] = nullptr;
  }
  for (const int joint : memory->joints) built->joints[static_cast<std::size_t>(joint)] = nullptr;
  memory->made.clear();
  memory->joints.clear();
  built->motors.clear();
  built->tethers.clear();
  Builder builder(scene, composition, world, memory, built);
  auto anchored = memory->anchored.begin();
  const auto add_anchored_before = [&](int assembly) {
    for (; anchored != memory->anchored.end() && *anchored < assembly; ++anchored) {
      builder.AddAnchored(*anchored);
    }
  };
  std::vector<int> joints;
  for (const int body : present.bodies) {
    const auto i = static_cast<std::size_t>(body);
    add_anchored_before(memory->assembly_of[i]);
    const BodyState at = present.at(body);
    // Bodies with joints start where the scene has the joints' ends.
    builder.AddMoving(body, memory->joints_of[i].empty() ? &at : nullptr);
    joints.insert(joints.end(), memory->joints_of[i].begin(), memory->joints_of[i].end());
  }
  add_anchored_before(static_cast<int>(composition.assemblies.size()));
  for (const int body : present.crossed) {
    const bool goes = memory->goes_aside[static_cast<std::size_t>(body)] != 0;
    if (goes) builder.AddMoving(body, nullptr);
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  for (const int joint : joints) builder.AddJoint(joint);
  builder.Drive();
}

BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world) {
  BuildMemory nothing;
  return BuildScene(scene, composition, world, &nothing);
}

}  // namespace seam
