#pragma once
/// One session by one method, as its players would judge it: response, errors, standing pictures,
/// bytes and CPU time, side by side for methods with quite different ideas.

#include <optional>
#include <string>

#include "common/measure/measure.h"
#include "tests/lab/session.h"

namespace seam {

struct RivalFigures {
  std::string invalid;  ///< why the figures say nothing; "" if they do
  Measures measures;    ///< with the response
  /// Of the clients' screens: time in which no new picture came although a tick's time had passed,
  /// ms a second; and the longest such time, ms.
  double frozen_ms_per_s = 0, frozen_longest_ms = 0;
  double speed = 0;  ///< of the room, as a share of real time
  double kbps = 0;   ///< kB/s of UDP payload to and from a client, in real time
  double server_ms_per_s = 0, client_ms_per_s = 0;  ///< CPU time, the recording included
  std::int64_t stepped_again = 0;                   ///< ticks, of all peers
};

/// Runs the session to its end. A session in which worlds have parted is not valid. Throws
/// OperatorError as Cluster does.
RivalFigures MeasureRival(const SessionSettings& settings, const Scene& scene);

/// Sets the figures of standing pictures and of the room's speed.
void MeasureFrozen(const Recording& recording, RivalFigures* figures);

}  // namespace seam
