#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "common/measure/overlap.h"
#include "common/physics/world.h"
#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

/// Things may begin in each other by this, m, or by a tenth of the thinner one if that is less: the
/// engine pushes so much apart within a few ticks and without a jump.
constexpr double kOverlapMax = 0.05;
/// But by this at any rate, m: the rims by which two shapes of the engine collide.
constexpr double kOverlapMin = 0.02;

/// The least width of a part, m; infinite for lines.
double Thickness(const Part& part) {
  switch (part.kind) {
    case ShapeKind::kBox: return double{part.size.minCoeff()};
    case ShapeKind::kCircle:
    case ShapeKind::kCapsule: return 2 * double{part.radius};
    case ShapeKind::kPolygon: {
      Vec2 low = part.points.front(), high = low;
      for (const Vec2& point : part.points) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
      }
      return double{(high - low).minCoeff()};
    }
    case ShapeKind::kChain:
    case ShapeKind::kSegment: break;
  }
  return 1e9;
}

}  // namespace

void FindOverlaps(const Scene& scene, std::vector<Finding>* findings) {
  const World world(scene);
  const Composition& composition = world.composition();
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  const auto part = [&scene](PartId id) -> const Part& {
    return scene.parts[static_cast<std::size_t>(id)];
  };
  std::set<PartId> reversed;
  for (const Finding& finding : *findings) reversed.insert(finding.reversed);
  // The deepest of each pair of bodies: one that is made of many parts is in the way once.
  struct Deep {
    PartId moving = 0, other = 0;
    double depth_m = 0;
  };
  std::map<std::pair<int, int>, Deep> deepest;
  OverlapMeter(scene, composition)
      .ForEachOverlap(states, 0, [&](PartId moving, PartId other, double depth_m) {
        const double thin = std::min(Thickness(part(moving)), Thickness(part(other)));
        if (reversed.count(other) != 0) return;
        if (depth_m <= std::max(kOverlapMin, std::min(kOverlapMax, 0.1 * thin))) return;
        const auto& of = composition.assembly_of_part;
        const int a = of[static_cast<std::size_t>(moving)], b = of[static_cast<std::size_t>(other)];
        Deep& deep = deepest[{std::min(a, b), std::max(a, b)}];
        if (depth_m > deep.depth_m) deep = {moving, other, depth_m};
      });
  // Of a line of the file that stands for many parts, the deepest.
  std::map<int, std::pair<std::string, int>> by_line;
  std::map<int, double> depth;
  for (const auto& [pair, deep] : deepest) {
    const auto assembly = composition.assembly_of_part[static_cast<std::size_t>(deep.other)];
    const bool anchored = composition.assemblies[static_cast<std::size_t>(assembly)].anchored;
    const PartId later = anchored ? deep.moving : std::max(deep.moving, deep.other);
    const PartId first = later == deep.moving ? deep.other : deep.moving;
    const int line = part(later).line;
    auto& [text, count] = by_line[line];
    ++count;
    if (deep.depth_m <= depth[line]) continue;
    depth[line] = deep.depth_m;
    text = fmt::format("part '{}' begins {:.2f} m inside {} '{}'", part(later).name, deep.depth_m,
                       anchored ? "the anchored part" : "part", part(first).name);
  }
  for (const auto& [line, found] : by_line) {
    const std::string more =
        found.second > 1 ? fmt::format(", and {} more such pairs", found.second - 1) : "";
    findings->push_back({line, found.first + more});
  }
}

}  // namespace seam
