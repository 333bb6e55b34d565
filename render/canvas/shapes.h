#pragma once
/// A scene's parts as drawable outlines, relative to their bodies.

#include <array>
#include <memory>
#include <vector>

#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Position and angle.
struct Pose {
  Vec2 position{0, 0};  ///< m
  float angle = 0;      ///< rad
};

/// Returns the pose of a body by one of its parts: `at`: pose of the part in the world; `place`: in
/// the body's frame.
Pose FrameBehind(const Pose& at, const Pose& place);

/// Transform from a pose's own frame to the world.
struct Frame2 {
  Vec2 position{0, 0};
  float cosine = 1, sine = 0;
  explicit Frame2(const Pose& pose);
  Vec2 operator()(const Vec2& p) const {
    return {position.x() + cosine * p.x() - sine * p.y(),
            position.y() + sine * p.x() + cosine * p.y()};
  }
};

/// The character part of an outline.
struct FigurePart {
  int character = -1;      ///< index into Scene::characters; -1: no character
  int part = 0;            ///< CharacterPart
  bool far_side = false;   ///< a limb on the side of the body turned away from the viewer
  std::vector<Vec2> tone;  ///< m, outline of the darker area (hair, pelvis); empty: none
};

/// The outline of one part, in the frame of its assembly's root part. A character's parts are
/// rounded within their collision shapes.
struct Outline {
  ShapeKind kind = ShapeKind::kBox;
  std::vector<Vec2> points;  ///< m; corners (a capsule's ends have many), or the line's points;
                             ///< circle: centre and a rim point
  float radius = 0;          ///< circle, m
  FigurePart figure;
};

/// Shapes of one assembly.
struct BodyShapes {
  PartId id = 0;
  std::vector<PartId> parts;      ///< ascending
  std::vector<Outline> outlines;  ///< one for each part
  std::vector<Pose> places;       ///< poses of the parts, in the root part's frame
  /// Outer edges of a body of many parts: the edges that no other part covers, two points each, m
  /// in the root's frame. Empty for other bodies.
  std::vector<std::array<Vec2, 2>> rim;
  float reach = 0;        ///< m: greatest distance of a point from the root
  bool round = false;     ///< a circle about its root: its outline does not show its angle
  Pose start;             ///< pose of the root part at tick 0
  int imposed = -1;       ///< kinematic: index into the scene's ImposedMotions; -1: not
  int owner_player = -1;  ///< the player with a part of this body as vehicle, -1: none
  bool leads = true;      ///< moving: the heaviest body of its mechanism (ties: the lowest id)
};

/// A drawn joint; anchors in the frames of the two bodies.
struct DrawnJoint {
  PartId a = 0, b = 0;  ///< assembly ids; -1: a point of the world (a pulley's)
  Vec2 anchor_a{0, 0}, anchor_b{0, 0};
  bool a_anchored = false, b_anchored = false;
  bool rod = false;   ///< distance joint or rope: a line; else a pin at a's anchor
  bool grip = false;  ///< a hand's grip: a ring around the pin
};

/// Shapes of a world's bodies between two edits.
struct DrawnRevision {
  std::vector<BodyShapes> moving, anchored;
  std::vector<DrawnJoint> joints;
  std::shared_ptr<const FeatherStore> bricks;  ///< remaining bricks; nullptr: there are none
};

std::vector<BodyShapes> ShapesOf(const Scene& scene, const Composition& composition, bool anchored);
DrawnRevision RevisionOf(const Scene& scene, const Composition& composition);
/// Returns all joints that hold two bodies at a point, an axis or a length.
std::vector<DrawnJoint> JointsOf(const Scene& scene, const Composition& composition);

}  // namespace seam
