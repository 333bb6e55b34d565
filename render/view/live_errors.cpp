#include "render/view/live_errors.h"

#include <algorithm>
#include <cmath>
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

void LiveErrors::Forget(std::int64_t before_tick) {
  errors_.erase(errors_.begin(),
                std::find_if(errors_.begin(), errors_.end(),
                             [&](const LiveError& error) { return error.tick >= before_tick; }));
}

void LiveErrors::Advance(const Recording& recording, std::int64_t newest_tick) {
  const std::int64_t began_us = SteadyClockUs();
  if (recording.edits.size() != identified_) oracle_.Identify(recording);
  identified_ = recording.edits.size();
  while (oracle_.tick() + hz_ < newest_tick && SteadyClockUs() - began_us < kStepUs) {
    oracle_.Step();
    MeasureAt(recording);
  }
  oracle_.Forget(oracle_.tick() - kOracleKept_s * hz_);
}

double LiveErrors::behind_s(std::int64_t newest_tick) const {
  return static_cast<double>(std::max<std::int64_t>(newest_tick - hz_ - oracle_.tick(), 0)) /
         static_cast<double>(hz_);
}

void LiveErrors::MeasureAt(const Recording& recording) {
  const std::int64_t tick = oracle_.tick();
  for (const auto& [peer, views] : recording.views) {
    const auto view = views.find(tick);
    if (view == views.end()) continue;
    Recording alone;  // without the scene's text, so that only poses are measured
    alone.first_tick = alone.last_tick = tick;
    alone.views[peer][tick] = view->second;
    const std::vector<double> found = Measure(alone, oracle_.oracle()).shown_error_by_tick_m;
    if (!found.empty() && !std::isnan(found.back())) errors_.push_back({peer, tick, found.back()});
  }
}

}  // namespace seam
