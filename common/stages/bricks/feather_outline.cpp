#include "common/stages/bricks/feather_outline.h"

#include "common/stages/bricks/feather_raster.h"

namespace seam {
namespace {

Heading Left(Heading d) { return static_cast<Heading>((d + 1) % 4); }
Heading Right(Heading d) { return static_cast<Heading>((d + 3) % 4); }

/// A side of a solid square, to the right of the direction `way` as seen from the square's centre.
///
///        <- kWest        Counter-clockwise around the solid:
///       +---+            the sides of one square.
///  kSouth|   |kNorth
///       +---+
///        kEast ->
struct Side {
  int column = 0, row = 0;
  Heading way = kEast;

  Side Beyond(Heading d) const {
    constexpr int kDx[] = {1, 0, -1, 0}, kDy[] = {0, 1, 0, -1};
    return {column + kDx[d], row + kDy[d], way};
  }
  Side Turned(Heading d) const { return {column, row, d}; }
  bool operator==(const Side& o) const {
    return column == o.column && row == o.row && way == o.way;
  }
};

class Tracer {
 public:
  explicit Tracer(const FeatherRaster& raster)
      : raster_(raster),
        seen_(static_cast<std::size_t>(4 * raster.columns() * raster.rows()), false) {}

  std::vector<OutlinePath> Run() {
    // Open paths come first: all remaining ones are closed.
    Scan([&](const Side& side) {
      if (!Same(Before(side), side)) Trace(side, false);
    });
    Scan([&](const Side& side) {
      Side first = side;
      while (Before(first).way == first.way) first = Before(first);  // begin at a corner
      Trace(first, true);
    });
    return std::move(paths_);
  }

 private:
  bool Solid(const Side& s) const { return raster_.Solid(s.column, s.row); }
  int Surface(const Side& s) const { return raster_.Surface(s.column, s.row); }
  bool Same(const Side& a, const Side& b) const { return Surface(a) == Surface(b); }

  /// Returns the boundary's next side. Where two solids touch only at a corner, stays with its own
  /// solid.
  Side Next(const Side& s) const {
    const Side ahead = s.Beyond(s.way), aside = ahead.Beyond(Right(s.way));
    if (!Solid(ahead)) return s.Turned(Left(s.way));
    if (!Solid(aside)) return ahead;
    return aside.Turned(Right(s.way));
  }
  /// Returns the previous side: Next(Before(s)) is s.
  Side Before(const Side& s) const {
    const Side behind = s.Beyond(Left(Left(s.way))), aside = behind.Beyond(Right(s.way));
    if (!Solid(behind)) return s.Turned(Right(s.way));
    if (!Solid(aside)) return behind;
    return aside.Turned(Left(s.way));
  }

  template <typename Visit>
  void Scan(const Visit& visit) {
    for (int row = 1; row + 1 < raster_.rows(); ++row) {
      for (int column = 1; column + 1 < raster_.columns(); ++column) {
        if (!raster_.Solid(column, row)) continue;
        for (const Heading way : {kEast, kNorth, kWest, kSouth}) {
          const Side side{column, row, way};
          if (!Solid(side.Beyond(Right(way))) && !seen_[IndexOf(side)]) visit(side);
        }
      }
    }
  }

  void Trace(const Side& first, bool closed) {
    OutlinePath path;
    path.closed = closed;
    path.surface = Surface(first);
    Heading before = Before(first).way;
    Side side = first;
    do {
      if (side.way != before || (!closed && side == first)) AddCorner(side, before, &path);
      seen_[IndexOf(side)] = true;
      before = side.way;
      side = Next(side);
    } while (Same(side, first) && !(side == first));
    if (!closed) {
      // End of the last side: the start of the side after it.
      AddCorner(side, before, &path);
    }
    paths_.push_back(std::move(path));
  }

  /// Adds the start of `side`.
  void AddCorner(const Side& side, Heading before, OutlinePath* path) const {
    const int right = side.way == kNorth || side.way == kWest;
    const int up = side.way == kWest || side.way == kSouth;
    path->corners.push_back(
        {raster_.x(side.column + right), raster_.y(side.row + up), before, side.way});
  }

  std::size_t IndexOf(const Side& s) const {
    return static_cast<std::size_t>(4 * (s.row * raster_.columns() + s.column) + s.way);
  }

  const FeatherRaster& raster_;
  std::vector<bool> seen_;
  std::vector<OutlinePath> paths_;
};

}  // namespace

std::vector<OutlinePath> OutlinesOf(const FeatherStore& store, int cell_x, int cell_y) {
  const FeatherRaster raster(store, cell_x, cell_y);
  return Tracer(raster).Run();
}

}  // namespace seam
