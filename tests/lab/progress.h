#pragma once
/// How far a sweep is and how long it will take at the mean pace so far: on a terminal a line that
/// renews itself, elsewhere a line a minute.

#include <cstddef>
#include <cstdint>

namespace seam {

class Progress {
 public:
  Progress(std::size_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` of the total so far.
  void operator()(std::size_t done);

 private:
  std::size_t total_;
  bool quiet_, terminal_, shown_ = false;
  std::int64_t begin_us_, last_us_;
};

}  // namespace seam
