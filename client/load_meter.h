#pragma once
/// How busy this machine is with its ticks: the share of its time that they need.

#include <cstdint>

namespace seam {

class LoadMeter {
 public:
  /// After each call of Tick. `cpu_us`: CPU time used so far, 0: not known. `ticks`: how many were
  /// stepped in this call, `late_us`: how late they were at worst, `tick_us`: how long a tick is.
  void Note(std::int64_t now_us, std::int64_t cpu_us, int ticks, std::int64_t late_us,
            std::int64_t tick_us);

  /// Of the last whole window, in thousandths; -1: not known. It is the CPU time that a tick takes
  /// beside how long it is: a machine that cannot keep up shows by how much. Where CPU time does
  /// not tell, because others have it: when most calls were late by more than a tick and they get
  /// later, or by more than kLateTicks in the mean and they do not get less late, it is kLateLoad
  /// at least. Who was kept from its ticks for a moment and catches up has the time for them, and
  /// so has who is always a little late.
  std::int16_t permille() const { return permille_; }

  static constexpr std::int64_t kWindowUs = 500000;
  static constexpr std::int16_t kLateLoad = 1250;
  /// By how much later or less late, in ticks, the second half of a window has to be than the first
  /// to count: more than calls differ by the order in which a machine does things.
  static constexpr double kTrend = 0.5;
  static constexpr double kLateTicks = 4;

 private:
  /// Calls of one half of a window.
  struct Half {
    int calls = 0;
    std::int64_t late_us = 0;  // of all together
    double mean() const { return static_cast<double>(late_us) / calls; }
  };
  bool TooLate(double tick_us) const;

  std::int64_t began_us_ = -1, began_cpu_us_ = 0;
  std::int64_t due_us_ = 0;  // how long the ticks of the window are together
  int calls_ = 0, late_ = 0;
  Half first_, second_;
  std::int16_t permille_ = -1;
};

}  // namespace seam
