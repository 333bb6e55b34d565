#include "common/measure/oracle.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/measure/pose.h"
#include "common/measure/revisions.h"
#include "common/scene/mass.h"
#include "common/sync/state_arithmetic.h"

namespace seam {
namespace {

BodyState Placed(const Oracle::Place& place, const std::vector<BodyState>& moving) {
  BodyState state;
  if (place.body < 0) {
    state.position = Vec2(place.x, place.y);
    state.angle = place.angle;
    return state;
  }
  state = moving[static_cast<std::size_t>(place.body)];
  state.position = RootFrame(state).ToWorld({double{place.x}, double{place.y}}).cast<float>();
  state.angle = static_cast<float>(double{state.angle} + double{place.angle});
  return state;
}

}  // namespace

const Oracle::RevisionSpan* Oracle::SpanOf(std::size_t row) const {
  const auto later = [](std::size_t r, const RevisionSpan& span) { return r < span.first_row; };
  const auto after = std::upper_bound(spans.begin(), spans.end(), row, later);
  return after == spans.begin() ? nullptr : &*std::prev(after);
}

PartId Oracle::OwnId(PartId part) const {
  if (part < inserted_from) return part;
  const auto found = own_id.find(part);
  return found == own_id.end() ? -1 : found->second;
}

const std::vector<PartId>& Oracle::IdsOf(std::size_t row) const {
  const RevisionSpan* span = SpanOf(row);
  return span == nullptr ? ids : span->bodies->ids;
}

std::optional<BodyState> Oracle::At(std::int64_t tick, PartId part) const {
  if (tick < first_tick) return std::nullopt;
  const auto row = static_cast<std::size_t>(tick - first_tick);
  if (row >= ticks.size() || ticks[row].empty()) return std::nullopt;
  const RevisionSpan* span = SpanOf(row);
  const PartId own = OwnId(part);
  const std::vector<PartId>& now = span == nullptr ? ids : span->bodies->ids;
  const auto found = std::lower_bound(now.begin(), now.end(), own);
  if (found != now.end() && *found == own) {
    return ticks[row][static_cast<std::size_t>(found - now.begin())];
  }
  if (span == nullptr || own < 0) return std::nullopt;
  const std::vector<Place>& places = span->bodies->places;
  if (static_cast<std::size_t>(own) >= places.size()) return std::nullopt;
  const Place& place = places[static_cast<std::size_t>(own)];
  if (place.body == -2) return std::nullopt;
  return Placed(place, ticks[row]);
}

std::optional<BodyState> Oracle::AtMoment(double moment, PartId part) const {
  const double at = std::max(moment, static_cast<double>(first_tick));
  const double low = std::floor(at);
  const auto tick = static_cast<std::int64_t>(low);
  const std::optional<BodyState> state = At(tick, part);
  if (!state || at == low) return state;
  const std::optional<BodyState> after = At(tick + 1, part);
  if (!after) return std::nullopt;
  return PlusScaled(*state, Minus(*after, *state), static_cast<float>(at - low));
}

bool Oracle::SameBody(std::int64_t tick_a, std::int64_t tick_b, PartId part) const {
  if (spans.size() < 2 || tick_a < first_tick || tick_b < first_tick) return true;
  const RevisionSpan* a = SpanOf(static_cast<std::size_t>(tick_a - first_tick));
  const RevisionSpan* b = SpanOf(static_cast<std::size_t>(tick_b - first_tick));
  if (a->bodies == b->bodies) return true;
  const auto own = static_cast<std::size_t>(OwnId(part));
  const std::vector<PartId>&ra = a->bodies->roots, &rb = b->bodies->roots;
  if (own >= ra.size() || own >= rb.size() || ra[own] != rb[own] || ra[own] < 0) return false;
  const std::size_t least = std::min(ra.size(), rb.size());
  for (std::size_t p = 0; p < std::max(ra.size(), rb.size()); ++p) {
    const bool in_a = p < ra.size() && ra[p] == ra[own];
    const bool in_b = p < rb.size() && rb[p] == ra[own];
    if (in_a != in_b || (in_a && p >= least)) return false;
  }
  return true;
}

bool Oracle::Together(std::int64_t tick, const std::vector<PartId>& parts) const {
  if (tick < first_tick) return true;
  const RevisionSpan* span = SpanOf(static_cast<std::size_t>(tick - first_tick));
  if (span == nullptr) return true;
  const std::vector<PartId>& roots = span->bodies->roots;
  PartId root = -1;
  for (const PartId part : parts) {
    const auto own = static_cast<std::size_t>(OwnId(part));
    if (own >= roots.size() || roots[own] < 0) return false;
    if (root >= 0 && roots[own] != root) return false;
    root = roots[own];
  }
  return true;
}

void Oracle::Begin(std::size_t row, const SceneRevision& revision, int applied) {
  auto bodies = std::make_shared<Bodies>();
  bodies->ids = revision.ids;
  const Scene& scene = revision.scene();
  bodies->places.resize(scene.parts.size(), Place{-2, 0, 0, 0});
  bodies->roots.resize(scene.parts.size(), -1);
  for (std::size_t a = 0; a < revision.composition().assemblies.size(); ++a) {
    const Assembly& assembly = revision.composition().assemblies[a];
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    for (const PartId id : assembly.parts) {
      const auto p = static_cast<std::size_t>(id);
      const Part& part = scene.parts[p];
      bodies->roots[p] = assembly.id;
      if (assembly.anchored) {
        bodies->places[p] = {-1, part.position.x(), part.position.y(), part.angle};
        continue;
      }
      const Vec2 place = ToRootFrame(part, root, Eigen::Vector2d(0, 0)).cast<float>();
      bodies->places[p] = {revision.moving[a], place.x(), place.y(), part.angle - root.angle};
    }
  }
  if (!spans.empty() && spans.back().first_row == row) spans.pop_back();  // it lasted no tick
  spans.push_back({row, applied, std::move(bodies)});
  if (row == 0) ids = revision.ids;
}

void Oracle::Identify(const Recording& recording, const Scene& scene) {
  if (recording.edits.empty() || spans.empty()) return;
  inserted_from = static_cast<PartId>(scene.parts.size());
  const auto recorded = RevisionHistory(scene, recording).At(std::numeric_limits<int>::max());
  const auto own = RevisionHistory(scene, edits).At(std::numeric_limits<int>::max());
  std::map<std::string, PartId> by_name;
  for (std::size_t p = scene.parts.size(); p < own->scene().parts.size(); ++p) {
    by_name[own->scene().parts[p].name] = static_cast<PartId>(p);
  }
  for (std::size_t p = scene.parts.size(); p < recorded->scene().parts.size(); ++p) {
    const auto found = by_name.find(recorded->scene().parts[p].name);
    if (found != by_name.end()) own_id[static_cast<PartId>(p)] = found->second;
  }
}

}  // namespace seam
