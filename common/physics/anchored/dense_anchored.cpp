#include "common/physics/anchored/dense_anchored.h"

#include <cmath>
#include <cstdint>

#include "common/base/spatial/box_sweep.h"
#include "common/base/spatial/disjoint_sets.h"
#include "common/scene/crowding/part_limits.h"

namespace seam {
namespace {

/// A chain joins no row: its box is not its shape.
bool JoinsRows(const Part& part, const PartLimits& limits) {
  return part.kind != ShapeKind::kChain && (limits.max - limits.min).maxCoeff() <= kAnchoredSquare;
}

/// Returns by assembly the lowest number of its row.
std::vector<int> RowsOf(const Scene& scene, const Composition& composition,
                        const std::vector<bool>& still) {
  std::vector<PartLimits> limits;
  std::vector<int> assembly_of;
  for (std::size_t a = 0; a < still.size(); ++a) {
    if (!still[a]) continue;
    for (const PartId id : composition.assemblies[a].parts) {
      const Part& part = scene.parts[static_cast<std::size_t>(id)];
      const PartLimits its = LimitsOf(part);
      if (!JoinsRows(part, its)) continue;
      limits.push_back(its);
      assembly_of.push_back(static_cast<int>(a));
    }
  }
  DisjointSets rows(still.size());
  const auto grow = [](std::size_t) { return 0.0f; };
  BoxSweep(limits, grow).EachPair([&](std::uint32_t a, std::uint32_t b) {
    rows.Unite(assembly_of[a], assembly_of[b]);
  });
  return rows.Lowest();
}

}  // namespace

AnchoredSquare SquareOf(const Part& root) {
  const auto square = [](float x) { return static_cast<int>(std::floor(x / kAnchoredSquare)); };
  return {square(root.position.x()), square(root.position.y())};
}

std::vector<bool> DenseAnchored(const Scene& scene, const Composition& composition) {
  std::vector<bool> still;
  std::size_t parts = 0;
  for (const Assembly& a : composition.assemblies) {
    still.push_back(a.anchored && a.kinematic < 0);
    if (still.back()) parts += a.parts.size();
  }
  std::vector<bool> dense(still.size(), false);
  if (parts < kDenseFrom) return dense;
  const std::vector<int> rows = RowsOf(scene, composition, still);
  std::vector<std::size_t> counts(still.size(), 0);  // by row
  for (std::size_t a = 0; a < still.size(); ++a) {
    if (still[a])
      counts[static_cast<std::size_t>(rows[a])] += composition.assemblies[a].parts.size();
  }
  for (std::size_t a = 0; a < still.size(); ++a) {
    dense[a] = still[a] && counts[static_cast<std::size_t>(rows[a])] >= kDenseFrom;
  }
  return dense;
}

}  // namespace seam
