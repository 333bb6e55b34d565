#include "tests/lab/progress.h"

#include <fmt/format.h>

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
    : total_(total), line_(quiet, 200000), begin_us_(SteadyClockUs()) {}

void Progress::operator()(std::size_t done) {
  const std::int64_t now_us = SteadyClockUs();
  if (!line_.Due(now_us)) return;
  const double pace = static_cast<double>(now_us - begin_us_) / static_cast<double>(done);
  line_.Show(now_us, fmt::format("{} of {} runs, about {} left", done, total_,
                                 Span(pace * static_cast<double>(total_ - done) * 1e-6)));
}

}  // namespace seam
