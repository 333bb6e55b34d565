#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/measure/convex.h"
#include "common/scene/assembly.h"
#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

using Eigen::Vector2d;

constexpr double kFar = std::numeric_limits<double>::infinity();

Vector2d InWorld(const Part& part, const Vec2& local) {
  const double c = std::cos(double{part.angle}), s = std::sin(double{part.angle});
  const Vector2d p = local.cast<double>();
  return part.position.cast<double>() + Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y());
}

/// A chain, and which bodies are on which of its sides.
struct Chain {
  const Part* part = nullptr;
  std::vector<TerrainEdge> edges;
  std::vector<const Part*> behind;  ///< on the solid side
  int before = 0;                   ///< on the open side
};

std::vector<Chain> ChainsOf(const Scene& scene) {
  std::vector<Chain> chains;
  for (const Part& part : scene.parts) {
    if (part.kind != ShapeKind::kChain) continue;
    std::vector<Vector2d> line;
    for (const Vec2& point : part.points) line.push_back(InWorld(part, point));
    chains.push_back({&part, TerrainEdges(line), {}, 0});
  }
  return chains;
}

/// A point seen from a chain.
struct Side {
  double distance = kFar;  ///< m
  double height = 0;       ///< its sign: positive is the open side
  bool beyond = true;      ///< past an end of the chain: on neither side
};

Side SideOf(const Chain& chain, const Vector2d& p) {
  Side side;
  for (const TerrainEdge& edge : chain.edges) {
    const Vector2d way = edge.to - edge.from;
    const double along = (p - edge.from).dot(way) / way.squaredNorm();
    const Vector2d away = p - (edge.from + std::clamp(along, 0.0, 1.0) * way);
    if (away.norm() >= side.distance) continue;
    side.distance = away.norm();
    // At a corner the two edges' normals together tell the side.
    Vector2d normal = edge.normal;
    if (along <= 0) normal += edge.normal_before;
    if (along >= 1) normal += edge.normal_after;
    side.height = normal.dot(away);
    side.beyond =
        (along < 0 && edge.normal_before.isZero(0)) || (along > 1 && edge.normal_after.isZero(0));
  }
  return side;
}

/// Whether a chain is hit on the way from `p` along gravity.
bool HasGround(const std::vector<Chain>& chains, const Vector2d& p, const Vector2d& down) {
  const Vector2d across(-down.y(), down.x());
  for (const Chain& chain : chains) {
    for (const TerrainEdge& edge : chain.edges) {
      const double a = across.dot(edge.from - p), b = across.dot(edge.to - p);
      if ((a < 0) == (b < 0)) continue;
      const Vector2d hit = edge.from + a / (a - b) * (edge.to - edge.from);
      if (down.dot(hit - p) > 0) return true;
    }
  }
  return false;
}

/// Whether something anchored that is no chain is straight below, by its position: not exact, and
/// on the safe side.
bool HasFloor(const Scene& scene, const Vector2d& p, const Vector2d& down) {
  const auto below = [&](const Part& part) {
    return (part.anchored || IsLine(part.kind)) && part.kind != ShapeKind::kChain &&
           down.dot(part.position.cast<double>() - p) > 0;
  };
  return !scene.bricks.empty() || !scene.waters.empty() ||
         std::any_of(scene.parts.begin(), scene.parts.end(), below);
}

void Report(const Scene& scene, const std::vector<Chain>& chains, const Chain& chain,
            std::vector<Finding>* findings) {
  const std::string& name = chain.part->name;
  if (!chain.behind.empty() && chain.before == 0) {
    findings->push_back(
        {chain.part->line,
         fmt::format(
             "chain '{}' faces the wrong way: '{}'{} on its solid side, nothing on its open "
             "one; give its points in the other order",
             name, chain.behind.front()->name,
             chain.behind.size() > 1 ? fmt::format(" and {} more are", chain.behind.size() - 1)
                                     : " is"),
         chain.part->id});
    return;
  }
  const Vector2d gravity = scene.gravity.cast<double>();
  if (gravity.norm() == 0) return;
  const Vector2d down = gravity.normalized();
  for (const Part* part : chain.behind) {
    const Vector2d p = part->position.cast<double>();
    if (HasGround(chains, p, down) || HasFloor(scene, p, down)) continue;
    findings->push_back({part->line, fmt::format("part '{}' begins on the solid side of '{}' with "
                                                 "nothing below it: it falls out of the scene",
                                                 part->name, name)});
  }
}

}  // namespace

void FindWrongSides(const Scene& scene, std::vector<Finding>* findings) {
  std::vector<Chain> chains = ChainsOf(scene);
  for (const Assembly& assembly : Compose(scene).assemblies) {
    if (assembly.anchored) continue;
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    Chain* nearest = nullptr;
    Side side;
    for (Chain& chain : chains) {
      const Side seen = SideOf(chain, root.position.cast<double>());
      if (seen.distance >= side.distance) continue;
      side = seen;
      nearest = &chain;
    }
    if (nearest == nullptr || side.beyond) continue;
    if (side.height < 0) nearest->behind.push_back(&root);
    if (side.height > 0) ++nearest->before;
  }
  for (const Chain& chain : chains) Report(scene, chains, chain, findings);
}

}  // namespace seam
