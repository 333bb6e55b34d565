#include "common/base/progress_count.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/process.h"

namespace seam {
namespace {

/// Time between two updates of the line, us.
constexpr std::int64_t kLineEveryUs = 200000;
/// Shortest time from which a rate is meaningful, s.
constexpr double kRateFrom_s = 0.2;

/// Formats a rate with its significant digits: "3.2", "120".
std::string Rate(double per_s) {
  return per_s < 10 ? fmt::format("{:.1f}", per_s) : fmt::format("{:.0f}", per_s);
}

}  // namespace

std::string SpanText(double seconds) {
  const auto s = static_cast<std::int64_t>(seconds);
  if (seconds < 1) return fmt::format("{:.0f} ms", 1000 * std::max(0.0, seconds));
  if (s < 60) return fmt::format("{} s", s);
  return s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60)
                  : fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

std::string ProgressText(const std::string& what, const std::string& unit, std::int64_t done,
                         std::int64_t total, double elapsed_s) {
  std::string text = fmt::format("{}: {} {}", what, done, unit);
  if (total > 0) {
    text = fmt::format("{}: {} of {} {} ({} %)", what, done, total, unit, 100 * done / total);
  }
  if (done <= 0 || elapsed_s < kRateFrom_s) return text;
  const double per_s = static_cast<double>(done) / elapsed_s;
  text += fmt::format(", {} {}/s", Rate(per_s), unit);
  if (total > done) {
    text += ", " + SpanText(std::ceil(static_cast<double>(total - done) / per_s)) + " left";
  }
  return text;
}

ProgressCount::ProgressCount(std::string what, std::string unit, std::int64_t total, bool quiet)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      line_(quiet, kLineEveryUs),
      begin_us_(SteadyClockUs()) {}

double ProgressCount::elapsed_s() const {
  return static_cast<double>(SteadyClockUs() - begin_us_) * 1e-6;
}

void ProgressCount::operator()(std::int64_t done) {
  const std::int64_t now_us = SteadyClockUs();
  if (!line_.Due(now_us)) return;
  line_.Show(now_us, ProgressText(what_, unit_, done, total_, elapsed_s()));
}

}  // namespace seam
