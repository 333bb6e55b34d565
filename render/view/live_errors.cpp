#include "render/view/live_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "common/base/process.h"
#include "common/measure/measure.h"

namespace seam {
namespace {

constexpr std::int64_t kStepUs = 11000;    ///< of about 33 ms between two calls
constexpr std::int64_t kOracleKept_s = 2;  ///< of the oracle: views show up to half a second ago

}  // namespace

LiveErrors::LiveErrors(const Recording& recording)
    : oracle_(recording.room, JudgeOf(recording.room)), hz_(std::max(1, recording.room.tick_hz)) {}

std::vector<LiveError> LiveErrors::Advance(const Recording& recording, std::int64_t newest_tick) {
  std::vector<LiveError> errors;
  const std::int64_t began_us = SteadyClockUs();
  if (recording.edits.size() != identified_) oracle_.Identify(recording);
  identified_ = recording.edits.size();
  while (oracle_.tick() + hz_ < newest_tick && SteadyClockUs() - began_us < kStepUs) {
    oracle_.Step();
    MeasureAt(recording, &errors);
  }
  oracle_.Forget(oracle_.tick() - kOracleKept_s * hz_);
  return errors;
}

double LiveErrors::behind_s(std::int64_t newest_tick) const {
  return static_cast<double>(std::max<std::int64_t>(newest_tick - hz_ - oracle_.tick(), 0)) /
         static_cast<double>(hz_);
}

void LiveErrors::MeasureAt(const Recording& recording, std::vector<LiveError>* errors) const {
  const std::int64_t tick = oracle_.tick();
  for (const auto& [peer, views] : recording.views) {
    const auto view = views.find(tick);
    if (view == views.end()) continue;
    Recording alone;  // without the scene's text, so that only poses are measured
    alone.first_tick = alone.last_tick = tick;
    alone.views[peer][tick] = view->second;
    const std::vector<double> found = Measure(alone, oracle_.oracle()).shown_error_by_tick_m;
    errors->push_back(
        {peer, tick, found.empty() ? std::numeric_limits<double>::quiet_NaN() : found.back()});
  }
}

}  // namespace seam
