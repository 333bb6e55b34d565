#include "render/playback/moments.h"

#include <algorithm>
#include <cmath>

#include "common/measure/handover_list.h"

namespace seam {
namespace {

constexpr float kJumpMin = 1.0f;       ///< m/s in one tick; only a collision causes this
constexpr float kStrongImpact = 3.0f;  ///< m/s
constexpr double kSameContact_s = 0.05;  ///< impacts within this belong to one contact

/// Adds the bodies of the impacts at that moment to `bodies`; without any, takes strong impacts.
std::set<PartId> BodiesOf(const Playback& playback, double s, std::set<PartId> bodies) {
  const double tick = s * playback.tick_hz(), same = kSameContact_s * playback.tick_hz();
  for (const Impacts& impacts : playback.recording().impacts) {
    if (std::abs(static_cast<double>(impacts.tick) - tick) > same) continue;
    for (std::size_t i = 0; i < impacts.dv.size(); ++i) {
      const PartId a = impacts.id_a[i], b = impacts.id_b[i];
      const bool asked = bodies.empty() ? impacts.dv[i] >= kStrongImpact
                                        : bodies.count(a) > 0 || bodies.count(b) > 0;
      if (a < 0 || b < 0 || !asked) continue;
      bodies.insert(a);
      bodies.insert(b);
    }
  }
  return bodies;
}

std::int64_t WatchedTick(const Playback& playback) {
  const std::set<PartId> struck = StruckBodies(playback);
  if (struck.empty() || !playback.has_oracle()) return -1;
  const Oracle& oracle = playback.oracle();
  const std::int64_t last = oracle.first_tick + static_cast<std::int64_t>(oracle.ticks.size());
  std::int64_t tick = std::max(playback.scene().watch.front().around_tick, oracle.first_tick + 1);
  for (; tick < last; ++tick)
    for (PartId id : struck) {
      const auto now = oracle.At(tick, id), before = oracle.At(tick - 1, id);
      if (now && before && (now->velocity - before->velocity).norm() > kJumpMin) return tick;
    }
  return -1;
}

/// Returns the tick of the first strong impact between moving bodies, or -1.
std::int64_t ImpactTick(const Playback& playback) {
  std::int64_t first = -1;
  for (const Impacts& impacts : playback.recording().impacts)
    for (std::size_t i = 0; i < impacts.dv.size(); ++i) {
      const bool both_move = impacts.id_a[i] >= 0 && impacts.id_b[i] >= 0;
      if (both_move && impacts.dv[i] >= kStrongImpact && (first < 0 || impacts.tick < first))
        first = impacts.tick;
    }
  return first;
}

double Seconds(const Playback& playback, std::int64_t tick) {
  return static_cast<double>(tick) / playback.tick_hz();
}

/// Returns the body with the greatest distance from the oracle in any peer's view.
std::set<PartId> WorstBody(const Playback& playback, double tick) {
  PartId worst = -1;
  float most = 0;
  for (const int peer : playback.peers()) {
    const Moment moment = playback.MomentAt(peer, tick);
    for (const BodyShapes& body : playback.RevisionOf(moment)->moving) {
      const auto shown = playback.Find(moment, body.id);
      const auto truth = shown ? playback.Truth(body.id, shown->tick) : std::nullopt;
      if (!truth) continue;
      const float apart = (shown->pose.position - truth->position).norm();
      if (apart <= most) continue;
      most = apart;
      worst = body.id;
    }
  }
  return worst < 0 ? std::set<PartId>{} : std::set<PartId>{worst};
}

}  // namespace

std::set<PartId> StruckBodies(const Playback& playback) {
  std::set<PartId> ids;
  if (playback.scene().watch.empty()) return ids;
  for (PartId part : playback.scene().watch.front().struck)
    for (const BodyShapes& body : playback.moving())
      if (std::find(body.parts.begin(), body.parts.end(), part) != body.parts.end())
        ids.insert(body.id);
  return ids;
}

std::optional<ShownMoment> ContactMoment(const std::vector<Playback>& playbacks) {
  for (const Playback& playback : playbacks) {
    const std::int64_t tick = WatchedTick(playback);
    if (tick < 0) continue;
    const double s = Seconds(playback, tick);
    return ShownMoment{s, BodiesOf(playback, s, StruckBodies(playback))};
  }
  for (const Playback& playback : playbacks) {
    const std::int64_t tick = ImpactTick(playback);
    if (tick < 0) continue;
    const double s = Seconds(playback, tick);
    return ShownMoment{s, BodiesOf(playback, s, {})};
  }
  return std::nullopt;
}

std::optional<ShownMoment> WorstMoment(const std::vector<Playback>& playbacks) {
  std::optional<ShownMoment> worst;
  double most = 0;
  for (const Playback& playback : playbacks) {
    const std::vector<double>& errors = playback.ErrorByTick(-1);
    bool here = false;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (!(errors[i] > most)) continue;  // also skips NaN
      most = errors[i];
      const std::int64_t tick = playback.ErrorFirstTick() + static_cast<std::int64_t>(i);
      worst = ShownMoment{Seconds(playback, tick), {}};
      here = true;
    }
    if (here) worst->bodies = WorstBody(playback, worst->s * playback.tick_hz());
  }
  return worst;
}

std::optional<ShownMoment> HandOverMoment(const std::vector<Playback>& playbacks) {
  for (const Playback& playback : playbacks) {
    const auto views = playback.recording().views.find(0);
    if (views == playback.recording().views.end()) continue;
    std::map<PartId, int> holders;
    for (const auto& [tick, view] : views->second) {
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const int holder = view.authority[i];
        if (holder <= 0) continue;  // held by the server, or being handed over
        const auto [known, first] = holders.emplace(view.id[i], holder);
        if (!first && known->second != holder) {
          return ShownMoment{Seconds(playback, tick), {view.id[i]}};
        }
      }
    }
    // The server's view may lack bodies held by clients (--publish own): use the clients' claims.
    for (const HandOverSeen& seen : ListHandOvers(playback.recording())) {
      if (seen.from > 0 && seen.to > 0) return ShownMoment{Seconds(playback, seen.tick), {seen.id}};
    }
  }
  return std::nullopt;
}

ShownMoment MainMoment(const std::vector<Playback>& playbacks) {
  if (const auto contact = ContactMoment(playbacks)) return *contact;
  if (const auto worst = WorstMoment(playbacks)) return *worst;
  return {(playbacks.front().first_s() + playbacks.front().last_s()) / 2, {}};
}

}  // namespace seam
