#pragma once
/// What a room costs and whether its server keeps up, measured from outside of it and told once a
/// second as a Load; and all ticks so far, counted.

#include <cstdint>
#include <vector>

#include "common/base/bucket_histogram.h"
#include "common/base/duration_histogram.h"
#include "server/load/traffic_count.h"
#include "server/server.h"

namespace seam {

class LoadWatch {
 public:
  /// A call of Server::Tick: it began at `begin_us` and took `wall_us`; from `tick_before` on it
  /// stepped the ticks up to the server's, the first of which was due at `due_us`.
  void NoteCall(const Server& server, std::int64_t begin_us, std::int64_t wall_us,
                std::int64_t tick_before, std::int64_t due_us);
  /// CPU time that was spent on the room.
  void NoteCpu(std::int64_t cpu_us) { cpu_us_ += cpu_us; }
  bool Due(std::int64_t now_us) const { return now_us - told_us_ >= kEveryUs; }
  /// Of the time since the last one.
  Load Tell(std::int64_t now_us, const Server& server, const TrafficCount& traffic);

  std::int64_t cpu_us() const { return cpu_us_; }
  /// Wall time of all ticks so far, and how long after it was due each began.
  const BucketHistogram& tick_total() const { return wall_total_; }
  const BucketHistogram& late_total() const { return late_total_; }

  static constexpr std::int64_t kEveryUs = 1000000;

 private:
  void CountHandOvers(const Server& server);

  DurationHistogram wall_, late_;  // of the ticks since the last Load
  BucketHistogram wall_total_, late_total_;
  std::int64_t cpu_us_ = 0;
  std::int64_t told_us_ = 0;
  std::int64_t hand_overs_ = 0;
  int revision_ = -1;         // of what holders_ is about
  std::vector<int> holders_;  // by mechanism, when we last looked
};

}  // namespace seam
