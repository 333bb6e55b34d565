#pragma once
/// Decides when the gains of a mechanism beside physics are no chance, by cumulative sums (Page,
/// "Continuous inspection schemes", 1954), one for each direction:
///
///   sum = max(0, sum + min(x, kCountsMost) - 1 - kShare s)      x: gain in units of one that is
///   honest
///                                                         s: deviation of successive gains
///
/// Slips of a character are so small that rare great ones would hide a small steady lie in s. So
/// they are also summed without s, in a smaller unit, where a great one counts little (kFinest).
///
/// An honest gain has no direction, so that its sum stays near 0 however great it is in chaos, as
/// chaos makes s great. A lie adds up. It counts while a sum is above kLie.

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/sync/audit/spare_world.h"

namespace seam {

class SteadyGain {
 public:
  void Add(const Gain& gain);
  /// Counts whether the client has told all that a comparison needs: leaving it out again and again
  /// counts as the greatest gain.
  void NoteAllTold(bool all);
  /// True if the gains so far are no chance.
  bool lies() const { return share() > 1; }
  /// True if only omissions say so.
  bool leaves_out() const { return lies() && share_of_gains() <= 1; }
  /// True if the newest gain was as great as any counts, and that is far from chance.
  bool gross() const { return gross_ && share() > kGrossShare; }
  /// Greatest sum, as a share of the one that counts.
  double share() const { return std::max(share_of_gains(), left_out_ / kLie); }

  /// Honest gains: of velocity, m/s in each second; of place, m in each second; of a body relative
  /// to its mechanism, m.
  static constexpr double kPush = 0.15, kSlip = 0.04, kTorn = 0.05;
  /// The greatest counted gain, the weight of the deviation, and the sum that counts, all in
  /// units of an honest gain. A greater kLie finds lies later, a smaller one doubts chaos.
  static constexpr double kCountsMost = 8, kShare = 1, kLie = 20;
  static constexpr double kGrossShare = 1.5;  ///< share of a lie
  /// An honest gain is so many times as great where a mechanism touches others: two worlds part
  /// there, as forces of contacts are not told. A summed one's places are not.
  static constexpr double kInCompany = 8;
  /// An honest slip that is summed, m in each second, and how many of these count at most.
  static constexpr double kFineSlip = 0.02, kFinest = 3;

 private:
  double share_of_gains() const;
  void AddFine(const Eigen::Vector2d& slip, double along);

  /// Sums of gains along and against one direction.
  struct Sums {
    double up = 0, down = 0;
    double before = 0, square = 0;  // the gain before, and the mean square of the change since it
    void Add(double x);
    void AddFine(double x);
    void AddTo(double x, double honest);
  };

  std::array<Sums, 7> sums_;
  std::array<Sums, 3> fine_;  // of slips
  double left_out_ = 0;
  bool gross_ = false;
};

}  // namespace seam
