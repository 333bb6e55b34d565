#pragma once
/// How busy this machine is with its ticks: the share of its time that they need.

#include <cstdint>

namespace seam {

class LoadMeter {
 public:
  /// After each call of Tick. `cpu_us`: CPU time used so far, 0: not known. `late_us`: how late the
  /// ticks of this call were at worst, `tick_us`: how long a tick is; both 0 if none was due.
  void Note(std::int64_t now_us, std::int64_t cpu_us, std::int64_t late_us, std::int64_t tick_us);

  /// Of the last whole window, in thousandths; -1: not known. Above 1000 it cannot keep up: CPU
  /// time cannot say that, so a window of which most ticks were late by more than a tick counts as
  /// kLateLoad at least.
  std::int16_t permille() const { return permille_; }

  static constexpr std::int64_t kWindowUs = 500000;
  static constexpr std::int16_t kLateLoad = 1250;

 private:
  std::int64_t began_us_ = -1, began_cpu_us_ = 0;
  int ticks_ = 0, late_ = 0;
  std::int16_t permille_ = -1;
};

}  // namespace seam
