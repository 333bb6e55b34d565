#pragma once
/// How deep bodies overlap, by the true shapes in double precision: independent of the
/// physics engine, whose contacts begin at a rim around the shapes.

#include <functional>
#include <utility>
#include <vector>

#include "common/measure/convex.h"
#include "common/scene/assembly.h"
#include "common/stages/kinematic.h"

namespace seam {

class OverlapMeter {
 public:
  OverlapMeter(const Scene& scene, const Composition& composition);

  /// m, >= 0: the deepest overlap of any two parts that may collide: not of one assembly, not both
  /// anchored, not of one negative group, not of assemblies joined by a joint without `collide`.
  /// `moving`: of the moving assemblies ascending by id, as World::Read(0..body_count-1). `tick`:
  /// where kinematic parts are. Infinite when a pose is not finite.
  double Deepest(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;

  /// Two parts and how deep they overlap, m. Of chains it is the part of the nearest edges that
  /// were looked at.
  using Visit = std::function<void(PartId moving, PartId other, double depth_m)>;
  /// Calls `visit` for each pair of parts, or of pieces of them, whose depth Deepest would look at:
  /// 0 too. Requires finite poses.
  void ForEachOverlap(const std::vector<BodyState>& moving, std::int64_t tick,
                      const Visit& visit) const;

 private:
  /// A part, or one edge of a chain.
  struct Solid {
    PartId part = 0;
    int assembly = 0;  // index into the composition's
    int moving = -1;   // index into the states; -1: anchored
    int imposed = -1;  // anchored, but moved: index into imposed_
    int group = 0;
    int first = 0, count = 0;  // its corners
    double radius = 0;         // m
    int edge = -1;             // index into edges_; -1: not of a chain
  };
  struct Placed;

  void AddPart(const Part& part, const Part& root, int assembly, int moving);
  bool MayCollide(const Solid& a, const Solid& b) const;
  /// The pairs whose bounding boxes overlap and that may collide; in each, the first one moves.
  std::vector<std::pair<int, int>> NearPairs(const Placed& placed) const;

  ImposedMotions imposed_;
  std::vector<Solid> solids_;
  std::vector<Eigen::Vector2d> corners_;  // of what moves in the root's frame, else in the world
  std::vector<TerrainEdge> edges_;
  std::vector<std::pair<int, int>> joined_;  // pairs of assemblies, the lower first; sorted
  std::size_t moving_count_ = 0;
};

}  // namespace seam
