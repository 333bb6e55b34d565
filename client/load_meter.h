#pragma once
/// Measures this machine's load: the share of its time that its ticks need.

#include <cstdint>

namespace seam {

class LoadMeter {
 public:
  /// Call after each call of Tick. `cpu_us`: CPU time used so far, 0: not known. `ticks`: number of
  /// ticks stepped in this call; `late_us`: their worst lateness; `tick_us`: duration of a tick.
  void Note(std::int64_t now_us, std::int64_t cpu_us, int ticks, std::int64_t late_us,
            std::int64_t tick_us);

  /// Returns the load of the last whole window, in thousandths; -1: not known. It is the CPU time
  /// of the ticks over their duration, which may exceed 1000. CPU time does not show a machine busy
  /// with other programs. So the load is at least kLateLoad if most calls were late by more than a
  /// tick and their lateness grows, or exceeds kLateTicks in the mean and does not shrink. A client
  /// that was interrupted for a moment and catches up has enough time, and so has one with a
  /// constant small lateness.
  std::int16_t permille() const { return permille_; }

  static constexpr std::int64_t kMeterUs = 500000;
  static constexpr std::int16_t kLateLoad = 1250;
  /// Least change of lateness between the two halves of a window to count as a trend, in ticks:
  /// more than calls differ by scheduling.
  static constexpr double kTrend = 0.5;
  static constexpr double kLateTicks = 4;

 private:
  /// The calls in one half of a window.
  struct Half {
    int calls = 0;
    std::int64_t late_us = 0;  // sum of all calls
    double mean() const { return static_cast<double>(late_us) / calls; }
  };
  bool TooLate(double tick_us) const;

  std::int64_t began_us_ = -1, began_cpu_us_ = 0;
  std::int64_t due_us_ = 0;  // sum of the durations of the window's ticks
  int calls_ = 0, late_ = 0;
  Half first_, second_;
  std::int16_t permille_ = -1;
};

}  // namespace seam
