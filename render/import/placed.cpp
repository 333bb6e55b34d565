#include "render/import/placed.h"

namespace seam {
namespace {

/// The part as the scene will have it, for its mass.
Part PartOf(const Placed& placed) {
  Part part;
  part.kind = placed.piece.kind;
  part.size = placed.piece.size.cast<float>();
  part.radius = static_cast<float>(placed.piece.radius);
  for (const Eigen::Vector2d& p : placed.piece.points) part.points.push_back(p.cast<float>());
  part.material.density = static_cast<float>(placed.density);
  return part;
}

}  // namespace

MassProperties MassOf(const std::vector<Placed>& parts) {
  MassProperties all;
  for (const Placed& placed : parts) {
    const MassProperties own = PartProperties(PartOf(placed));
    all.mass += own.mass;
    all.centre += own.mass * placed.piece.pose(own.centre);
  }
  if (all.mass > 0) all.centre /= all.mass;
  for (const Placed& placed : parts) {
    const MassProperties own = PartProperties(PartOf(placed));
    all.inertia +=
        own.inertia + own.mass * (placed.piece.pose(own.centre) - all.centre).squaredNorm();
  }
  return all;
}

}  // namespace seam
