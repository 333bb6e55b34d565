#pragma once
/// CPU time of the calling thread: other programs on the machine do not count.

#include <time.h>

namespace seam {

/// us since the thread began. A call costs about 0.3 us.
inline double ThreadCpuUs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

}  // namespace seam
