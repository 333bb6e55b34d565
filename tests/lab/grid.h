#pragma once
/// All combinations of a sweep file, in a fixed order.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "tests/lab/experiment/values.h"
#include "tests/lab/session.h"

namespace seam {

/// One combination.
struct GridPoint {
  std::shared_ptr<const Scene> scene;  ///< with its settings in it
  SessionSettings settings;            ///< with the defaults of mode and scene filled in
  std::string key;                     ///< GridKey of it as CSV
};

struct Grid {
  std::vector<GridPoint> points;  ///< seeds vary fastest, scenes slowest
  bool floor = true;              ///< compute the floor too
  bool limit = false;             ///< compute the error of held inputs too
};

/// Returns the key of a run: all that is needed to repeat it. Reads the point's scene and settings.
Values GridKey(const GridPoint& point);
/// Returns the network and the scene in numbers, for plots. Loss is the mean without stalls and
/// outages, skin empty where the scene leaves it to the engine.
Values PointValues(const GridPoint& point);

/// Most combinations: a row is 250 bytes of memory.
constexpr std::size_t kGridPointsMax = 1000000;
/// Most settings of a scene, each of which is one more scene in memory.
constexpr std::size_t kGridScenesMax = 10000;

/// Reads and checks the file and every scene in it. Throws OperatorError. Every combination of the
/// result can be run.
Grid ReadGrid(const std::string& path);

}  // namespace seam
