#pragma once
/// Sums the differences between told states and the server's copies, each too small for a doubt. A
/// copy goes on from the last told state, so that an engine that is 2 % too strong differs by
/// millimetres in each message. Honest differences have no direction and cancel; a lie adds up.
///
///   sum = sum k + difference            along the motion, and along each axis; k: exp(-dt / T)
///   chance = sqrt(chance^2 k^2 + difference^2)              deviation of a sum without direction
///
/// It counts above a bound, and above kChances times chance: chaos makes a few that are great. Only
/// while it is not below its mean of late: what once differed and agrees again is no lie.

#include <cstdint>

#include "common/sync/replica.h"
#include "common/sync/table/body_column.h"

namespace seam {

class Drift {
 public:
  /// `replica` must outlive this.
  explicit Drift(const Replica& replica);

  /// Adds the difference `off` of a told state from the server's copy of that tick; requires
  /// ascending ticks of a body.
  void Add(int body, std::int64_t tick, const BodyState& copy, const BodyState& off);
  /// True if the sum is more than chance explains, and does not fall.
  bool Lies(int body) const;
  /// Greatest sum of a body so far, as a share of the one that counts.
  float greatest() const { return greatest_; }

  /// Time constant of the sums, s. Longer finds smaller lies, later.
  static constexpr float kDriftForgetS = 10;
  /// Sums that count, m and m/s: ten times the greatest of honest clients.
  static constexpr float kDriftWay = 0.15f, kDriftVelocity = 0.3f;
  static constexpr float kChances = 3;

 private:
  /// Sums along the motion, x and y, and the squares of their chances.
  struct Sums {
    Eigen::Array3f sum{0, 0, 0}, chance2{0, 0, 0};
  };
  struct Track {
    int holder = -1;
    std::int64_t tick = 0;  // of the newest difference
    BodyState left;         // that difference, if it is too small to correct the copy
    Sums moved, kicked;     // m, m/s
    float of_late = 0;      // mean of the sums' share
    bool falls = false;     // the share is below it
  };

  static float Share(const Sums& sums, float bound);
  float Share(const Track& track) const;

  const Replica& replica_;
  BodyColumn<Track> tracks_;
  float greatest_ = 0;
};

}  // namespace seam
