#include "common/topology/feather_fall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_set>

namespace seam {
namespace {

std::uint64_t KeyOf(const Brick& b) {
  const auto bits = [](int n) { return static_cast<std::uint64_t>(n + (1 << 23)) & 0xffffff; };
  return static_cast<std::uint64_t>(b.kind) << 48 | bits(b.y) << 24 | bits(b.x);
}

bool IsBefore(const Brick& a, const Brick& b) {
  return std::tie(a.kind, a.y, a.x) < std::tie(b.kind, b.y, b.x);
}

/// Returns the bricks that share a part of an edge with `b`, not only a corner.
std::vector<Brick> Neighbours(const FeatherStore& store, const Brick& b) {
  const BrickKind& own = store.kinds()[static_cast<std::size_t>(b.kind)];
  const int right = b.x + own.width, top = b.y + own.height;
  std::vector<Brick> near = store.InBox(b.x - 1, b.y - 1, right + 1, top + 1);
  const auto apart = [&](const Brick& o) {
    if (o == b) return true;
    const BrickKind& kind = store.kinds()[static_cast<std::size_t>(o.kind)];
    const bool beside = o.x < right && o.x + kind.width > b.x;
    const bool level = o.y < top && o.y + kind.height > b.y;
    return !beside && !level;
  };
  near.erase(std::remove_if(near.begin(), near.end(), apart), near.end());
  return near;
}

/// Finds out, brick by brick, whether a foundation supports it.
class Support {
 public:
  Support(const Foundations& foundations, const std::vector<Part>& parts, const FeatherStore& left)
      : foundations_(foundations), parts_(parts), left_(left) {}

  /// Adds the brick and all that hang with it to `hanging`, once, if no foundation supports it.
  void Look(const Brick& brick, std::vector<Brick>* hanging) {
    if (known_.count(KeyOf(brick)) > 0) return;
    std::vector<Brick> open = {brick}, seen;
    std::unordered_set<std::uint64_t> met = {KeyOf(brick)};
    bool stands = false;
    while (!open.empty() && !stands) {
      const Brick b = open.back();
      open.pop_back();
      seen.push_back(b);
      if (foundations_.Holds(b, parts_)) stands = true;
      std::vector<Brick> near = Neighbours(left_, b);
      // The lowest comes next: the short way to the ground.
      std::stable_sort(near.begin(), near.end(),
                       [](const Brick& one, const Brick& two) { return one.y > two.y; });
      for (const Brick& next : near) {
        if (stood_.count(KeyOf(next)) > 0) stands = true;
        if (met.insert(KeyOf(next)).second) open.push_back(next);
      }
    }
    for (const Brick& b : seen) known_.insert(KeyOf(b));
    if (stands) {
      for (const Brick& b : seen) stood_.insert(KeyOf(b));
    } else {
      hanging->insert(hanging->end(), seen.begin(), seen.end());
    }
  }

 private:
  const Foundations& foundations_;
  const std::vector<Part>& parts_;
  const FeatherStore& left_;
  std::unordered_set<std::uint64_t> known_, stood_;  // visited; supported
};

/// Cuts hanging bricks into boxes, from below, from the left.
class Cutter {
 public:
  Cutter(const FeatureList<BrickField>& fields, std::vector<Brick> bricks)
      : fields_(fields), bricks_(std::move(bricks)) {
    std::sort(bricks_.begin(), bricks_.end(), IsBefore);
    bricks_.erase(std::unique(bricks_.begin(), bricks_.end()), bricks_.end());
    used_.assign(bricks_.size(), false);
  }

  Fallen Cut() {
    Fallen fallen;
    for (std::size_t i = 0; i < bricks_.size(); ++i) {
      if (used_[i]) continue;
      const Brick& b = bricks_[i];
      const BrickField& field = fields_[static_cast<std::size_t>(b.kind)];
      if (fallen.parts.size() == static_cast<std::size_t>(kFallPiecesMax)) {
        fallen.hanging.push_back(b);
        continue;
      }
      int columns = 1, rows = 1;
      while ((columns + 1) * field.width <= kFallSideMax && HasRow(b, columns, 1, 0)) ++columns;
      while ((rows + 1) * field.height <= kFallSideMax && HasRow(b, 0, columns, rows)) ++rows;
      for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) used_[Find(b, column, row)] = true;
      }
      fallen.parts.push_back(FreedPart(field, b, columns, rows));
    }
    return fallen;
  }

 private:
  /// Returns the index of the brick `column` columns and `row` rows from `b`; bricks_.size() if
  /// there is none or it is used.
  std::size_t Find(const Brick& b, int column, int row) const {
    const BrickField& field = fields_[static_cast<std::size_t>(b.kind)];
    const Brick wanted{b.x + column * field.width, b.y + row * field.height, b.kind};
    const auto at = std::lower_bound(bricks_.begin(), bricks_.end(), wanted, IsBefore);
    const auto index = static_cast<std::size_t>(at - bricks_.begin());
    return at != bricks_.end() && *at == wanted && !used_[index] ? index : bricks_.size();
  }
  bool HasRow(const Brick& b, int from, int count, int row) const {
    for (int column = from; column < from + count; ++column) {
      if (Find(b, column, row) == bricks_.size()) return false;
    }
    return true;
  }

  const FeatureList<BrickField>& fields_;
  std::vector<Brick> bricks_;  // by kind, y, x
  std::vector<bool> used_;
};

}  // namespace

Fallen FallingBricks(const FeatureList<BrickField>& fields, const Foundations& foundations,
                     const std::vector<Part>& parts, const FeatherStore& left,
                     const std::vector<Brick>& freed, const Blast& blast) {
  Support support(foundations, parts, left);
  std::vector<Brick> hanging = left.hanging();  // already known; no support can have come below
  for (const Brick& b : freed) {
    for (const Brick& next : Neighbours(left, b)) support.Look(next, &hanging);
  }
  const auto unit = [](float metres) {
    return static_cast<int>(
        std::floor(static_cast<double>(metres) / static_cast<double>(kBrickUnit)));
  };
  const Vec2 low = blast.centre.array() - blast.radius, high = blast.centre.array() + blast.radius;
  for (const Brick& b :
       left.InBox(unit(low.x()), unit(low.y()), unit(high.x()) + 1, unit(high.y()) + 1)) {
    support.Look(b, &hanging);
  }
  return Cutter(fields, std::move(hanging)).Cut();
}

std::vector<Brick> HangingWithout(PartId part, const Foundations& foundations,
                                  const std::vector<Part>& parts, const FeatherStore& left) {
  Support support(foundations, parts, left);
  std::vector<Brick> hanging = left.hanging();
  for (const Brick& b : foundations.On(part)) {
    if (left.Has(b)) support.Look(b, &hanging);
  }
  std::sort(hanging.begin(), hanging.end(), IsBefore);
  hanging.erase(std::unique(hanging.begin(), hanging.end()), hanging.end());
  return hanging;
}

}  // namespace seam
