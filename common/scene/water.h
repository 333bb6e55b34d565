#pragma once
/// A body of water as data: `[[water]]` of a scene file.

#include <string>

#include "common/scene/types.h"

namespace seam {

/// Method of computing the submerged area and its centroid.
enum class Buoyancy {
  kVoxel,  ///< cells of the body's bounding box, each submerged by its depth
  kExact   ///< the shapes clipped by the water's outline
};

struct Water {
  std::string name;                ///< unique among waters
  Vec2 min{-10, -10}, max{10, 0};  ///< m; lower left and upper right corner; the level is max.y
  float density = 1;               ///< kg/m^2
  Vec2 flow{0, 0};                 ///< m/s
  float drag_normal = 1;           ///< coefficient of form drag on edges that face the flow
  float drag_tangent = 0.05f;      ///< coefficient of friction along edges
  float viscosity = 0.5f;          ///< kg/(m^2 s): linear drag per submerged area
  Buoyancy method = Buoyancy::kExact;
  int cells = 2;  ///< kVoxel: columns and rows, 2..32
};

}  // namespace seam
