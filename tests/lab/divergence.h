#pragma once
/// First divergence of two recordings: tick, peer, body and field in which their views differ.

#include <cstdint>
#include <optional>
#include <string>

#include "common/record/recording.h"

namespace seam {

struct RunDifference {
  std::int64_t tick = 0;
  int peer = 0;
  /// -1: the whole view is in one of the two only.
  int body = -1;
  /// "x", ..., "authority"; "" when the body is in one of the two only.
  std::string field;
  const char* unit = "";
  double a = 0, b = 0;     ///< the values; not for a missing view or body
  bool only_in_a = false;  ///< of a missing view or body: which of the two has it
};

struct Comparison {
  std::int64_t equal_views = 0;  ///< before the divergence, or all
  std::optional<RunDifference> first;
};

/// Compares tick by tick, then by peer, body id and field (x, y, angle, vx, vy, spin, role,
/// authority), bit by bit. `peer` >= 0: that peer's views alone. `common`: only views that both
/// have, for logs that lost messages or are of different length.
Comparison CompareViews(const Recording& a, const Recording& b, int peer, bool common);

}  // namespace seam
