#include "common/scene/bricks.h"

#include "common/base/random.h"

namespace seam {
namespace {

/// Lengths of a building in units, close to real ones.
constexpr int kStorey = 60, kBay = 60, kWindowWidth = 26, kWindowHeight = 30, kSill = 18;

/// Returns the number of bricks of `side` units nearest to `length`, at least one.
int Bricks(int length, int side) {
  const int nearest = (length + side / 2) / side;
  return nearest < 1 ? 1 : nearest;
}

/// Returns a random number in from..to, both inclusive.
int Between(Random& random, int from, int to) {
  const auto span = static_cast<std::uint64_t>(to - from + 1);
  return from + static_cast<int>(random.Next() % span);
}

/// Bays are centred between the side walls, storeys count from the ground; the remainder is wall.
class Windows {
 public:
  Windows(const BrickField& field, int columns, int rows)
      : bay_(Bricks(kBay, field.width)),
        storey_(Bricks(kStorey, field.height)),
        wide_(Bricks(kWindowWidth, field.width)),
        high_(Bricks(kWindowHeight, field.height)),
        sill_(Bricks(kSill, field.height)),
        bays_((columns - 2) / bay_),
        storeys_(rows / storey_),
        columns_(columns),
        left_((columns - bays_ * bay_) / 2) {
    if (wide_ >= bay_ || sill_ + high_ >= storey_) bays_ = 0;  // bricks too large for windows
  }
  /// Returns true if there is a hole. No window is cut by the sides at `aside`, or by the row where
  /// the setback begins.
  bool operator()(int column, int row, int aside, int setback_row) const {
    const int c = column - left_;
    if (c < 0 || c >= bays_ * bay_ || row >= storeys_ * storey_) return false;
    const int within = c % bay_ - (bay_ - wide_) / 2, above = row % storey_ - sill_;
    if (within < 0 || within >= wide_ || above < 0 || above >= high_) return false;
    const int left = column - within, low = row - above;
    const bool walled = left > aside && left + wide_ < columns_ - aside;
    const bool one_part = low > setback_row || low + high_ < setback_row;
    return walled && one_part;
  }

 private:
  int bay_, storey_, wide_, high_, sill_, bays_, storeys_, columns_, left_;
};

/// A tower generated from its seed; most towers are narrower from some row on (the setback).
struct Tower {
  int x = 0;                         // left side, units
  int columns = 0, rows = 0;         // bricks
  int setback = 0, setback_row = 0;  // columns less on each side, from that row on

  Tower(const BrickField& field, int index) {
    const BrickField::Towers& t = field.towers;
    Random random = Random(t.seed).Fork(static_cast<std::uint64_t>(index));
    x = field.x + index * t.pitch;
    columns = Between(random, t.columns_min, t.columns_max);
    rows = Between(random, t.rows_min, t.rows_max);
    setback = Between(random, 0, columns / 5);
    setback_row = rows * Between(random, 50, 90) / 100;
  }
};

bool EachOfTower(const BrickField& field, int index, const std::function<bool(int, int)>& visit) {
  const Tower t(field, index);
  const Windows window(field, t.columns, t.rows);
  for (int row = 0; row < t.rows; ++row) {
    const int aside = row >= t.setback_row ? t.setback : 0;
    for (int column = aside; column < t.columns - aside; ++column) {
      if (field.towers.windows && window(column, row, aside, t.setback_row)) continue;
      if (!visit(t.x + column * field.width, field.y + row * field.height)) return false;
    }
  }
  return true;
}

}  // namespace

void EachBrick(const BrickField& field, const std::function<bool(int, int)>& visit) {
  for (int index = 0; index < field.towers.count; ++index) {
    if (!EachOfTower(field, index, visit)) return;
  }
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      if (!visit(field.x + column * field.width, field.y + row * field.height)) return;
    }
  }
}

void EachBuildingBlock(const BrickField& field,
                       const std::function<void(const BuildingBlock&)>& visit) {
  const auto block = [&](int building, int x, int columns, int row, int rows) {
    const int y = field.y + row * field.height;
    if (columns <= 0 || rows <= 0) return;
    visit({building, x, y, x + columns * field.width, y + rows * field.height});
  };
  for (int index = 0; index < field.towers.count; ++index) {
    const Tower t(field, index);
    const int low = t.setback > 0 ? t.setback_row : t.rows;
    block(index, t.x, t.columns, 0, low);
    block(index, t.x + t.setback * field.width, t.columns - 2 * t.setback, low, t.rows - low);
  }
  block(0, field.x, field.columns, 0, field.rows);
}

int BuildingsOf(const BrickField& field) { return field.towers.count > 0 ? field.towers.count : 1; }

int BuildingAt(const BrickField& field, int x) {
  return field.towers.count > 0 ? (x - field.x) / field.towers.pitch : 0;
}

}  // namespace seam
