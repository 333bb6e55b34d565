#pragma once
/// How far a sweep is and how long it will take at the mean pace so far.

#include <cstddef>
#include <cstdint>

#include "common/base/progress_line.h"

namespace seam {

class Progress {
 public:
  Progress(std::size_t total, bool quiet);
  /// `done` of the total so far.
  void operator()(std::size_t done);

 private:
  std::size_t total_;
  ProgressLine line_;
  std::int64_t begin_us_;
};

}  // namespace seam
