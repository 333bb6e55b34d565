#pragma once
/// Puts a scene into a Box2D world: one body per assembly, in the order of their ids, but few for
/// the anchored ones of which there are many, then the joints in the scene's order. The same scene
/// gives the same bodies in the same order everywhere.

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
  std::vector<b2Joint*> joints;    ///< by index into Scene::joints; nullptr: one body
  std::vector<Motor> motors;
  std::vector<b2DistanceJoint*> tethers;  ///< no springs, to something anchored
  /// Parts that collide as one shape, by the lowest of them, whose number the shape has.
  std::map<PartId, std::vector<PartId>> merged;
};

/// What builds of the same bodies, one after the other, have in common.
struct BuildMemory {
  std::uint64_t composition = 0;          ///< hash of who was one body with whom
  std::vector<b2MassData> mass;           ///< by moving body; empty: not known yet
  int revision = 0;                       ///< of the scene: edits that it has had
  int share_revision = -1;                ///< of which `share` and `shared` are
  std::vector<bool> share;                ///< by assembly: see ShareBodies
  std::vector<std::vector<Face>> shared;  ///< by assembly: see SharedFaces
  /// An engine that is never stepped, for the bodies that take no part in steps: a body that is
  /// only disabled costs every step time. They lie there disabled.
  b2World aside{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies;  ///< by moving body: in `aside`; nullptr: in the world
  std::vector<char> absent;     ///< by moving body: is to be aside; empty: none
  /// Of the last whole build, so that only what is present is built again.
  std::vector<int> anchored;                ///< assemblies
  std::vector<int> assembly_of;             ///< by moving body
  std::vector<std::vector<int>> joints_of;  ///< by moving body: the scene's joints at it, ascending
  std::vector<int> made;                    ///< moving bodies that are in the world, ascending
  std::vector<int> joints;                  ///< that are made, ascending
  std::vector<ReadyFixtures> ready;         ///< by moving body, as far as it has been made

  /// What was is of other bodies.
  void Clear(std::uint64_t hash);
};

/// Whether a body takes no part in steps.
inline bool IsAside(const b2Body& body) { return !body.IsEnabled(); }

/// Index into BuiltScene::moving; -1 for anchored bodies.
int IndexOf(b2Body* body);

/// Requires a scene that ParseScene accepted, or one as good. A joint to a body that is aside is
/// not made.
BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world,
                      BuildMemory* memory);
/// Who of the moving bodies is there, and where.
struct Present {
  const std::vector<int>& bodies;   ///< ascending
  const std::vector<int>& crossed;  ///< have come or gone since the last build, as absent says
  std::function<BodyState(int body)> at;
};
/// The same bodies and joints again, of the same revision of the scene: only those that are present
/// and of anchored assemblies are made, in the order in which BuildScene would; what has no joints
/// in its place, the others where the scene has them.
void BuildPresent(const Scene& scene, const Composition& composition, const Present& present,
                  b2World* world, BuildMemory* memory, BuiltScene* built);
/// The same as BuildScene, with nothing remembered.
BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world);

}  // namespace seam
