#pragma once
/// Puts a scene into a Box2D world: one body per assembly, in the order of their ids (anchored
/// assemblies share a few bodies where there are many), then the joints in the scene's order. The
/// same scene gives the same bodies in the same order everywhere.

#include <box2d/box2d.h>

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "common/physics/faces.h"
#include "common/physics/world_joints.h"
#include "common/physics/world_shapes.h"
#include "common/scene/assembly.h"
#include "common/scene/mass.h"
#include "common/scene/motion/part_motion.h"
#include "common/scene/scene.h"

namespace seam {

inline b2Vec2 ToB2(const Vec2& v) { return b2Vec2(v.x(), v.y()); }
inline Vec2 FromB2(const b2Vec2& v) { return Vec2(v.x, v.y); }

/// A moving assembly in Box2D.
struct MovingBody {
  b2Body* body = nullptr;
  PartId id = 0;  ///< assembly
  int mechanism = 0;
  b2MassData mass{};  ///< about the body's origin
};

struct BuiltScene {
  /// By index into Composition::assemblies. Anchored ones may share one (anchored_bodies.h).
  std::vector<b2Body*> bodies;
  std::vector<MovingBody> moving;  ///< ascending by id
  std::vector<b2Joint*> joints;    ///< by index into Scene::joints; nullptr: not made
  std::vector<Motor> motors;
  std::vector<b2DistanceJoint*> tethers;  ///< rigid distance joints and ropes to something anchored
  /// Parts that collide as one shape, by the lowest of them, which numbers the shape.
  std::map<PartId, std::vector<PartId>> merged;
};

/// Data reused by successive builds of the same bodies.
struct BuildMemory {
  std::uint64_t composition = 0;          ///< hash of the parts of each body
  std::vector<b2MassData> mass;           ///< by moving body; empty: not known yet
  std::vector<PartMotion> motion;         ///< likewise
  int revision = 0;                       ///< number of edits that the scene has had
  int share_revision = -1;                ///< revision of `dense`, `share` and `shared`
  std::vector<bool> dense;                ///< by assembly: see DenseAnchored
  std::vector<bool> share;                ///< by assembly: see ShareBodies
  std::vector<std::vector<Face>> shared;  ///< by assembly: see SharedFaces
  /// A Box2D world that is never stepped, for the bodies that take no part in steps. They are
  /// disabled there; a disabled body in the real world would still cost time in every step.
  b2World aside{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies;  ///< by moving body: in `aside`; nullptr: in the world
  std::vector<char> goes_aside;  ///< by moving body: 1 if it must be in `aside`; empty: none
  /// From the last full build, so that only present bodies are built again.
  std::vector<int> anchored;                ///< assemblies
  std::vector<int> assembly_of;             ///< by moving body
  std::vector<std::vector<int>> joints_of;  ///< by moving body: the scene's joints at it, ascending
  std::vector<int> made;                    ///< moving bodies that are in the world, ascending
  std::vector<int> joints;                  ///< joints that are made, ascending
  std::vector<ReadyFixtures> ready;         ///< by moving body, once it has been made

  /// Drops everything, for other bodies with this composition hash.
  void Clear(std::uint64_t hash);
};

/// True if a body takes no part in steps.
inline bool IsAside(const b2Body& body) { return !body.IsEnabled(); }

/// Index into BuiltScene::moving; -1 for anchored bodies.
int IndexOf(b2Body* body);

/// Builds all bodies and joints. Requires a scene that ParseScene accepted, or one as good. A joint
/// to a body that is aside is not made.
BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world,
                      BuildMemory* memory);
/// The present moving bodies and their states.
struct Present {
  const std::vector<int>& bodies;   ///< ascending
  const std::vector<int>& crossed;  ///< have come or gone since the last build
  std::function<BodyState(int body)> at;
};
/// Builds the same bodies and joints again, for the same revision of the scene. Only present bodies
/// and anchored assemblies are made, in the order of BuildScene. Bodies without joints are made at
/// their current poses, bodies with joints where the scene has them.
void BuildPresent(const Scene& scene, const Composition& composition, const Present& present,
                  b2World* world, BuildMemory* memory, BuiltScene* built);
/// Like BuildScene above, without a memory.
BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world);

}  // namespace seam
