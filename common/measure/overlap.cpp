#include "common/measure/overlap.h"

#include <algorithm>
#include <limits>

#include "common/base/check.h"
#include "common/measure/pose.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Returns the corners in the part's own frame, counter-clockwise; for a circle its centre, for a
/// capsule the centres of its ends.
std::vector<Vector2d> Corners(const Part& part) {
  std::vector<Vector2d> corners;
  if (part.kind == ShapeKind::kCircle) return {Vector2d(0, 0)};
  if (part.kind == ShapeKind::kBox) {
    const double x = double{part.size.x()} / 2, y = double{part.size.y()} / 2;
    return {Vector2d(-x, -y), Vector2d(x, -y), Vector2d(x, y), Vector2d(-x, y)};
  }
  for (const Vec2& point : part.points) corners.push_back(point.cast<double>());
  const Vector2d a = corners[1] - corners[0], b = corners.back() - corners[0];
  if (part.kind == ShapeKind::kPolygon && a.x() * b.y() < a.y() * b.x()) {
    std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

std::pair<int, int> Ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

/// All corners in the world, and the bounding box of each solid.
struct OverlapMeter::Placed {
  std::vector<Vector2d> corners;
  std::vector<Vector2d> min, max;  // by solid

  Convex Of(const Solid& solid) const {
    return {&corners[static_cast<std::size_t>(solid.first)], solid.count, solid.radius};
  }
};

OverlapMeter::OverlapMeter(const Scene& scene, const Composition& composition)
    : imposed_(scene, composition) {
  const std::vector<int> moving = MovingIndices(composition);
  for (std::size_t i = 0; i < composition.assemblies.size(); ++i) {
    const Assembly& assembly = composition.assemblies[i];
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    if (!assembly.anchored) ++moving_count_;
    for (const PartId id : assembly.parts) {
      AddPart(scene.parts[static_cast<std::size_t>(id)], root, static_cast<int>(i), moving[i]);
    }
  }
  for (const Joint& joint : scene.joints) {
    if (joint.gone) continue;
    const int a = composition.assembly_of_part[static_cast<std::size_t>(joint.a)];
    const int b = composition.assembly_of_part[static_cast<std::size_t>(joint.b)];
    const bool collide = joint.collide || HoldOf(joint.kind) == JointHold::kImposed;
    if (!collide) joined_.push_back(Ordered(a, b));
  }
  std::sort(joined_.begin(), joined_.end());
}

void OverlapMeter::AddPart(const Part& part, const Part& root, int assembly, int moving) {
  const int imposed = imposed_.IndexOf(assembly);
  if (part.kind == ShapeKind::kChain && (moving >= 0 || imposed >= 0)) return;  // see overlap.h
  std::vector<Vector2d> corners = Corners(part);
  for (Vector2d& corner : corners) {
    corner = ToRootFrame(part, root, corner);
    if (moving < 0 && imposed < 0) corner = RootFrame(root).ToWorld(corner);
  }
  Solid solid;
  solid.part = part.id;
  solid.imposed = imposed;
  solid.assembly = assembly;
  solid.moving = moving;
  solid.filter = part.filter;
  const bool round = part.kind == ShapeKind::kCircle || part.kind == ShapeKind::kCapsule;
  solid.radius = round ? double{part.radius} : 0;
  solid.first = static_cast<int>(corners_.size());
  solid.count = static_cast<int>(corners.size());
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  if (part.kind != ShapeKind::kChain) {
    solids_.push_back(solid);
    return;
  }
  for (const TerrainEdge& edge : TerrainEdges(corners)) {
    solid.edge = static_cast<int>(edges_.size());
    solid.count = 2;
    solids_.push_back(solid);
    edges_.push_back(edge);
    ++solid.first;
  }
}

bool OverlapMeter::MayCollide(const Solid& a, const Solid& b) const {
  if (a.assembly == b.assembly) return false;
  if (!seam::MayCollide(a.filter, b.filter)) return false;
  return !std::binary_search(joined_.begin(), joined_.end(), Ordered(a.assembly, b.assembly));
}

std::vector<std::pair<int, int>> OverlapMeter::NearPairs(const Placed& placed) const {
  // Sweep and prune (Baraff 1992) along the longer side of the moving solids' bounding box.
  Vector2d low = Vector2d::Constant(kFar), high = -low;
  std::vector<int> order;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    order.push_back(static_cast<int>(i));
    if (solids_[i].moving < 0) continue;
    low = low.cwiseMin(placed.min[i]);
    high = high.cwiseMax(placed.max[i]);
  }
  const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
  const auto begin = [&](int i) { return placed.min[static_cast<std::size_t>(i)][axis]; };
  const auto end = [&](int i) { return placed.max[static_cast<std::size_t>(i)][axis]; };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return begin(a) < begin(b); });
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> open[2];  // solids that the sweep is inside: moving, anchored
  const auto meet = [&](int now, std::vector<int>* others) {
    const auto n = static_cast<std::size_t>(now);
    for (std::size_t k = 0; k < others->size();) {
      const int other = (*others)[k];
      if (end(other) < begin(now)) {
        (*others)[k] = others->back();
        others->pop_back();
        continue;
      }
      ++k;
      const auto o = static_cast<std::size_t>(other);
      const bool apart = placed.min[n][1 - axis] > placed.max[o][1 - axis] ||
                         placed.min[o][1 - axis] > placed.max[n][1 - axis];
      if (apart || !MayCollide(solids_[n], solids_[o])) continue;
      const bool moves = solids_[n].moving >= 0;
      pairs.push_back(moves ? std::pair{now, other} : std::pair{other, now});
    }
  };
  for (const int now : order) {
    const bool anchored = solids_[static_cast<std::size_t>(now)].moving < 0;
    meet(now, &open[0]);
    if (!anchored) meet(now, &open[1]);
    open[anchored ? 1 : 0].push_back(now);
  }
  return pairs;
}

double OverlapMeter::Deepest(const std::vector<BodyState>& moving, std::int64_t tick) const {
  for (const BodyState& state : moving) {
    if (!IsFinite(state)) return kFar;
  }
  double deepest = 0;
  ForEachOverlap(moving, tick, [&deepest](PartId, PartId, double depth_m) {
    deepest = std::max(deepest, depth_m);
  });
  return deepest;
}

void OverlapMeter::ForEachOverlap(const std::vector<BodyState>& moving, std::int64_t tick,
                                  const Visit& visit) const {
  SEAM_ASSERT(moving.size() == moving_count_);
  std::vector<RootFrame> poses;
  for (const BodyState& state : moving) poses.emplace_back(state);
  std::vector<RootFrame> imposed;
  for (int i = 0; i < imposed_.count(); ++i) {
    imposed.emplace_back(imposed_.At(i, static_cast<double>(tick)));
  }
  Placed placed{corners_, std::vector<Vector2d>(solids_.size()),
                std::vector<Vector2d>(solids_.size())};
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const Solid& solid = solids_[i];
    const double margin = solid.radius + (solid.edge >= 0 ? kTerrainReach : 0);
    placed.min[i] = Vector2d::Constant(kFar);
    placed.max[i] = -placed.min[i];
    for (int k = solid.first; k < solid.first + solid.count; ++k) {
      Vector2d& corner = placed.corners[static_cast<std::size_t>(k)];
      if (solid.moving >= 0) {
        corner = poses[static_cast<std::size_t>(solid.moving)].ToWorld(corner);
      } else if (solid.imposed >= 0) {
        corner = imposed[static_cast<std::size_t>(solid.imposed)].ToWorld(corner);
      }
      placed.min[i] = placed.min[i].cwiseMin(corner - Vector2d::Constant(margin));
      placed.max[i] = placed.max[i].cwiseMax(corner + Vector2d::Constant(margin));
    }
  }
  std::vector<std::pair<int, int>> on_terrain;  // a solid, and the solid of an edge
  for (const auto& [a, b] : NearPairs(placed)) {
    const Solid& one = solids_[static_cast<std::size_t>(a)];
    const Solid& other = solids_[static_cast<std::size_t>(b)];
    if (other.edge >= 0) {
      on_terrain.push_back({a, b});
    } else {
      visit(one.part, other.part, OverlapDepth(placed.Of(one), placed.Of(other)));
    }
  }
  std::sort(on_terrain.begin(), on_terrain.end());
  for (std::size_t i = 0; i < on_terrain.size();) {
    const int solid = on_terrain[i].first;
    const PartId chain = solids_[static_cast<std::size_t>(on_terrain[i].second)].part;
    std::vector<const TerrainEdge*> edges;
    for (; i < on_terrain.size() && on_terrain[i].first == solid; ++i) {
      const Solid& edge = solids_[static_cast<std::size_t>(on_terrain[i].second)];
      edges.push_back(&edges_[static_cast<std::size_t>(edge.edge)]);
    }
    const Solid& one = solids_[static_cast<std::size_t>(solid)];
    visit(one.part, chain, DepthInTerrain(placed.Of(one), edges));
  }
}

}  // namespace seam
