#include "common/topology/feather_store.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "common/base/check.h"
#include "common/scene/bricks.h"

namespace seam {
namespace {

constexpr int kBias = 1 << 15;

/// Ascends by y, then x.
std::uint32_t KeyOf(int cell_x, int cell_y) {
  return static_cast<std::uint32_t>(cell_y + kBias) << 16 |
         static_cast<std::uint32_t>(cell_x + kBias);
}

std::vector<BrickKind> KindsOf(const FeatureList<BrickField>& fields) {
  std::vector<BrickKind> kinds;
  int surfaces = 0;
  for (const BrickField& f : fields) {
    BrickKind kind{f.width, f.height, surfaces, f.density, f.friction, f.restitution, f.strength};
    for (const BrickKind& other : kinds) {
      if (other.friction == kind.friction && other.restitution == kind.restitution) {
        kind.surface = other.surface;
      }
    }
    if (kind.surface == surfaces) ++surfaces;
    kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace

FeatherStore::FeatherStore(const FeatureList<BrickField>& fields) : kinds_(KindsOf(fields)) {
  std::unordered_map<std::uint32_t, std::uint32_t> count_of_cell;
  for (const BrickField& field : fields) {
    std::uint32_t last_key = 0;
    std::uint32_t* count = nullptr;
    EachBrick(field, [&](int x, int y) {
      const std::uint32_t key = KeyOf(CellOf(x), CellOf(y));
      if (count == nullptr || key != last_key) count = &count_of_cell[last_key = key];
      ++*count;
      ++size_;
      // Cells that the brick reaches into need an outline too, even if no brick begins there.
      const int x1 = CellOf(x + field.width - 1), y1 = CellOf(y + field.height - 1);
      if (x1 != CellOf(x)) count_of_cell[KeyOf(x1, CellOf(y))] += 0;
      if (y1 != CellOf(y)) count_of_cell[KeyOf(CellOf(x), y1)] += 0;
      if (x1 != CellOf(x) && y1 != CellOf(y)) count_of_cell[KeyOf(x1, y1)] += 0;
      return true;
    });
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted(count_of_cell.begin(),
                                                              count_of_cell.end());
  std::sort(sorted.begin(), sorted.end());
  cells_.reserve(sorted.size());
  std::uint32_t first = 0;
  for (const auto& [key, count] : sorted) {
    const int x = static_cast<int>(key & 0xffff) - kBias, y = static_cast<int>(key >> 16) - kBias;
    cells_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), first, 0});
    first += count;
    min_x_ = cells_.size() == 1 ? x : std::min(min_x_, x);
    max_x_ = cells_.size() == 1 ? x : std::max(max_x_, x);
  }
  if (!cells_.empty()) {
    min_y_ = cells_.front().y;
    max_y_ = cells_.back().y;
  }
  bricks_.resize(size_);
  Fill(fields);
}

void FeatherStore::Fill(const FeatureList<BrickField>& fields) {
  for (std::size_t kind = 0; kind < fields.size(); ++kind) {
    int cell = -1;
    EachBrick(fields[kind], [&](int x, int y) {
      const int cx = CellOf(x), cy = CellOf(y);
      if (cell < 0 || cell_x(cell) != cx || cell_y(cell) != cy) cell = CellAt(cx, cy);
      Cell& c = cells_[static_cast<std::size_t>(cell)];
      bricks_[c.first + c.count++] = Pack({x, y, static_cast<int>(kind)}, cx, cy);
      return true;
    });
  }
  for (const Cell& c : cells_) {
    const auto begin = bricks_.begin() + c.first, end = begin + c.count;
    if (!std::is_sorted(begin, end)) std::sort(begin, end);
  }
}

std::uint32_t FeatherStore::Pack(const Brick& brick, int cell_x, int cell_y) {
  return static_cast<std::uint32_t>(brick.x - cell_x * kCell) |
         static_cast<std::uint32_t>(brick.y - cell_y * kCell) << 8 |
         static_cast<std::uint32_t>(brick.kind) << 16;
}

std::size_t FeatherStore::bytes() const {
  return sizeof *this + bricks_.capacity() * sizeof bricks_[0] +
         cells_.capacity() * sizeof cells_[0] + kinds_.capacity() * sizeof kinds_[0];
}

int FeatherStore::CellAt(int cell_x, int cell_y) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), std::tuple(cell_y, cell_x),
                                      [](const Cell& c, const std::tuple<int, int>& at) {
                                        return std::tuple<int, int>(c.y, c.x) < at;
                                      });
  if (found == cells_.end() || found->x != cell_x || found->y != cell_y) return -1;
  return static_cast<int>(found - cells_.begin());
}

void FeatherStore::Append(int cell, std::vector<Brick>* out) const {
  const Cell& c = cells_[static_cast<std::size_t>(cell)];
  for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
    out->push_back(Unpack(bricks_[i], c));
  }
}

std::vector<Brick> FeatherStore::InBox(int x0, int y0, int x1, int y1) const {
  std::vector<Brick> out;
  if (cells_.empty()) return out;
  // A brick of the previous cell may reach in.
  const int from_x = std::max(CellOf(x0 - kBrickSideMax), min_x_);
  const int from_y = std::max(CellOf(y0 - kBrickSideMax), min_y_);
  const int to_x = std::min(CellOf(x1), max_x_), to_y = std::min(CellOf(y1), max_y_);
  for (int y = from_y; y <= to_y; ++y) {
    for (int x = from_x; x <= to_x; ++x) {
      const int cell = CellAt(x, y);
      if (cell < 0) continue;
      const Cell& c = cells_[static_cast<std::size_t>(cell)];
      for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
        const Brick b = Unpack(bricks_[i], c);
        const BrickKind& kind = kinds_[static_cast<std::size_t>(b.kind)];
        if (b.x < x1 && b.y < y1 && b.x + kind.width > x0 && b.y + kind.height > y0) {
          out.push_back(b);
        }
      }
    }
  }
  return out;
}

bool FeatherStore::Has(const Brick& brick) const {
  const int cx = CellOf(brick.x), cy = CellOf(brick.y), cell = CellAt(cx, cy);
  if (cell < 0) return false;
  const Cell& c = cells_[static_cast<std::size_t>(cell)];
  const auto begin = bricks_.begin() + c.first;
  return std::binary_search(begin, begin + c.count, Pack(brick, cx, cy));
}

std::size_t FeatherStore::Remove(const std::vector<Brick>& bricks) {
  std::size_t removed = 0;
  for (const Brick& brick : bricks) {
    const int cx = CellOf(brick.x), cy = CellOf(brick.y), cell = CellAt(cx, cy);
    if (cell < 0) continue;
    Cell& c = cells_[static_cast<std::size_t>(cell)];
    const auto begin = bricks_.begin() + c.first, end = begin + c.count;
    const std::uint32_t packed = Pack(brick, cx, cy);
    const auto found = std::lower_bound(begin, end, packed);
    if (found == end || *found != packed) continue;
    std::rotate(found, found + 1, end);  // the rest keeps its order
    --c.count;
    --size_;
    ++removed;
    const auto hung = std::find(hanging_.begin(), hanging_.end(), brick);
    if (hung != hanging_.end()) hanging_.erase(hung);
  }
  return removed;
}

void FeatherStore::Restore(const std::vector<Brick>& bricks) {
  for (const Brick& brick : bricks) {
    const int cx = CellOf(brick.x), cy = CellOf(brick.y), cell = CellAt(cx, cy);
    SEAM_ASSERT(cell >= 0);
    const auto at = static_cast<std::size_t>(cell);
    Cell& c = cells_[at];
    const std::size_t room = (at + 1 < cells_.size() ? cells_[at + 1].first : bricks_.size());
    SEAM_ASSERT(c.first + c.count < room);
    const std::uint32_t packed = Pack(brick, cx, cy);
    const auto begin = bricks_.begin() + c.first, end = begin + c.count;
    const auto place = std::lower_bound(begin, end, packed);
    std::copy_backward(place, end, end + 1);
    *place = packed;
    ++c.count;
    ++size_;
  }
}

}  // namespace seam
