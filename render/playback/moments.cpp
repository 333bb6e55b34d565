#include "render/playback/moments.h"

#include <algorithm>
#include <cmath>

#include "common/measure/around/key_events.h"

namespace seam {
namespace {

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
    const Oracle* const oracle = playback.has_oracle() ? &playback.oracle() : nullptr;
    const std::set<PartId> struck = StruckBodies(playback);
    const auto tick = ContactTick(playback.recording(), playback.scene(), oracle, struck);
    if (!tick) continue;
    const double s = Seconds(playback, *tick);
    return ShownMoment{s, BodiesOf(playback, s, struck)};
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
    const auto first = FindFirstHandOver(playback.recording());
    if (first) return ShownMoment{Seconds(playback, first->tick), {first->body}};
  }
  return std::nullopt;
}

ShownMoment MainMoment(const std::vector<Playback>& playbacks) {
  if (const auto contact = ContactMoment(playbacks)) return *contact;
  if (const auto worst = WorstMoment(playbacks)) return *worst;
  return {(playbacks.front().first_s() + playbacks.front().last_s()) / 2, {}};
}

}  // namespace seam
