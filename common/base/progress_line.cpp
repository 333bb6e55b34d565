#include "common/base/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "common/base/check.h"

namespace seam {

ProgressLine::ProgressLine(bool quiet, std::int64_t every_us)
    : shown_(!quiet && isatty(STDERR_FILENO) != 0), every_us_(every_us) {}

ProgressLine::~ProgressLine() { End(); }

void ProgressLine::Show(std::int64_t now_us, const std::string& text) {
  SEAM_ASSERT(Due(now_us));
  next_us_ = now_us + every_us_;
  const std::size_t rest = columns_ - std::min(columns_, text.size());
  std::fprintf(stderr, "\r%s%s", text.c_str(), std::string(rest, ' ').c_str());
  columns_ = text.size();
}

void ProgressLine::End() {
  if (columns_ > 0) std::fputc('\n', stderr);
  columns_ = 0;
}

}  // namespace seam
