#pragma once
/// All combinations of a sweep file, in a fixed order.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "tests/lab/session.h"

namespace seam {

/// One combination.
struct GridPoint {
  std::shared_ptr<const Scene> scene;  ///< with its settings in it
  SessionSettings settings;            ///< with the defaults of mode and scene filled in
  /// The first kGridColumns values of its CSV line, quoted: all that is needed to repeat it.
  std::string key;
};

struct Grid {
  std::vector<GridPoint> points;  ///< seeds vary fastest, scenes slowest
  bool floor = true;              ///< compute the floor too
  bool limit = false;             ///< compute the information limit too
};

/// version,scene,scene_hash,set,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed
std::string GridHeader();
constexpr int kGridColumns = 12;
/// Most combinations: a row is 250 bytes of memory.
constexpr std::size_t kGridPointsMax = 1000000;
/// Most settings of a scene, each of which is one more scene in memory.
constexpr std::size_t kGridScenesMax = 10000;

/// Numbers of a network and a scene, for plots:
/// one_way_ms,jitter_ms,loss_percent,tick_hz,substeps,velocity_iterations,position_iterations,
/// skin_m,buffer_m,input_delay_ticks. Loss is the mean without stalls and outages, skin empty where
/// the scene leaves it to the engine.
std::string PointHeader();
/// The values, with a comma before each.
std::string PointValues(const GridPoint& point);

/// Reads and checks the file and every scene in it. Throws OperatorError. Every combination of the
/// result can be run.
Grid ReadGrid(const std::string& path);

}  // namespace seam
