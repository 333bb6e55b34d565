#include "common/measure/around/around.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/check.h"
#include "common/measure/around/key_events.h"
#include "common/measure/revisions.h"
#include "common/measure/table.h"

namespace seam {
namespace {

/// The share of the greatest error below which a run has settled.
constexpr double kSettledErrorShare = 0.1;

bool IsTickWord(const std::string& word) {
  return !word.empty() && word.size() < 10 &&
         word.find_first_not_of("0123456789") == std::string::npos;
}

std::optional<std::int64_t> WorstTick(const Measures& measures) {
  const std::vector<double>& errors = measures.shown_error_by_tick_m;
  const auto worst = std::max_element(errors.begin(), errors.end());
  if (worst == errors.end() || *worst <= 0) return std::nullopt;
  return measures.first_tick + (worst - errors.begin());
}

std::optional<std::int64_t> EventTick(const Recording& recording, const Oracle& oracle,
                                      const Measures& measures, const std::string& word) {
  if (IsTickWord(word)) return std::atoll(word.c_str());
  if (word == "worst") return WorstTick(measures);
  if (word == "hand-over") {
    const auto first = FindFirstHandOver(recording);
    return first ? std::optional<std::int64_t>(first->tick) : std::nullopt;
  }
  const Scene scene = RecordedScene(recording.room);
  return ContactTick(recording, scene, &oracle, StruckAssemblies(scene));
}

/// Returns the number of an entry at or after the event, from which the error stays small.
std::size_t SettledFrom(const ErrorAround& run, std::size_t event, double most) {
  std::size_t from = run.error_m.size();
  while (from > event && run.error_m[from - 1] <= kSettledErrorShare * most) --from;
  return from;
}

}  // namespace

double ErrorAround::After(std::size_t i) const {
  return static_cast<double>(first_after + static_cast<std::int64_t>(i)) / tick_hz;
}

void RequireEventWord(const std::string& word) {
  if (word == "contact" || word == "worst" || word == "hand-over" || IsTickWord(word)) return;
  throw OperatorError("--around " + word + ": must be contact, worst, hand-over or a tick");
}

std::optional<ErrorAround> FindErrorAround(const Recording& recording, const Oracle& oracle,
                                           const Measures& measures, const std::string& word) {
  if (measures.compared == 0) return std::nullopt;
  const std::optional<std::int64_t> tick = EventTick(recording, oracle, measures, word);
  const auto count = static_cast<std::int64_t>(measures.shown_error_by_tick_m.size());
  if (!tick || *tick < measures.first_tick || *tick >= measures.first_tick + count) {
    return std::nullopt;
  }
  ErrorAround around;
  around.event = IsTickWord(word) ? "tick " + word : word;
  around.event_tick = *tick;
  around.tick_hz = std::max(1, recording.room.tick_hz);
  const auto ticks = [&](double s) -> std::int64_t { return std::llround(s * around.tick_hz); };
  const std::int64_t at = *tick - measures.first_tick;
  const std::int64_t from = std::max<std::int64_t>(0, at - ticks(kAroundBefore_s));
  const std::int64_t to = std::min(count, at + ticks(kAroundAfter_s) + 1);
  around.first_after = from - at;
  around.error_m.assign(measures.shown_error_by_tick_m.begin() + from,
                        measures.shown_error_by_tick_m.begin() + to);
  return around;
}

std::string FormatAround(const std::vector<ErrorAround>& runs) {
  std::size_t width = 3;
  for (const ErrorAround& run : runs) width = std::max(width, run.run.size());
  std::string text = fmt::format("{:<{}}  {:<9}  {:>8}  {:>9}  {:>9}  {:>9}  {:>9}\n", "run", width,
                                 "event", "at s", "at it m", "most m", "after s", "settled s");
  for (const ErrorAround& run : runs) {
    const auto event = static_cast<std::size_t>(-run.first_after);
    const auto begin = run.error_m.begin() + static_cast<std::ptrdiff_t>(event);
    const auto most = std::max_element(begin, run.error_m.end());
    const std::size_t settled = SettledFrom(run, event, *most);
    text += fmt::format(
        "{:<{}}  {:<9}  {:>8.2f}  {:>9.3g}  {:>9.3g}  {:>9.2f}  {:>9}\n", run.run, width, run.event,
        static_cast<double>(run.event_tick) / run.tick_hz, *begin, *most,
        run.After(static_cast<std::size_t>(most - run.error_m.begin())),
        settled == run.error_m.size() ? "-" : fmt::format("{:.2f}", run.After(settled)));
  }
  return text;
}

std::string AroundCsv(const std::vector<ErrorAround>& runs) {
  std::string csv = "run,event,event_s,after_s,error_m\n";
  for (const ErrorAround& run : runs) {
    for (std::size_t i = 0; i < run.error_m.size(); ++i) {
      csv += fmt::format("{},{},{:.4f},{:.4f},{:.6g}\n", CsvField(run.run), run.event,
                         static_cast<double>(run.event_tick) / run.tick_hz, run.After(i),
                         run.error_m[i]);
    }
  }
  return csv;
}

}  // namespace seam
