#pragma once
/// A sweep file: lists of what to vary, and all their combinations in a fixed order.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/physics/scene.h"
#include "tests/lab/session.h"

namespace seam {

/// One combination.
struct GridPoint {
  std::shared_ptr<const Scene> scene;
  SessionSettings settings;           ///< with the defaults of mode and scene filled in
  /// The first kGridColumns values of its CSV line, quoted: all that is needed to repeat it.
  std::string key;
};

struct Grid {
  std::vector<GridPoint> points;      ///< seeds vary fastest, scenes slowest
  bool floor = true;                  ///< compute the floor too
};

/// version,scene,scene_hash,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed
std::string GridHeader();
constexpr int kGridColumns = 11;
/// Most combinations: a row is 250 bytes of memory.
constexpr std::size_t kGridPointsMax = 1000000;

/// Reads and checks the file and every scene it names. Throws OperatorError: every combination of
/// what it returns can be run.
Grid ReadGrid(const std::string& path);

/// A CSV field as RFC 4180 wants it.
std::string CsvField(const std::string& text);

}  // namespace seam
