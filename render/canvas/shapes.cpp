#include "render/canvas/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/scene/joint_kinds.h"
#include "common/topology/grip.h"
#include "render/canvas/figure.h"

namespace seam {
namespace {

Vec2 Into(const Pose& frame, const Vec2& world) {
  return Rotation<float>(frame.angle).Back(world - frame.position);
}

Pose PoseOf(const Part& part) { return {part.position, part.angle}; }

const Part& PartOf(const Scene& scene, PartId id) {
  return scene.parts.at(static_cast<std::size_t>(id));
}

/// Returns the outline around two discs: half a turn about each end's centre.
std::vector<Vec2> CapsulePoints(const Part& part) {
  constexpr int kSides = 12;
  const Vec2 along = part.points[1] - part.points[0];
  const float heading = std::atan2(along.y(), along.x());
  std::vector<Vec2> points;
  for (int end = 0; end < 2; ++end) {
    for (int i = 0; i <= kSides; ++i) {
      const float turn = kPiFloat * (0.5f + static_cast<float>(end) +
                                     static_cast<float>(i) / static_cast<float>(kSides));
      points.push_back(part.points[static_cast<std::size_t>(end)] +
                       part.radius * Vec2(std::cos(heading + turn), std::sin(heading + turn)));
    }
  }
  return points;
}

Outline OutlineOf(const Part& part, const Pose& root) {
  Outline outline;
  outline.kind = part.kind;
  std::vector<Vec2> local;
  switch (part.kind) {
    case ShapeKind::kBox: {
      const Vec2 h = part.size / 2;
      local = {{-h.x(), -h.y()}, {h.x(), -h.y()}, {h.x(), h.y()}, {-h.x(), h.y()}};
      break;
    }
    case ShapeKind::kCircle:
      local = {{0, 0}, {part.radius, 0}};
      outline.radius = part.radius;
      break;
    case ShapeKind::kCapsule: local = CapsulePoints(part); break;
    case ShapeKind::kPolygon:
    case ShapeKind::kChain:
    case ShapeKind::kSegment: local = part.points; break;
  }
  const Frame2 to_world(PoseOf(part));
  for (const Vec2& p : local) outline.points.push_back(Into(root, to_world(p)));
  return outline;
}

/// Bodies of more parts are drawn by their outer edges: a thousand outlines would be a grey area.
constexpr std::size_t kManyParts = 100;
constexpr float kCovered_m = 0.02f;  ///< greatest gap to a part that covers an edge

/// Returns the corners; a circle as a polygon.
std::vector<Vec2> CornersOf(const Outline& outline) {
  if (outline.kind != ShapeKind::kCircle) return outline.points;
  std::vector<Vec2> corners;
  for (int i = 0; i < 12; ++i) {
    const float turn = kPiFloat / 6 * static_cast<float>(i);
    corners.push_back(outline.points[0] + outline.radius * Vec2(std::cos(turn), std::sin(turn)));
  }
  return corners;
}

float SignedArea(const std::vector<Vec2>& corners) {
  float twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += Cross(a, b);
  }
  return twice / 2;
}

/// True if a point is in a convex shape of counter-clockwise corners.
bool Covers(const std::vector<Vec2>& corners, const Vec2& p) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Vec2 along = b - a, to = p - a;
    if (Cross(along, to) < 0) return false;
  }
  return true;
}

std::vector<std::array<Vec2, 2>> RimOf(const std::vector<Outline>& outlines) {
  std::vector<std::vector<Vec2>> shapes;
  std::vector<std::array<Vec2, 2>> boxes;  // min, max
  for (const Outline& outline : outlines) {
    shapes.push_back(CornersOf(outline));
    if (SignedArea(shapes.back()) < 0) std::reverse(shapes.back().begin(), shapes.back().end());
    Vec2 min = shapes.back()[0], max = min;
    for (const Vec2& p : shapes.back()) {
      min = min.cwiseMin(p);
      max = max.cwiseMax(p);
    }
    boxes.push_back({min, max});
  }
  std::vector<std::array<Vec2, 2>> rim;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    for (std::size_t i = 0; i < shapes[s].size(); ++i) {
      const Vec2 &a = shapes[s][i], &b = shapes[s][(i + 1) % shapes[s].size()];
      const Vec2 along = (b - a).normalized();
      const Vec2 beside = (a + b) / 2 + kCovered_m * Vec2(along.y(), -along.x());
      bool covered = false;
      for (std::size_t o = 0; o < shapes.size() && !covered; ++o) {
        const bool near = (beside.array() >= boxes[o][0].array()).all() &&
                          (beside.array() <= boxes[o][1].array()).all();
        covered = o != s && near && Covers(shapes[o], beside);
      }
      if (!covered) rim.push_back({a, b});
    }
  }
  return rim;
}

/// Returns, by mechanism, the index of its heaviest assembly.
std::vector<int> LeadersOf(const Scene& scene, const Composition& composition) {
  std::vector<int> leaders;
  for (const Mechanism& mechanism : composition.mechanisms) {
    float greatest = -1;
    leaders.push_back(-1);
    for (const int index : mechanism.assemblies) {
      float mass = 0;
      for (const PartId id : composition.assemblies[static_cast<std::size_t>(index)].parts)
        mass += PartMass(PartOf(scene, id));
      if (mass <= greatest) continue;
      greatest = mass;
      leaders.back() = index;
    }
  }
  return leaders;
}

}  // namespace

Frame2::Frame2(const Pose& pose)
    : position(pose.position), cosine(std::cos(pose.angle)), sine(std::sin(pose.angle)) {}

std::vector<BodyShapes> ShapesOf(const Scene& scene, const Composition& composition,
                                 bool anchored) {
  std::vector<BodyShapes> bodies;
  const std::map<PartId, FigurePart> figures = FiguresOf(scene);
  const std::vector<int> leaders = LeadersOf(scene, composition);
  int moved = 0;
  for (std::size_t index = 0; index < composition.assemblies.size(); ++index) {
    const Assembly& assembly = composition.assemblies[index];
    if (assembly.anchored != anchored) continue;
    BodyShapes body;
    body.id = assembly.id;
    if (assembly.mechanism >= 0) {
      body.leads = leaders[static_cast<std::size_t>(assembly.mechanism)] == static_cast<int>(index);
    }
    body.parts = assembly.parts;
    body.start = PoseOf(PartOf(scene, assembly.id));
    if (assembly.kinematic >= 0) body.imposed = moved++;
    for (PartId id : assembly.parts) {
      body.outlines.push_back(OutlineOf(PartOf(scene, id), body.start));
      const auto figure = figures.find(id);
      if (figure != figures.end())
        ShapeFigure(scene, figure->second, body.start, &body.outlines.back());
      const Pose own = PoseOf(PartOf(scene, id));
      body.places.push_back({Into(body.start, own.position), own.angle - body.start.angle});
      const Outline& outline = body.outlines.back();
      for (const Vec2& p : outline.points)
        body.reach = std::max(body.reach, p.norm() + outline.radius);
      for (std::size_t player = 0; player < scene.players.size(); ++player)
        if (scene.players[player].vehicle == id) body.owner_player = static_cast<int>(player);
    }
    body.round = body.outlines.size() == 1 && body.outlines[0].kind == ShapeKind::kCircle &&
                 body.outlines[0].points[0].norm() < 1e-3f;
    const bool lines = std::any_of(body.outlines.begin(), body.outlines.end(),
                                   [](const Outline& o) { return IsLine(o.kind); });
    if (body.outlines.size() > kManyParts && !lines) body.rim = RimOf(body.outlines);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

Pose FrameBehind(const Pose& at, const Pose& place) {
  const Pose frame{at.position, at.angle - place.angle};
  return {at.position - Turned(place.position, frame.angle), frame.angle};
}

DrawnRevision RevisionOf(const Scene& scene, const Composition& composition) {
  return {ShapesOf(scene, composition, false), ShapesOf(scene, composition, true),
          JointsOf(scene, composition), nullptr};
}

namespace {

/// Adds a pulley's rope in three pieces: from a up to its ground anchor, across, and down to b.
void AddPulley(const Joint& pulley, const DrawnJoint& ends, std::vector<DrawnJoint>* joints) {
  DrawnJoint on_a = ends, across, on_b = ends;
  on_a.b = across.a = across.b = on_b.a = -1;
  on_a.rod = across.rod = on_b.rod = true;
  on_a.anchor_b = across.anchor_a = pulley.ground_a;
  on_b.anchor_a = across.anchor_b = pulley.ground_b;
  for (const DrawnJoint& piece : {on_a, across, on_b}) joints->push_back(piece);
}

}  // namespace

std::vector<DrawnJoint> JointsOf(const Scene& scene, const Composition& composition) {
  std::vector<DrawnJoint> joints;
  const auto assembly_of = [&](PartId part) -> const Assembly& {
    const int index = composition.assembly_of_part.at(static_cast<std::size_t>(part));
    return composition.assemblies.at(static_cast<std::size_t>(index));
  };
  for (const Joint& joint : scene.joints) {
    const JointHold hold = HoldOf(joint.kind);
    const bool unseen = hold == JointHold::kBond || hold == JointHold::kPose ||
                        hold == JointHold::kImposed || hold == JointHold::kCoupled;
    if (joint.gone || unseen) continue;
    const Assembly& a = assembly_of(joint.a);
    const Assembly& b = assembly_of(joint.b);
    DrawnJoint drawn;
    drawn.a = a.id;
    drawn.b = b.id;
    drawn.a_anchored = a.anchored;
    drawn.b_anchored = b.anchored;
    drawn.anchor_a = Into(PoseOf(PartOf(scene, a.id)), joint.anchor_a);
    drawn.anchor_b = Into(PoseOf(PartOf(scene, b.id)), joint.anchor_b);
    drawn.rod = hold == JointHold::kLine;
    drawn.grip = IsGrip(joint);
    if (hold == JointHold::kPulley) {
      AddPulley(joint, drawn, &joints);
      continue;
    }
    if (hold == JointHold::kAxis) {  // the sliding body carries the pin
      std::swap(drawn.a, drawn.b);
      std::swap(drawn.anchor_a, drawn.anchor_b);
      std::swap(drawn.a_anchored, drawn.b_anchored);
    }
    joints.push_back(drawn);
  }
  return joints;
}

}  // namespace seam
