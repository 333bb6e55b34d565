#include "common/topology/foundation.h"

#include <algorithm>
#include <tuple>

#include "common/base/disjoint_sets.h"
#include "common/topology/floors.h"

namespace seam {
namespace {

constexpr std::int64_t kUnitMillimetres = 50;

std::tuple<int, int, int> OrderOf(const Brick& b) { return {b.kind, b.y, b.x}; }

/// Calls `visit` with each brick that lies on the floor, some of them more than once.
template <class Visit>
void EachBrickOn(const Floor& floor, const FeatherStore& whole, const Visit& visit) {
  constexpr std::int64_t step = FeatherStore::kCell * kUnitMillimetres;
  if (whole.cell_count() == 0) return;
  const std::int64_t from = std::max(floor.x0, whole.cell_x_min() * step);
  const std::int64_t to = std::min(floor.x1, (whole.cell_x_max() + 1) * step);
  const auto units = [](std::int64_t mm) {
    return static_cast<int>(mm >= 0 ? mm / kUnitMillimetres : -((-mm + 49) / kUnitMillimetres));
  };
  for (std::int64_t x = from; x < to; x += step) {
    const std::int64_t end = std::min(x + step, to);
    const Floor::Heights all = floor.Between(x, end);
    for (const Brick& b : whole.InBox(units(x), units(all.low) - 1, units(end) + 1,
                                      units(all.high + kRestGap) + 2)) {
      const BrickKind& kind = whole.kinds()[static_cast<std::size_t>(b.kind)];
      const std::int64_t left = std::max(b.x * kUnitMillimetres + kRestSide, floor.x0);
      const std::int64_t right =
          std::min((b.x + kind.width) * kUnitMillimetres - kRestSide, floor.x1);
      if (left >= right) continue;
      const Floor::Heights below = floor.Between(left, right);
      const std::int64_t bottom = b.y * kUnitMillimetres;
      const std::int64_t top = bottom + kind.height * kUnitMillimetres;
      if (below.high >= bottom - kRestGap && below.low < top) visit(b);
    }
  }
}

/// A block and its tower.
struct Node {
  BuildingBlock block;
  int tower = 0;
  int begins = 0, height = 0;  // units: start of its [[bricks]], and height of one brick
};

/// Calls `visit` with all pairs of blocks of different towers that overlap along x or share an
/// upright edge.
template <class Visit>
void EachPair(const std::vector<Node>& by_x0, const Visit& visit) {
  std::vector<const Node*> open;
  for (const Node& node : by_x0) {
    const auto past = [&](const Node* other) { return other->block.x1 < node.block.x0; };
    open.erase(std::remove_if(open.begin(), open.end(), past), open.end());
    for (const Node* other : open) {
      if (other->tower != node.tower) visit(*other, node);
    }
    open.push_back(&node);
  }
}

bool Beside(const BuildingBlock& a, const BuildingBlock& b) { return a.y0 < b.y1 && b.y0 < a.y1; }
bool Over(const BuildingBlock& a, const BuildingBlock& b) { return a.x0 < b.x1 && b.x0 < a.x1; }

bool Touch(const BuildingBlock& a, const BuildingBlock& b) {
  const bool near = a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1;
  return near && (Beside(a, b) || Over(a, b));
}

}  // namespace

Foundations::Foundations(const FeatherStore& whole, const FeatureList<BrickField>& fields,
                         const std::vector<Part>& ground)
    : fields_(fields) {
  for (const Part& part : ground) {
    for (const Floor& floor : FloorsOf(part)) {
      EachBrickOn(floor, whole, [&](const Brick& b) { rests_.push_back({b, part.id}); });
    }
  }
  const auto order = [](const Rest& r) { return std::pair(OrderOf(r.brick), r.part); };
  std::sort(rests_.begin(), rests_.end(),
            [&](const Rest& a, const Rest& b) { return order(a) < order(b); });
  const auto equal = [&](const Rest& a, const Rest& b) { return order(a) == order(b); };
  rests_.erase(std::unique(rests_.begin(), rests_.end(), equal), rests_.end());

  std::vector<Node> nodes;
  std::size_t towers = 0;
  for (const BrickField& field : fields) {
    first_.push_back(towers);
    EachBuildingBlock(field, [&](const BuildingBlock& block) {
      nodes.push_back(
          {block, static_cast<int>(towers) + block.building, field.y, field.height});
    });
    towers += static_cast<std::size_t>(BuildingsOf(field));
  }
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const Node& a, const Node& b) { return a.block.x0 < b.block.x0; });
  DisjointSets buildings(towers);
  EachPair(nodes, [&](const Node& a, const Node& b) {
    if (Touch(a.block, b.block)) buildings.Unite(a.tower, b.tower);
  });
  const auto first_tower = [&](int tower) {
    return static_cast<std::size_t>(buildings.Find(tower));
  };
  std::vector<bool> on_ground(towers, false);  // by building, at the index of its first tower
  for (const Rest& rest : rests_) {
    on_ground[first_tower(static_cast<int>(TowerOf(rest.brick)))] = true;
  }
  own_foundation_.assign(towers, true);
  for (std::size_t t = 0; t < towers; ++t) {
    own_foundation_[t] = !on_ground[first_tower(static_cast<int>(t))];
  }
  const auto look = [&](const Node& node, const Node& other) {
    if (node.block.y0 != node.begins || !buildings.Same(node.tower, other.tower)) return;
    BuildingBlock row = node.block;
    row.y1 = row.y0 + node.height;
    const bool rests = other.begins < node.begins && Touch(row, other.block);
    const bool hangs = Over(row, other.block) && other.block.y1 <= row.y0;
    if (rests || hangs) own_foundation_[static_cast<std::size_t>(node.tower)] = false;
  };
  EachPair(nodes, [&](const Node& a, const Node& b) {
    look(a, b);
    look(b, a);
  });
}

std::size_t Foundations::TowerOf(const Brick& brick) const {
  const auto kind = static_cast<std::size_t>(brick.kind);
  return first_[kind] + static_cast<std::size_t>(BuildingAt(fields_[kind], brick.x));
}

bool Foundations::Holds(const Brick& brick, const std::vector<Part>& parts) const {
  if (own_foundation_[TowerOf(brick)]) {
    return brick.y == fields_[static_cast<std::size_t>(brick.kind)].y;
  }
  auto at = std::lower_bound(
      rests_.begin(), rests_.end(), brick,
      [](const Rest& rest, const Brick& b) { return OrderOf(rest.brick) < OrderOf(b); });
  for (; at != rests_.end() && at->brick == brick; ++at) {
    const Part& part = parts[static_cast<std::size_t>(at->part)];
    if (part.anchored && !part.gone) return true;
  }
  return false;
}

std::vector<Brick> Foundations::On(PartId part) const {
  std::vector<Brick> on;
  for (const Rest& rest : rests_) {
    if (rest.part == part) on.push_back(rest.brick);
  }
  return on;
}

}  // namespace seam
