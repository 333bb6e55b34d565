#pragma once
/// Load of a room and lateness of its server, measured from outside. Published once a second as a
/// Load; also histograms of all ticks so far.

#include <cstdint>
#include <vector>

#include "common/base/bucket_histogram.h"
#include "common/base/duration_histogram.h"
#include "server/server.h"

namespace seam {

class LoadWatch {
 public:
  /// Records a call of Server::Tick that began at `begin_us` and took `wall_us`. It stepped the
  /// ticks from `tick_before` to the server's current one, the first of which was due at `due_us`.
  void NoteCall(const Server& server, std::int64_t begin_us, std::int64_t wall_us,
                std::int64_t tick_before, std::int64_t due_us);
  /// Adds CPU time spent on the room.
  void NoteCpu(std::int64_t cpu_us) { cpu_us_ += cpu_us; }
  bool Due(std::int64_t now_us) const { return now_us - told_us_ >= kEveryUs; }
  /// Returns the Load of the time since the last call.
  Load Tell(std::int64_t now_us, const Server& server);

  std::int64_t cpu_us() const { return cpu_us_; }
  /// Wall time of all ticks so far, for percentiles.
  const DurationHistogram& session() const { return session_; }
  /// Wall time of all ticks so far, and the lateness of each, as the page of metrics has them.
  const BucketHistogram& tick_total() const { return wall_total_; }
  const BucketHistogram& late_total() const { return late_total_; }

  static constexpr std::int64_t kEveryUs = 1000000;

 private:
  DurationHistogram wall_, late_;  // ticks since the last Load
  DurationHistogram session_;      // wall time of all ticks
  BucketHistogram wall_total_, late_total_;
  std::int64_t cpu_us_ = 0;
  std::int64_t told_us_ = 0;
};

}  // namespace seam
