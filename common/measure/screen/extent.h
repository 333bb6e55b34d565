#pragma once
/// Distance of two poses of a body: the largest displacement of any of its points, so that a
/// rotation counts by the displacement that it causes.

#include <map>
#include <utility>
#include <vector>

#include "common/measure/pose.h"
#include "common/measure/revisions.h"

namespace seam {

/// A pose in double precision.
struct DoublePose {
  Eigen::Vector2d position{0, 0};  ///< m
  double angle = 0;                ///< rad, not wrapped

  DoublePose() = default;
  DoublePose(const Eigen::Vector2d& at, double turn) : position(at), angle(turn) {}
  explicit DoublePose(const BodyState& state)
      : position(state.position.cast<double>()), angle(double{state.angle}) {}
};

/// The convex hull of a body, as discs in its root's frame, most of them of radius 0. Without discs
/// the body is a point at its origin.
class Extent {
 public:
  Extent() = default;
  Extent(const Scene& scene, const Assembly& assembly);

  /// Returns the largest |A p - B p| over the body's points p, m. From pose B to pose A a point p
  /// of the body is displaced by t + D p with D = R_A - R_B, a rotation times s = 2 |sin(turn/2)|.
  /// The length is a convex function of p, so its maximum is at a corner; over a disc with centre c
  /// and radius r it is |t + D c| + s r.
  double Displacement(const DoublePose& a, const DoublePose& b) const;
  /// Returns the distance of the farthest point from the origin, m.
  double radius() const { return radius_; }
  /// Returns the distance from a point of the root's frame to the body's farthest point, m.
  double ReachFrom(const Eigen::Vector2d& point) const;

 private:
  struct Disc {
    Eigen::Vector2d centre{0, 0};  // m
    double radius = 0;             // m
  };
  void KeepHull(std::vector<Eigen::Vector2d> corners);

  std::vector<Disc> discs_;
  double radius_ = 0;
};

/// The extents of a session's bodies, each computed once.
class Extents {
 public:
  /// `revisions`: must outlive this; nullptr: all bodies are points.
  explicit Extents(const RevisionHistory* revisions) : revisions_(revisions) {}
  /// Returns the extent of assembly `id` after `edits` edits; a point if there is none.
  const Extent& Of(int edits, PartId id);

 private:
  const RevisionHistory* revisions_;
  std::map<std::pair<int, PartId>, Extent> extents_;  // by key of the revision
  const Extent point_;
};

}  // namespace seam
