#include "client/python/log_arrays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "common/base/check.h"
#include "common/measure/preconditions.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/response.h"

namespace seam {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

/// Sets a row of three numbers for each state.
void SetState(const BodyState& state, std::size_t at, BodyArrays* arrays) {
  const float pose[] = {state.position.x(), state.position.y(), state.angle};
  const float velocity[] = {state.velocity.x(), state.velocity.y(), state.spin};
  std::copy(std::begin(pose), std::end(pose), arrays->poses.begin() + std::ptrdiff_t(3 * at));
  std::copy(std::begin(velocity), std::end(velocity),
            arrays->velocities.begin() + std::ptrdiff_t(3 * at));
}

}  // namespace

LogArrays::LogArrays(const std::string& path, const std::string& room, const std::string& session)
    : recording_(ReadRecording(path, room, session)), scene_(RecordedScene(recording_.room)) {}

std::string LogArrays::NameOf(PartId id) const {
  const auto part = static_cast<std::size_t>(id);
  if (id >= 0 && part < scene_.parts.size()) return scene_.parts[part].name;
  return "part " + std::to_string(id);
}

const Oracle& LogArrays::TheOracle() {
  if (oracle_ == nullptr) {
    oracle_ = std::make_unique<Oracle>(ComputeOracle(recording_, JudgeOf(recording_.room)));
  }
  return *oracle_;
}

BodyArrays LogArrays::Empty(std::vector<PartId> ids) const {
  BodyArrays arrays;
  const std::size_t cells =
      ids.size() * static_cast<std::size_t>(std::max<std::int64_t>(0, ticks()));
  arrays.ids = std::move(ids);
  arrays.poses.assign(3 * cells, kNoNumber);
  arrays.velocities.assign(3 * cells, kNoNumber);
  arrays.ages.assign(cells, kNoNumber);
  arrays.authority.assign(cells, -1);
  return arrays;
}

BodyArrays LogArrays::View(int peer, bool errors) {
  const auto found = recording_.views.find(peer);
  if (found == recording_.views.end()) {
    std::string peers;
    for (const auto& [each, views] : recording_.views) {
      peers += (peers.empty() ? "" : ", ") + std::to_string(each);
    }
    throw OperatorError("peer " + std::to_string(peer) +
                        " has no view in this log; there are: " + (peers.empty() ? "none" : peers));
  }
  std::set<PartId> ids;
  for (const auto& [tick, view] : found->second) ids.insert(view.id.begin(), view.id.end());
  BodyArrays arrays = Empty({ids.begin(), ids.end()});
  if (errors) arrays.errors.assign(arrays.ages.size(), std::numeric_limits<double>::quiet_NaN());
  const Oracle* const oracle = errors ? &TheOracle() : nullptr;
  for (const auto& [tick, view] : found->second) {
    const auto row = static_cast<std::size_t>(tick - recording_.first_tick);
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const auto column = static_cast<std::size_t>(
          std::lower_bound(arrays.ids.begin(), arrays.ids.end(), view.id[i]) - arrays.ids.begin());
      const std::size_t at = row * arrays.ids.size() + column;
      SetState(StateIn(view, i), at, &arrays);
      arrays.ages[at] = i < view.age.size() ? view.age[i] : 0;
      arrays.authority[at] = i < view.authority.size() ? view.authority[i] : std::int16_t{-1};
      if (oracle == nullptr) continue;
      const auto truth = oracle->At(tick, view.id[i]);
      if (!truth) continue;
      const BodyState due = oracle->AtMoment(MomentShown(view, i), view.id[i]).value_or(*truth);
      arrays.errors[at] = std::hypot(double{view.x[i]} - double{due.position.x()},
                                     double{view.y[i]} - double{due.position.y()});
    }
  }
  return arrays;
}

BodyArrays LogArrays::OracleBodies() {
  const Oracle& oracle = TheOracle();
  std::set<PartId> ids;
  for (std::size_t row = 0; row < oracle.ticks.size(); ++row) {
    const auto& there = oracle.IdsOf(row);
    ids.insert(there.begin(), there.end());
  }
  BodyArrays arrays = Empty({ids.begin(), ids.end()});
  for (std::size_t row = 0; row < oracle.ticks.size(); ++row) {
    const std::int64_t tick = oracle.first_tick + static_cast<std::int64_t>(row);
    if (tick < recording_.first_tick || tick > recording_.last_tick) continue;
    const auto& there = oracle.IdsOf(row);
    for (std::size_t i = 0; i < there.size() && i < oracle.ticks[row].size(); ++i) {
      const auto column = static_cast<std::size_t>(
          std::lower_bound(arrays.ids.begin(), arrays.ids.end(), there[i]) - arrays.ids.begin());
      const auto to = static_cast<std::size_t>(tick - recording_.first_tick);
      const std::size_t at = to * arrays.ids.size() + column;
      SetState(oracle.ticks[row][i], at, &arrays);
      arrays.ages[at] = 0;
    }
  }
  return arrays;
}

Measures LogArrays::MeasureAll(std::string* valid) {
  const std::string why = WhyNoOracle(recording_);
  const Oracle none;
  const Oracle& oracle = why.empty() ? TheOracle() : none;
  Measures measures = Measure(recording_, oracle);
  MeasureResponse(recording_, oracle, &measures);
  *valid = why.empty() ? WhyNotValid(recording_, oracle, measures) : why;
  return measures;
}

}  // namespace seam
