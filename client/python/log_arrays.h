#pragma once
/// A recording as arrays by tick and body, for the Python module.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/measure/measure.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// The bodies of one view, or of the oracle. Arrays are [tick][body] or [tick][body][3], with NaN,
/// -1 where a tick lacks a body.
struct BodyArrays {
  std::vector<PartId> ids;        ///< ascending
  std::vector<float> poses;       ///< x, y, angle: m, m, rad
  std::vector<float> velocities;  ///< vx, vy, spin: m/s, m/s, rad/s
  std::vector<float> ages;        ///< ticks; the pose is that of so long before
  std::vector<std::int16_t> authority;
  std::vector<double> errors;  ///< m, distance from the oracle at the tick that is shown
};

/// A log, read whole. The oracle is computed when it is first needed.
class LogArrays {
 public:
  /// Throws OperatorError as ReadRecording and RecordedScene do.
  LogArrays(const std::string& path, const std::string& room, const std::string& session);

  const Recording& recording() const { return recording_; }
  const Scene& scene() const { return scene_; }
  std::int64_t ticks() const { return recording_.last_tick - recording_.first_tick + 1; }
  /// Returns a part's name; "part 7" for one that was inserted at run time.
  std::string NameOf(PartId id) const;
  /// Throws OperatorError if no such peer has published a view, or the oracle cannot be computed.
  BodyArrays View(int peer, bool errors);
  /// Throws OperatorError if it cannot be computed.
  BodyArrays OracleBodies();
  /// Returns all measures, with the response; `valid` is WhyNotValid.
  Measures MeasureAll(std::string* valid);

 private:
  const Oracle& TheOracle();
  BodyArrays Empty(std::vector<PartId> ids) const;

  Recording recording_;
  Scene scene_;
  std::unique_ptr<const Oracle> oracle_;
};

}  // namespace seam
