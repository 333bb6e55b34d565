#include "common/base/progress_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "common/base/check.h"

namespace seam {
namespace {

/// Returns the usable columns of the terminal; no limit if its width is unknown. One column stays
/// free, because a wrapped line cannot be rewritten in place.
std::size_t ColumnsOfTerminal() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return std::string::npos;
  return size.ws_col - 1u;
}

}  // namespace

ProgressLine::ProgressLine(bool quiet, std::int64_t every_us)
    : shown_(!quiet && isatty(STDERR_FILENO) != 0), every_us_(every_us) {}

ProgressLine::~ProgressLine() { End(); }

void ProgressLine::Show(std::int64_t now_us, const std::string& text) {
  SEAM_ASSERT(Due(now_us));
  next_us_ = now_us + every_us_;
  const std::string line = text.substr(0, ColumnsOfTerminal());
  const std::size_t rest = columns_ - std::min(columns_, line.size());
  std::fprintf(stderr, "\r%s%s", line.c_str(), std::string(rest, ' ').c_str());
  columns_ = line.size();
}

void ProgressLine::End() {
  if (columns_ > 0) std::fputc('\n', stderr);
  columns_ = 0;
}

}  // namespace seam
