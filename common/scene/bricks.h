#pragma once
/// Anchored bricks by the million: what a scene says of them. They are no parts and no bodies.
///
/// All lengths are whole numbers of units of 5 cm, so that bricks which touch do so exactly, and
/// what is derived from them (outlines, pieces) is the same on every machine.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// m. Box2D refuses chains whose points are 5 mm apart; a rim moved in takes 1.5 cm of an edge.
constexpr float kBrickUnit = 0.05f;
/// In one scene, and sides of one in units (10 cm to 4 m).
constexpr std::size_t kBricksMax = 2000000, kBrickFieldsMax = 64;
constexpr int kBrickSideMin = 2, kBrickSideMax = 80;

/// A rectangle of bricks, or a row of towers of them.
struct BrickField {
  std::string name;            ///< unique
  int width = 10, height = 5;  ///< of a brick, units
  int x = 0, y = 0;            ///< lower left corner of the first, units
  int columns = 0, rows = 0;   ///< of a rectangle; 0: towers
  struct Towers {
    int count = 0;
    int pitch = 0;  ///< from one's left side to the next one's, units
    int columns_min = 1, columns_max = 1, rows_min = 1, rows_max = 1;
    bool windows = false;
    std::uint64_t seed = 0;  ///< of widths, heights and setbacks
  } towers;
  float density = 1;                       ///< kg/m^2, of what a blast frees
  float friction = 0.5f, restitution = 0;  ///< 0..1
  float strength = 0;                      ///< m/s: weaker blasts do not free it
  int line = 0;                            ///< in the scene file
};

/// Calls `visit(x, y)` with the lower left corner (units) of each brick, always in the same order,
/// until one call returns false.
void EachBrick(const BrickField& field, const std::function<bool(int, int)>& visit);

/// A rectangle that bricks of one field fill, but for windows. Units; the upper right is outside.
struct Storeys {
  int building = 0;  ///< which tower; 0 for a rectangle of bricks
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Calls `visit` with each block, building by building: one of a rectangle, one or two (where it
/// stands back) of a tower.
void EachStoreys(const BrickField& field, const std::function<void(const Storeys&)>& visit);

/// How many buildings a field has, and which of them its brick with the left side `x` belongs to.
int BuildingsOf(const BrickField& field);
int BuildingAt(const BrickField& field, int x);

}  // namespace seam
