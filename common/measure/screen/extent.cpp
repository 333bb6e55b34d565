#include "common/measure/screen/extent.h"

#include <algorithm>
#include <cmath>

#include "common/scene/mass.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Returns the cross product of the turn from `a` to `b` to `c`: positive to the left.
double Turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Returns the corners in the part's own frame; for a circle its centre, for a capsule the centres
/// of its ends.
std::vector<Vector2d> CornersOf(const Part& part) {
  if (part.kind == ShapeKind::kCircle) return {Vector2d(0, 0)};
  if (part.kind == ShapeKind::kBox) {
    const double x = double{part.size.x()} / 2, y = double{part.size.y()} / 2;
    return {Vector2d(-x, -y), Vector2d(x, -y), Vector2d(x, y), Vector2d(-x, y)};
  }
  std::vector<Vector2d> corners;
  for (const Vec2& point : part.points) corners.push_back(point.cast<double>());
  return corners;
}

}  // namespace

Extent::Extent(const Scene& scene, const Assembly& assembly) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  std::vector<Vector2d> corners;
  for (const PartId id : assembly.parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const bool round = part.kind == ShapeKind::kCircle || part.kind == ShapeKind::kCapsule;
    for (const Vector2d& corner : CornersOf(part)) {
      const Vector2d place = ToRootFrame(part, root, corner);
      const double r = round ? double{part.radius} : 0;
      radius_ = std::max(radius_, place.norm() + r);
      if (round) {
        discs_.push_back({place, r});
      } else {
        corners.push_back(place);
      }
    }
  }
  KeepHull(std::move(corners));
}

/// Keeps the convex hull of the corners (Andrew's monotone chain): an inner point is never
/// displaced most.
void Extent::KeepHull(std::vector<Vector2d> corners) {
  std::sort(corners.begin(), corners.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  for (int side = 0; side < 2; ++side) {
    std::vector<Vector2d> hull;
    for (const Vector2d& corner : corners) {
      while (hull.size() > 1 && Turn(hull[hull.size() - 2], hull.back(), corner) <= 0) {
        hull.pop_back();
      }
      hull.push_back(corner);
    }
    for (const Vector2d& corner : hull) discs_.push_back({corner, 0});
    std::reverse(corners.begin(), corners.end());
  }
}

double Extent::Displacement(const DoublePose& a, const DoublePose& b) const {
  const Vector2d t = a.position - b.position;
  if (discs_.empty() || a.angle == b.angle) return t.norm();
  const Rotation<double> ra(a.angle), rb(b.angle);
  const double cosine = ra.cosine - rb.cosine, sine = ra.sine - rb.sine;
  const double s = std::hypot(cosine, sine);
  double most = 0;
  for (const Disc& disc : discs_) {
    const Vector2d& c = disc.centre;
    const double x = t.x() + cosine * c.x() - sine * c.y();
    const double y = t.y() + sine * c.x() + cosine * c.y();
    most = std::max(most, std::hypot(x, y) + s * disc.radius);
  }
  return most;
}

double Extent::ReachFrom(const Vector2d& point) const {
  double most = 0;
  for (const Disc& disc : discs_) most = std::max(most, (disc.centre - point).norm() + disc.radius);
  return most;
}

const Extent& Extents::Of(int edits, PartId id) {
  if (revisions_ == nullptr) return point_;
  const std::pair<int, PartId> key(revisions_->Key(edits), id);
  const auto known = extents_.find(key);
  if (known != extents_.end()) return known->second;
  const auto revision = revisions_->At(edits);
  const int of = revision->AssemblyOf(id);
  Extent extent;
  if (of >= 0) {
    extent =
        Extent(revision->scene(), revision->composition().assemblies[static_cast<std::size_t>(of)]);
  }
  return extents_.emplace(key, std::move(extent)).first->second;
}

}  // namespace seam
