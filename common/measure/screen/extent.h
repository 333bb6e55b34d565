#pragma once
/// How far two poses of a body are apart: the largest displacement of a point of it, so that a turn
/// counts by what it moves.

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

/// A body's material, as far as its displacement depends on it: discs in its root's frame, most of
/// them of radius 0. Empty: the body is a point at its origin.
class Extent {
 public:
  Extent() = default;
  Extent(const Scene& scene, const Assembly& assembly);

  /// m: the largest |A p - B p| over the body's points p. From pose B to pose A a point p of the
  /// body is displaced by t + D p with D = R_A - R_B, which is a rotation times s = 2
  /// |sin(turn/2)|: a convex function of p, so the largest value is at a corner; over a disc with
  /// centre c and radius r it is |t + D c| + s r.
  double Displacement(const DoublePose& a, const DoublePose& b) const;
  /// m: of the point farthest from the origin.
  double radius() const { return radius_; }
  /// m: from a point of the root's frame to the body's farthest point.
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

/// The extents of a session's bodies, each looked up once.
class Extents {
 public:
  /// `revisions` nullptr: all bodies are points. Else it must outlive this.
  explicit Extents(const RevisionHistory* revisions) : revisions_(revisions) {}
  /// Of the assembly of that id after so many edits; a point if there is none.
  const Extent& Of(int edits, PartId id);

 private:
  const RevisionHistory* revisions_;
  std::map<std::pair<int, PartId>, Extent> extents_;  // by key of the revision
  const Extent point_;
};

}  // namespace seam
