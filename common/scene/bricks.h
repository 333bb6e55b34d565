#pragma once
/// Anchored bricks by the million, as a scene describes them. They are neither parts nor bodies.
///
/// All lengths are whole numbers of units of 5 cm, so that touching bricks touch exactly, and
/// everything derived from them (outlines, pieces) is the same on every machine.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// m. Box2D refuses chains with points 5 mm apart; moving a rim inwards takes 1.5 cm of an edge.
constexpr float kBrickUnit = 0.05f;
/// Limits of one scene, and of a brick's sides in units (10 cm to 4 m).
constexpr std::size_t kBricksMax = 2000000, kBrickFieldsMax = 64;
constexpr int kBrickSideMin = 2, kBrickSideMax = 80;

/// A rectangle of bricks, or a row of towers of them.
struct BrickField {
  std::string name;            ///< unique
  int width = 10, height = 5;  ///< one brick, units
  int x = 0, y = 0;            ///< lower left corner of the first brick, units
  int columns = 0, rows = 0;   ///< 0: the field is towers
  struct Towers {
    int count = 0;
    int pitch = 0;  ///< from one left side to the next, units
    int columns_min = 1, columns_max = 1, rows_min = 1, rows_max = 1;
    bool windows = false;
    std::uint64_t seed = 0;  ///< seeds widths, heights and setbacks
  } towers;
  float density = 1;                       ///< kg/m^2, of freed bricks
  float friction = 0.5f, restitution = 0;  ///< 0..1
  float strength = 0;                      ///< m/s: a blast slower than this does not free a brick
  int line = 0;                            ///< line in the scene file
};

/// Calls `visit(x, y)` with the lower left corner (units) of each brick, always in the same order,
/// until one call returns false.
void EachBrick(const BrickField& field, const std::function<bool(int, int)>& visit);

/// A rectangle filled with bricks of one field, except for windows. Units; the upper right corner
/// is exclusive.
struct BuildingBlock {
  int building = 0;  ///< index of the tower; 0 for a rectangle of bricks
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Calls `visit` with each block, building by building: a rectangle has one block; a tower has one,
/// or two if its upper part is set back.
void EachBuildingBlock(const BrickField& field,
                       const std::function<void(const BuildingBlock&)>& visit);

/// Return the number of buildings of a field, and the building of its brick with left side `x`.
int BuildingsOf(const BrickField& field);
int BuildingAt(const BrickField& field, int x);

}  // namespace seam
