#include "server/authority_source.h"

#include "common/sync/quantize.h"
#include "server/rules/impact_check.h"

namespace seam {
namespace {

/// Reports farther in the past or future than this are dropped, ticks. The past is long because a
/// report is retransmitted until it arrives.
constexpr std::int64_t kReportPast = 120, kReportFuture = 30;

}  // namespace

AuthoritySource::AuthoritySource(const Replica& replica, const AuthorityManager& authority,
                                 Stats& stats)
    : replica_(replica),
      authority_(authority),
      stats_(stats),
      trail_(replica.table()),
      forget_blows_(replica.table(), [this](const BodyRemap&) { blows_.clear(); }) {}

void AuthoritySource::NoteStates(const States& accepted) {
  for (std::size_t i = 0; i < accepted.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(accepted.id[i]);
    if (body < 0) continue;
    // Unwraps the angle towards the server's copy: it may be off by whole turns.
    trail_.Add(body, accepted.tick, Unpack(accepted, i, replica_.world().Read(body).angle));
  }
}

void AuthoritySource::NoteTick() {
  const World& world = replica_.world();
  for (int body = 0; body < world.body_count(); ++body) {
    if (Mine(body)) trail_.Add(body, world.tick(), world.Read(body));
  }
  for (const Blow& blow : ImpactsOf(world)) {
    if (!Mine(blow.body)) continue;
    // A correction may push a copy into one of our bodies: an impact that its authority never had.
    const bool all_ours = blow.by < 0 || Mine(blow.by);
    if (all_ours || Possible(world, trail_, blow, world.tick())) blows_.push_back(blow);
  }
  while (!counted_.empty() && std::get<0>(*counted_.begin()) < world.tick() - 2 * kReportPast) {
    counted_.erase(counted_.begin());
  }
}

void AuthoritySource::NoteReport(int peer, const ImpactReport& report) {
  const std::int64_t age = replica_.tick() - report.tick;
  if (age > kReportPast || age < -kReportFuture) {
    ++stats_.dropped_stale;
    return;
  }
  for (std::size_t i = 0; i < report.id.size(); ++i) {
    if (MayReport(peer, report, i)) NoteReported(report, i);
  }
}

bool AuthoritySource::MayReport(int peer, const ImpactReport& report, std::size_t i) {
  const World& world = replica_.world();
  const int body = world.BodyOfId(report.id[i]);
  const int by = report.by[i] < 0 ? -1 : world.BodyOfId(report.by[i]);
  const bool same = body >= 0 && replica_.SameBody(body, report.revision) &&
                    (report.by[i] < 0 || (by >= 0 && replica_.SameBody(by, report.revision)));
  if (!same || report.revision > replica_.revision()) {
    ++stats_.dropped_stale;
    return false;
  }
  switch (authority_.RightToMove(peer, body, report.epoch[i])) {
    case AuthorityManager::Right::kYes: return true;
    case AuthorityManager::Right::kStale: ++stats_.dropped_stale; return false;
    case AuthorityManager::Right::kNo: ++stats_.dropped_right; return false;
  }
  return false;
}

void AuthoritySource::NoteReported(const ImpactReport& report, std::size_t i) {
  const World& world = replica_.world();
  const Blow blow{world.BodyOfId(report.id[i]),
                  report.by[i] < 0 ? -1 : world.BodyOfId(report.by[i]),
                  report.dv[i],
                  {report.x[i], report.y[i]}};
  if (!Possible(world, trail_, blow, report.tick)) {
    ++stats_.dropped_implausible;
  } else if (!counted_.insert({report.tick, report.id[i], report.by[i]}).second) {
    ++stats_.dropped_stale;
  } else {
    blows_.push_back(blow);
  }
}

BodyState AuthoritySource::Read(int body) const {
  const StateTrail::Seen* newest = trail_.Newest(body);
  return Mine(body) || newest == nullptr ? replica_.world().Read(body) : newest->state;
}

std::vector<std::int64_t> AuthoritySource::Ticks() const {
  std::vector<std::int64_t> ticks = trail_.NewTicks();
  const std::int64_t now = replica_.world().tick();
  if (ticks.empty() || ticks.back() < now) ticks.push_back(now);
  return ticks;
}

BodyState AuthoritySource::ReadAt(int body, std::int64_t tick) const {
  const std::optional<BodyState> known = trail_.At(body, tick);
  return known ? *known : Read(body);
}

std::int64_t AuthoritySource::TickOf(int body, std::int64_t tick) const {
  const std::int64_t known = trail_.TickOf(body, tick);
  return known >= 0 ? known : replica_.world().tick();
}

std::vector<Blow> AuthoritySource::TakeImpacts() {
  std::vector<Blow> taken;
  taken.swap(blows_);
  return taken;
}

}  // namespace seam
