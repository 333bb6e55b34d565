#pragma once
/// Conditions that every hard case must meet: no divergence, no explosion, no body outside its
/// room.

#include <limits>
#include <string>
#include <vector>

#include "tests/lab/hard/hard_case.h"

namespace seam {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// A rectangle of the world, m.
struct Enclosure {
  double min_x = -kNoLimit, min_y = -kNoLimit, max_x = kNoLimit, max_y = kNoLimit;
};

struct WatchLimits {
  /// m/s: a faster body counts as an explosion. Well above every speed that the case can reach
  /// honestly, such as that of a fall.
  double speed_mps = kNoLimit;
  Enclosure room;  ///< a body whose position is outside escaped
};

/// Reads every body once a tick, and keeps the first violation.
class Watch : public Judge {
 public:
  explicit Watch(const WatchLimits& limits) : limits_(limits) {}
  void See(const World& world) final;
  double Error() const final;
  std::string Failure() const override { return failure_; }

 protected:
  /// Called by See with finite states() only; `t` in s since tick 0.
  virtual void Look(const World& world, double t) = 0;
  /// Returns the error unless the world diverged.
  virtual double Value() const = 0;

  const std::vector<BodyState>& states() const { return states_; }
  /// "`what` at 12.3 s", unless something else failed before.
  void Fail(const std::string& what, double t);

 private:
  const WatchLimits limits_;
  std::vector<BodyState> states_;
  std::string failure_;
  bool diverged_ = false;
};

}  // namespace seam
