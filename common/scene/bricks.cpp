#include "common/scene/bricks.h"

#include "common/base/random.h"

namespace seam {
namespace {

/// Lengths of a building in units, nearest to what people build.
constexpr int kStorey = 60, kBay = 60, kWindowWidth = 26, kWindowHeight = 30, kSill = 18;

/// Bricks of `side` units that come nearest to `length`, at least one.
int Bricks(int length, int side) {
  const int nearest = (length + side / 2) / side;
  return nearest < 1 ? 1 : nearest;
}

/// From..to inclusive.
int Between(Random& random, int from, int to) {
  const auto span = static_cast<std::uint64_t>(to - from + 1);
  return from + static_cast<int>(random.Next() % span);
}

/// Bays lie centred between the side walls, storeys from the ground up; what is left over is wall.
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
  /// Whether there is a hole. No window is cut by the sides at `aside`, or by the row from which on
  /// the tower stands back.
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

bool EachOfTower(const BrickField& field, int index, const std::function<bool(int, int)>& visit) {
  const BrickField::Towers& t = field.towers;
  Random random = Random(t.seed).Fork(static_cast<std::uint64_t>(index));
  const int columns = Between(random, t.columns_min, t.columns_max);
  const int rows = Between(random, t.rows_min, t.rows_max);
  // The upper part of most towers stands back, from between half and nine tenths of the height.
  const int setback = Between(random, 0, columns / 5);
  const int setback_row = rows * Between(random, 50, 90) / 100;
  const Windows window(field, columns, rows);
  const int x = field.x + index * t.pitch;
  for (int row = 0; row < rows; ++row) {
    const int aside = row >= setback_row ? setback : 0;
    for (int column = aside; column < columns - aside; ++column) {
      if (t.windows && window(column, row, aside, setback_row)) continue;
      if (!visit(x + column * field.width, field.y + row * field.height)) return false;
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

}  // namespace seam
