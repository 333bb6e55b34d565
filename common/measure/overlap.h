#pragma once
/// Overlap depth of bodies, by their true shapes in double precision: independent of the physics
/// engine, which has a contact skin around the shapes.

#include <functional>
#include <utility>
#include <vector>

#include "common/measure/convex.h"
#include "common/scene/assembly.h"
#include "common/stages/kinematic.h"

namespace seam {

/// Measures overlaps of a scene's parts.
class OverlapMeter {
 public:
  OverlapMeter(const Scene& scene, const Composition& composition);

  /// Returns the deepest overlap of any two parts that may collide, m, >= 0. Parts of one assembly,
  /// whose filters exclude each other, of assemblies joined by a joint without `collide`, or both
  /// anchored may not. Chains that move, as parts of bodies or on a path, are left out. `moving`:
  /// states of the moving assemblies, ascending by id, as World::Read(0..body_count-1). `tick`:
  /// places kinematic parts. Infinite when a pose is not finite.
  double Deepest(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;

  /// Receives two parts and their overlap depth, m. A solid near terrain is reported once, with one
  /// of the chains near it.
  using Visit = std::function<void(PartId moving, PartId other, double depth_m)>;
  /// Calls `visit` for each pair of parts that Deepest examines, also where the depth is 0.
  /// Requires finite poses.
  void ForEachOverlap(const std::vector<BodyState>& moving, std::int64_t tick,
                      const Visit& visit) const;

 private:
  /// A part, or one edge of a chain.
  struct Solid {
    PartId part = 0;
    int assembly = 0;  // index into the composition's assemblies
    int moving = -1;   // index into the states; -1: anchored
    int imposed = -1;  // anchored, but moved: index into imposed_
    CollisionFilter filter;
    int first = 0, count = 0;  // its corners
    double radius = 0;         // m
    int edge = -1;             // index into edges_; -1: not of a chain
  };
  struct Placed;

  void AddPart(const Part& part, const Part& root, int assembly, int moving);
  bool MayCollide(const Solid& a, const Solid& b) const;
  /// Returns the pairs that may collide and have overlapping bounding boxes; the first of each pair
  /// moves.
  std::vector<std::pair<int, int>> NearPairs(const Placed& placed) const;

  ImposedMotions imposed_;
  std::vector<Solid> solids_;
  std::vector<Eigen::Vector2d> corners_;  // in the root's frame if it moves, else in the world
  std::vector<TerrainEdge> edges_;
  std::vector<std::pair<int, int>> joined_;  // pairs of assemblies, the lower first; sorted
  std::size_t moving_count_ = 0;
};

}  // namespace seam
