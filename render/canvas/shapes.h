#pragma once
/// A scene's parts as outlines that can be drawn, relative to the body they belong to.

#include <array>
#include <memory>
#include <vector>

#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/topology/feather_store.h"

namespace seam {

struct Pose {
  Vec2 position{0, 0};  ///< m
  float angle = 0;      ///< rad
};

/// The pose of a frame in which `place` is at `at`: of a body by one of its parts.
Pose FrameBehind(const Pose& at, const Pose& place);

/// From a pose's own frame to the world.
struct Frame2 {
  Vec2 position{0, 0};
  float cosine = 1, sine = 0;
  explicit Frame2(const Pose& pose);
  Vec2 operator()(const Vec2& p) const {
    return {position.x() + cosine * p.x() - sine * p.y(),
            position.y() + sine * p.x() + cosine * p.y()};
  }
};

/// Which part of which character an outline is.
struct FigurePart {
  int character = -1;      ///< index into Scene::characters; -1: of none
  int part = 0;            ///< CharacterPart
  bool far_side = false;   ///< the limb that the body hides from who looks at the page
  std::vector<Vec2> tone;  ///< m, as the outline: what is darker of it (hair, pelvis), if anything
};

/// One part, in the frame of its assembly's root part. A character's are rounded within the shape
/// that the engine has.
struct Outline {
  ShapeKind kind = ShapeKind::kBox;
  std::vector<Vec2> points;  ///< m; corners (a capsule's ends have many), or the line's points;
                             ///< circle: centre and a rim point
  float radius = 0;          ///< circle, m
  FigurePart figure;
};

/// One assembly.
struct BodyShapes {
  PartId id = 0;
  std::vector<PartId> parts;      ///< ascending
  std::vector<Outline> outlines;  ///< one for each part
  std::vector<Pose> places;       ///< of the parts, in the root part's frame
  /// Of a body of many parts: the edges that no other of its parts covers, two points each, m in
  /// the root's frame. Empty for others.
  std::vector<std::array<Vec2, 2>> rim;
  float reach = 0;        ///< m: nothing of it is further from the root
  bool round = false;     ///< a circle about its root: its outline does not show its angle
  Pose start;             ///< of the root part at tick 0
  int imposed = -1;       ///< anchored, but moved: index into the scene's ImposedMotions
  int owner_player = -1;  ///< the player whose vehicle belongs to it, -1: none
};

/// A joint worth drawing; anchors in the frames of the two bodies.
struct DrawnJoint {
  PartId a = 0, b = 0;  ///< assembly ids; -1: a point of the world (a pulley's)
  Vec2 anchor_a{0, 0}, anchor_b{0, 0};
  bool a_anchored = false, b_anchored = false;
  bool rod = false;   ///< distance joint or rope: a line; else a pin at a's anchor
  bool grip = false;  ///< a hand holds: a ring around the pin
};

/// All that a world's bodies look like as long as none changes.
struct DrawnRevision {
  std::vector<BodyShapes> moving, anchored;
  std::vector<DrawnJoint> joints;
  std::shared_ptr<const FeatherStore> bricks;  ///< those that are left; nullptr: there are none
};

std::vector<BodyShapes> ShapesOf(const Scene& scene, const Composition& composition, bool anchored);
DrawnRevision RevisionOf(const Scene& scene, const Composition& composition);
/// All joints that hold two bodies at a point, an axis or a length.
std::vector<DrawnJoint> JointsOf(const Scene& scene, const Composition& composition);

}  // namespace seam
