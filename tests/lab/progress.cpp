#include "tests/lab/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "common/base/process.h"

namespace seam {
namespace {

std::string Span(double seconds) {
  const auto s = static_cast<std::int64_t>(seconds);
  if (s < 60) return fmt::format("{} s", s);
  return s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60)
                  : fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

}  // namespace

Progress::Progress(std::size_t total, bool quiet)
    : total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      begin_us_(SteadyClockUs()),
      last_us_(begin_us_) {}

Progress::~Progress() {
  if (shown_ && terminal_) std::fputc('\n', stderr);
}

void Progress::operator()(std::size_t done) {
  const std::int64_t now_us = SteadyClockUs();
  if (quiet_ || now_us - last_us_ < (terminal_ ? 200000 : 60000000)) return;
  last_us_ = now_us;
  const double pace = static_cast<double>(now_us - begin_us_) / static_cast<double>(done);
  std::fprintf(stderr, "%s%zu of %zu runs, about %s left%s", terminal_ ? "\r" : "", done, total_,
               Span(pace * static_cast<double>(total_ - done) * 1e-6).c_str(),
               terminal_ ? "      " : "\n");
  shown_ = true;
}

}  // namespace seam
