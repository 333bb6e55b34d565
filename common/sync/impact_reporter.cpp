#include "common/sync/impact_reporter.h"

#include <algorithm>
#include <cstdlib>

#include "common/physics/impact_dv.h"
#include "common/scene/part_rules.h"

namespace seam {
namespace {

/// Time for which reported impacts are remembered, ticks: a replay goes back no further.
constexpr std::int64_t kRememberTicks = 120;

}  // namespace

void ImpactReporter::Note(bool again) {
  while (!told_.empty() && told_.front().tick < world_.tick() - kRememberTicks) told_.pop_front();
  for (const Impact& impact : world_.impacts()) {
    NoteOne(impact, impact.body_a, impact.body_b, again);
    NoteOne(impact, impact.body_b, impact.body_a, again);
  }
}

void ImpactReporter::NoteOne(const Impact& impact, int body, int by, bool again) {
  if (body < 0 || !roles_.IsAuthority(world_.mechanism(body))) return;
  const float dv = ChangeOfVelocity(world_, impact, body);
  if (!Hurts(body, dv)) return;
  const PartId id = world_.id(body), of_by = by < 0 ? -1 : world_.id(by);
  if (again && WasReported(world_.tick(), id, of_by)) return;
  if (reports_.empty() || reports_.back().tick != world_.tick()) {
    reports_.emplace_back();
    reports_.back().tick = world_.tick();
    reports_.back().revision = world_.topology().revision();
  }
  ImpactReport& report = reports_.back();
  if (report.id.size() >= kReportedImpactsMax) return;
  told_.push_back({world_.tick(), id, of_by});
  report.id.push_back(id);
  report.epoch.push_back(roles_.table().at(world_.mechanism(body)).epoch);
  report.by.push_back(of_by);
  report.x.push_back(impact.point.x());
  report.y.push_back(impact.point.y());
  report.dv.push_back(dv);
}

bool ImpactReporter::Hurts(int body, float dv) const {
  const Composition& c = world_.composition();
  const int index = c.assembly_of_part[static_cast<std::size_t>(world_.id(body))];
  const std::vector<PartId>& parts = c.assemblies[static_cast<std::size_t>(index)].parts;
  return std::any_of(parts.begin(), parts.end(), [&](PartId id) {
    const PartRules& rules = *world_.scene().parts[static_cast<std::size_t>(id)].rules;
    return rules.health > 0 && dv > rules.hurt_above;
  });
}

bool ImpactReporter::WasReported(std::int64_t tick, PartId id, PartId by) const {
  return std::any_of(told_.begin(), told_.end(), [&](const Told& told) {
    return told.id == id && told.by == by && std::llabs(told.tick - tick) <= kSameImpactTicks;
  });
}

std::vector<ImpactReport> ImpactReporter::Take() {
  std::vector<ImpactReport> taken;
  taken.swap(reports_);
  return taken;
}

}  // namespace seam
