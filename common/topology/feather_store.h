#pragma once
/// A scene's bricks in 4 bytes each, by cells of 8 m.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/scene/bricks.h"
#include "common/scene/feature.h"

namespace seam {

/// A single brick. Units of 5 cm.
struct Brick {
  int x = 0, y = 0;  ///< lower left corner
  int kind = 0;      ///< index into Scene::bricks, and FeatherStore::kinds()

  bool operator==(const Brick& o) const { return x == o.x && y == o.y && kind == o.kind; }
};

/// Properties common to the bricks of one field.
struct BrickKind {
  int width = 0, height = 0;  ///< units
  int surface = 0;            ///< equal for equal friction and restitution
  float density = 1, friction = 0.5f, restitution = 0, strength = 0;
};

/// Bricks are stored by the cell of their lower left corner; a brick may reach into the next cell.
///
///   cell (0, 0)            cell (1, 0)         one brick: x 8 bits, y 8 bits, kind 16 bits
///   |0 units ......... 160|0 ......... 160|
class FeatherStore {
 public:
  static constexpr int kCell = 160;  ///< units: 8 m
  /// Returns the cell that a coordinate (units) lies in.
  static int CellOf(int units) {
    return units >= 0 ? units / kCell : -((-units + kCell - 1) / kCell);
  }

  /// Requires a checked scene: at most kBricksMax bricks, coordinates within 30 km.
  explicit FeatherStore(const FeatureList<BrickField>& fields);

  std::size_t size() const { return size_; }
  const std::vector<BrickKind>& kinds() const { return kinds_; }
  /// Memory held, bytes.
  std::size_t bytes() const;

  /// Number of cells that bricks have ever overlapped; cells are 0..cell_count()-1.
  int cell_count() const { return static_cast<int>(cells_.size()); }
  /// Returns the cell's index; -1 if no brick was ever there.
  int CellAt(int cell_x, int cell_y) const;
  int cell_x(int cell) const { return cells_[static_cast<std::size_t>(cell)].x; }
  int cell_y(int cell) const { return cells_[static_cast<std::size_t>(cell)].y; }
  /// Smallest range that contains all cells. Requires cell_count() > 0.
  int cell_x_min() const { return min_x_; }
  int cell_x_max() const { return max_x_; }
  int cell_y_min() const { return min_y_; }
  int cell_y_max() const { return max_y_; }
  /// Appends the bricks of a cell, by kind, then y, then x.
  void Append(int cell, std::vector<Brick>* out) const;
  /// Returns the bricks that overlap x0..x1, y0..y1 (units), by cells from below, from the left.
  std::vector<Brick> InBox(int x0, int y0, int x1, int y1) const;

  bool Has(const Brick& brick) const;
  /// Removes bricks; returns how many were present.
  std::size_t Remove(const std::vector<Brick>& bricks);
  /// Present bricks that nothing supports (feather_fall.h). Remove() also removes from this list.
  const std::vector<Brick>& hanging() const { return hanging_; }
  void SetHanging(std::vector<Brick> hanging) { hanging_ = std::move(hanging); }
  /// Puts removed bricks back where they were.
  void Restore(const std::vector<Brick>& bricks);

 private:
  struct Cell {
    std::int16_t x = 0, y = 0;
    std::uint32_t first = 0, count = 0;  // in bricks_, ascending; room until the next cell's
  };
  static std::uint32_t Pack(const Brick& brick, int cell_x, int cell_y);
  static Brick Unpack(std::uint32_t packed, const Cell& cell) {
    return {cell.x * kCell + static_cast<int>(packed & 0xff),
            cell.y * kCell + static_cast<int>(packed >> 8 & 0xff), static_cast<int>(packed >> 16)};
  }
  void Fill(const FeatureList<BrickField>& fields);

  std::vector<std::uint32_t> bricks_;
  std::vector<Cell> cells_;  // ascending by y, x
  std::vector<BrickKind> kinds_;
  std::vector<Brick> hanging_;
  std::size_t size_ = 0;
  int min_x_ = 0, max_x_ = 0, min_y_ = 0, max_y_ = 0;
};

}  // namespace seam
