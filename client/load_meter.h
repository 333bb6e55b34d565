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
  /// not tell, because others have it: when most calls were late by more than a tick it is
  /// kLateLoad at least.
  std::int16_t permille() const { return permille_; }

  static constexpr std::int64_t kWindowUs = 500000;
  static constexpr std::int16_t kLateLoad = 1250;

 private:
  std::int64_t began_us_ = -1, began_cpu_us_ = 0;
  std::int64_t due_us_ = 0;  // how long the ticks of the window are together
  int calls_ = 0, late_ = 0;
  std::int16_t permille_ = -1;
};

}  // namespace seam
